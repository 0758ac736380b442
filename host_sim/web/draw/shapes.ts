/* Shapes on a canvas. */

import { contextOf } from "../core/dom.js";

const LEAVES = 8;
const FONT = "system-ui, sans-serif";
const QUIET_ZONE_MODULES = 4;

/** Draws a ring around the origin. */
export function drawRing(context: CanvasRenderingContext2D, radius: number, colour: string) {
  context.strokeStyle = colour;
  context.lineWidth = 16;
  circle(context, 0, 0, radius);
  context.stroke();
}

/** Draws a disc with an edge. */
export function drawDisc(
  context: CanvasRenderingContext2D,
  { x, y, radius, ground, edge, width }: { x: number, y: number, radius: number, ground: string, edge: string, width: number },
) {
  circle(context, x, y, radius);
  context.fillStyle = ground;
  context.fill();
  context.strokeStyle = edge;
  context.lineWidth = width;
  context.stroke();
}

/** Draws a plant to scale: leaves around a pot. */
export function drawPlant(
  context: CanvasRenderingContext2D,
  [, x, y, radius]: number[],
  { plant, floor, bar }: { plant: string, floor: string, bar: string },
) {
  drawDisc(context, { x, y, radius, ground: plant, edge: plant, width: 1 });
  context.strokeStyle = floor;
  context.lineWidth = radius / 12;
  for (let leaf = 0; leaf < LEAVES; leaf += 1) {
    const [dx, dy] = [Math.cos, Math.sin].map((part) => radius * part((leaf * 2 * Math.PI) / LEAVES));
    context.beginPath();
    context.moveTo(x + 0.4 * dx, y + 0.4 * dy);
    context.lineTo(x + 0.85 * dx, y + 0.85 * dy);
    context.stroke();
  }
  drawDisc(context, { x, y, radius: 0.35 * radius, ground: bar, edge: floor, width: 6 });
}

/** Draws a text centred on a place. */
export function drawText(
  context: CanvasRenderingContext2D,
  text: string,
  { x, y, size, colour }: { x: number, y: number, size: number, colour: string },
) {
  context.fillStyle = colour;
  context.font = `bold ${size}px ${FONT}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, x, y + size / 16);
}

/** Begins a path that is one circle. */
export function circle(context: CanvasRenderingContext2D, x: number, y: number, radius: number) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}

/**
 * Draws a QR code with a number of modules on each side, one pixel each, and its light border.
 * @param isDark - Whether the module in a column and a row is dark.
 */
export function drawModules(canvas: HTMLCanvasElement, side: number, isDark: (x: number, y: number) => boolean) {
  canvas.width = canvas.height = side + 2 * QUIET_ZONE_MODULES;
  const context = contextOf(canvas);
  context.fillStyle = "white";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = "black";
  for (let y = 0; y < side; y += 1) {
    for (let x = 0; x < side; x += 1) {
      if (isDark(x, y)) context.fillRect(x + QUIET_ZONE_MODULES, y + QUIET_ZONE_MODULES, 1, 1);
    }
  }
}
