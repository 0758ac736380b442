// @ts-check
/* Shapes on a canvas. */

const LEAVES = 8;
const FONT = "system-ui, sans-serif";

/**
 * A ring about the origin.
 * @param {CanvasRenderingContext2D} context
 * @param {number} radius
 * @param {string} colour
 */
export function drawRing(context, radius, colour) {
  context.strokeStyle = colour;
  context.lineWidth = 16;
  circle(context, 0, 0, radius);
  context.stroke();
}

/**
 * A disc with an edge.
 * @param {CanvasRenderingContext2D} context
 * @param {{x: number, y: number, radius: number, ground: string, edge: string, width: number}} disc
 */
export function drawDisc(context, { x, y, radius, ground, edge, width }) {
  circle(context, x, y, radius);
  context.fillStyle = ground;
  context.fill();
  context.strokeStyle = edge;
  context.lineWidth = width;
  context.stroke();
}

/**
 * A plant: leaves around a pot, as large as they are.
 * @param {CanvasRenderingContext2D} context
 * @param {number[]} plant
 * @param {{plant: string, floor: string, bar: string}} colours
 */
export function drawPlant(context, [, x, y, radius], { plant, floor, bar }) {
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

/**
 * A text about its middle.
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {{x: number, y: number, size: number, colour: string}} how
 */
export function drawText(context, text, { x, y, size, colour }) {
  context.fillStyle = colour;
  context.font = `bold ${size}px ${FONT}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, x, y + size / 16);
}

/**
 * How wide `drawText` writes a text.
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {number} size
 */
export function textWidth(context, text, size) {
  context.font = `bold ${size}px ${FONT}`;
  return context.measureText(text).width;
}

/**
 * Begins a path that is one circle.
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 */
export function circle(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}
