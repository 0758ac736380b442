/* A chart of counts that grow with time: a line for each robot, with its name at the end. */

import { sizedContext } from "../core/dom.js";
import { currentPalette } from "../core/palette.js";
import type { Palette } from "../core/palette.js";

/** `counts[i]` holds from `ticks[i]` on; before the first one, it is 0. The line ends at the tick `end`. */
type Line = { name: string; colour: string; dash: number[]; ticks: ArrayLike<number>; counts: ArrayLike<number>; end: number };

type Scale = { x: (tick: number) => number; y: (count: number) => number; size: number };

const DASHES = [[], [8, 4], [2, 3], [8, 3, 2, 3]];

/** How the line of one of many robots is drawn. */
export function strokeOf(index: number, colours: string[]) {
  return { colour: colours[index % colours.length], dash: DASHES[Math.floor(index / colours.length) % DASHES.length] };
}

/**
 * @param canvas - Gives the size of the font.
 * @param ends - The tick at the right end, what to call it, and the count at
 *   the top.
 */
export function drawChart(
  canvas: HTMLCanvasElement,
  lines: Line[],
  { last, most, time }: { last: number, most: number, time: string },
) {
  const [width, height, size] = [canvas.clientWidth, canvas.clientHeight, parseFloat(getComputedStyle(canvas).fontSize)];
  const context = sizedContext(canvas);
  context.font = `bold ${size}px system-ui, sans-serif`;
  const names = Math.max(0, ...lines.map(({ name }) => context.measureText(name).width));
  const [left, right, top, bottom] = [2.2 * size, width - names - 0.8 * size, 0.6 * size, height - 1.6 * size];
  const scale = {
    x: (tick: number) => left + (tick / Math.max(1, last)) * (right - left),
    y: (count: number) => bottom - (count / Math.max(1, most)) * (bottom - top),
    size,
  };
  context.font = `${size}px system-ui, sans-serif`;
  drawAxes(context, currentPalette(), scale, { last, most, time });
  const drawn = lines.map((line, i) => {
    const shift = (i - (lines.length - 1) / 2) * Math.min(size / 5, (bottom - top) / Math.max(1, most) / (2 * lines.length));
    return { ...line, y: drawLine(context, line, { ...scale, y: (count) => scale.y(count) + shift }) };
  });
  drawNames(context, drawn, scale, { top, bottom });
}

function drawAxes(
  context: CanvasRenderingContext2D,
  { of }: Palette,
  { x, y, size }: Scale,
  { last, most, time }: { last: number, most: number, time: string },
) {
  context.fillStyle = of.ink;
  context.strokeStyle = of["cone-dark"];
  context.lineWidth = 1;
  context.textAlign = "right";
  const step = Math.max(1, Math.ceil(most / 7));
  for (let count = 0; count <= most; count += step) {
    context.beginPath();
    context.moveTo(x(0), y(count));
    context.lineTo(x(last), y(count));
    context.stroke();
    context.fillText(`${count}`, x(0) - size / 2, y(count) + size / 3);
  }
  context.fillText(time, x(last), y(0) + 1.3 * size);
}

/** @returns The height at which it ends, px. */
function drawLine(context: CanvasRenderingContext2D, { ticks, counts, end, colour, dash }: Line, { x, y, size }: Scale): number {
  context.strokeStyle = colour;
  context.lineWidth = size / 6;
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(x(0), y(0));
  let count = 0;
  for (let i = 0; i < ticks.length && ticks[i] <= end; i += 1) {
    context.lineTo(x(ticks[i]), y(count));
    count = counts[i];
    context.lineTo(x(ticks[i]), y(count));
  }
  context.lineTo(x(end), y(count));
  context.stroke();
  context.setLineDash([]);
  return y(count);
}

/** Writes each name beside the end of its line, or as near to it as the other names allow. */
function drawNames(
  context: CanvasRenderingContext2D,
  lines: (Line & { y: number })[],
  { x, size }: Scale,
  { top, bottom }: { top: number, bottom: number },
) {
  const gap = Math.min(size, (bottom - top) / lines.length);
  const order = [...lines].sort((a, b) => a.y - b.y);
  context.font = `bold ${gap}px system-ui, sans-serif`;
  context.textAlign = "left";
  let lowest = top;
  order.forEach(({ name, colour, y, end }, i) => {
    lowest = Math.min(Math.max(lowest, y), bottom - (order.length - 1 - i) * gap);
    context.fillStyle = colour;
    context.fillText(name, x(end) + size / 3, lowest + gap / 3);
    lowest += gap;
  });
}
