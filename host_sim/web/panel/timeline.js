// @ts-check
/* The strip above the scrubber: a mark for every event that one can jump to. */

import { made } from "../core/dom.js";
import { byId, contextOf } from "../core/elements.js";
import { inEachLanguage, nameIn } from "../core/language.js";
import { REASON } from "../generated.js";
import { paletteOf, REASON_KEYS } from "../core/palette.js";

/**
 * The reason whose colour an event's mark has, and the mark's height as a share of the strip.
 * @type {Record<EventKind, [number, number]>}
 */
const MARKS = {
  trial: [REASON.TRIAL, 0.6],
  boredom: [REASON.BOREDOM, 0.6],
  eat: [REASON.EAT, 0.8],
  lesson: [REASON.REMEMBERED, 1],
  environment: [REASON.STOP, 1],
  change: [REASON.STOP, 1],
};
const THUMB_PX = 8;

/** Explains each mark in the element marks-legend, in the language of the page. */
export function explainMarks() {
  const items = () => Object.entries(MARKS).map(([kind, [reason]]) =>
    made("li", [nameIn("kinds", kind)], kind === "change" ? { "data-thing": kind } : { "data-reason": REASON_KEYS[reason] }));
  inEachLanguage(() => byId("marks-legend").replaceChildren(...items()));
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {RobotData} robot - Whose events to mark.
 * @param {{first: number, last: number}} ticks - Those at the ends of the strip.
 */
export function drawMarks(canvas, robot, { first, last }) {
  const palette = paletteOf(canvas);
  const context = sizedContext(canvas);
  const [length, height] = [canvas.clientWidth - 2 * THUMB_PX, canvas.clientHeight];
  for (const [tick, kind] of robot.run.events) {
    const [reason, share] = MARKS[kind];
    const x = THUMB_PX + ((tick - first) / Math.max(1, last - first)) * length;
    context.fillStyle = kind === "change" ? palette.of.plant : palette.reasons[reason];
    const width = kind === "change" ? 4 : 2;
    context.fillRect(x - width / 2, height * (1 - share), width, height * share);
  }
}

/** @param {HTMLCanvasElement} canvas */
function sizedContext(canvas) {
  canvas.width = Math.round(canvas.clientWidth * devicePixelRatio);
  canvas.height = Math.round(canvas.clientHeight * devicePixelRatio);
  const context = contextOf(canvas);
  context.scale(devicePixelRatio, devicePixelRatio);
  return context;
}
