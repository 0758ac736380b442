/* The strip above the scrubber: a mark for every event that one can jump to. */

import { paletteOf } from "./palette.js";
import { REASON } from "./reasons.js";

/** Reason whose colour an event's mark has, and the mark's height as a share of the strip. */
const MARKS = {
  trial: [REASON.trial, 0.6],
  boredom: [REASON.boredom, 0.6],
  eat: [REASON.eat, 0.8],
  lesson: [REASON.remembered, 1],
  environment: [REASON.stop, 1],
};
const THUMB_PX = 8;

/**
 * @param {HTMLCanvasElement} canvas
 * @param {import("./run_data.js").RunData} data
 */
export function drawMarks(canvas, data) {
  const palette = paletteOf(canvas);
  const context = sizedContext(canvas);
  const [width, height] = [canvas.clientWidth - 2 * THUMB_PX, canvas.clientHeight];
  for (const [tick, kind] of data.run.events) {
    const [reason, share] = MARKS[kind];
    const x = THUMB_PX + ((tick - data.first) / Math.max(1, data.last - data.first)) * width;
    context.fillStyle = palette.reasons[reason];
    context.fillRect(x - 1, height * (1 - share), 2, height * share);
  }
}

function sizedContext(canvas) {
  canvas.width = Math.round(canvas.clientWidth * devicePixelRatio);
  canvas.height = Math.round(canvas.clientHeight * devicePixelRatio);
  const context = canvas.getContext("2d");
  context.scale(devicePixelRatio, devicePixelRatio);
  return context;
}
