// @ts-check
/* Shapes on a canvas. */

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
