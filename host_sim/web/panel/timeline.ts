/* The strip above the scrubber: a mark for every event that one can jump to. */

import { byId, made, sizedContext } from "../core/dom.js";
import { inEachLanguage, nameIn } from "../core/language.js";
import { REASON } from "../generated.js";
import { currentPalette, REASON_KEYS } from "../core/palette.js";
import type { EventKind, RobotRun } from "../types.js";

/** The reason whose colour an event's mark has, and the mark's height as a share of the strip. */
const MARKS: Record<EventKind, [number, number]> = {
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
 * Draws a mark for each event; if several of a kind are within a pixel, only for the first one.
 * @param ticks - Those at the ends of the strip.
 */
export function drawMarks(canvas: HTMLCanvasElement, events: RobotRun["events"], { first, last }: { first: number, last: number }) {
  const palette = currentPalette();
  const context = sizedContext(canvas);
  const [length, height] = [canvas.clientWidth - 2 * THUMB_PX, canvas.clientHeight];
  for (const [kind, [reason, share]] of Object.entries(MARKS)) {
    context.fillStyle = kind === "change" ? palette.of.plant : palette.reasons[reason];
    const width = kind === "change" ? 4 : 2;
    let drawn = 0;
    for (const [tick, what] of events) {
      const x = THUMB_PX + ((tick - first) / Math.max(1, last - first)) * length;
      if (what !== kind || x < drawn + 1) continue;
      drawn = x;
      context.fillRect(x - width / 2, height * (1 - share), width, height * share);
    }
  }
}
