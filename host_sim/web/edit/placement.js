// @ts-check
/* Places items at whole mm within the walls. */

/** @typedef {{a: Place, b: Place}} Ends - The two ends of a bar. */

const WALL_GAP_MM = 2;

/**
 * The two ends of a bar by its id, if it is there.
 * @param {EnvironmentScene} environment
 * @param {number} id
 * @returns {Ends | undefined}
 */
export function endsOf(environment, id) {
  const bar = environment.bars.find(([barId]) => barId === id);
  return bar && { a: { x: bar[1], y: bar[2] }, b: { x: bar[3], y: bar[4] } };
}

/**
 * A plant by its id, if it is there.
 * @param {EnvironmentScene} environment
 * @param {number} id
 */
export function plantOf(environment, id) {
  const plant = environment.plants?.find(([plantId]) => plantId === id);
  return plant && { x: plant[1], y: plant[2], radius: plant[3] };
}

/**
 * A bar moved as a whole, or turned about one end so that the other follows a pointer. It keeps its length.
 * @param {Ends} ends
 * @param {Item["part"]} part - The end that follows, or "whole".
 * @param {Place} by
 * @param {Measures} measures
 */
export function movedBar(ends, part, by, measures) {
  const moved = part === "whole" ? shifted(ends, roomFor(ends, by, measures)) : swung(ends, part, by);
  const fits = isInside(moved.a, measures) && isInside(moved.b, measures);
  const { a, b } = fits ? moved : ends;
  return { a: wirePlace(a, measures), b: wirePlace(b, measures) };
}

/**
 * @param {Ends} ends
 * @param {Place} by
 * @returns {Ends}
 */
function shifted({ a, b }, by) {
  return { a: { x: a.x + by.x, y: a.y + by.y }, b: { x: b.x + by.x, y: b.y + by.y } };
}

/**
 * @param {Ends} ends
 * @param {"a" | "b"} part
 * @param {Place} by
 * @returns {Ends}
 */
function swung(ends, part, by) {
  const [end, pivot] = part === "a" ? [ends.a, ends.b] : [ends.b, ends.a];
  const length = Math.hypot(end.x - pivot.x, end.y - pivot.y);
  const [dx, dy] = [end.x + by.x - pivot.x, end.y + by.y - pivot.y];
  const scale = length / (Math.hypot(dx, dy) || 1);
  return { ...ends, [part]: { x: pivot.x + dx * scale, y: pivot.y + dy * scale } };
}

/**
 * The nearest place where a robot does not touch a wall.
 * @template {Place} P
 * @param {P} at
 * @param {Measures} measures
 * @returns {P}
 */
export function insideWalls(at, { width, height, body }) {
  const room = (/** @type {number} */ value, /** @type {number} */ size) =>
    Math.min(size - body - WALL_GAP_MM, Math.max(body + WALL_GAP_MM, value));
  return { ...at, x: room(at.x, width), y: room(at.y, height) };
}

/**
 * Whether a place is within the walls.
 * @param {Place} at
 * @param {Measures} measures
 */
export function isInside({ x, y }, { width, height }) {
  return x >= 0 && y >= 0 && x <= width && y <= height;
}

/**
 * A bar's ends turned about its middle.
 * @param {Ends} ends
 * @param {number} radians
 * @param {Measures} measures
 */
export function turnedBar({ a, b }, radians, measures) {
  const middle = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  const [cos, sin] = [Math.cos(radians), Math.sin(radians)];
  const turned = (/** @type {Place} */ { x, y }) => {
    const [dx, dy] = [x - middle.x, y - middle.y];
    return wirePlace({ x: middle.x + dx * cos - dy * sin, y: middle.y + dx * sin + dy * cos }, measures);
  };
  return { a: turned(a), b: turned(b) };
}

/**
 * A place as commands have it.
 * @param {Place} at
 * @param {Measures} measures
 * @returns {WirePlace}
 */
export function wirePlace({ x, y }, measures) {
  return [clamp(Math.round(x), measures.width), clamp(Math.round(y), measures.height)];
}

/**
 * As much of a step as both ends have room for.
 * @param {Ends} ends
 * @param {Place} by
 * @param {Measures} measures
 * @returns {Place}
 */
function roomFor({ a, b }, by, measures) {
  return { x: roomWithin(by.x, [a.x, b.x], measures.width), y: roomWithin(by.y, [a.y, b.y], measures.height) };
}

/**
 * @param {number} step
 * @param {number[]} values
 * @param {number} size
 */
function roomWithin(step, values, size) {
  return Math.min(Math.max(step, -Math.min(...values)), size - Math.max(...values));
}

/**
 * @param {number} value
 * @param {number} high
 */
function clamp(value, high) {
  return Math.min(high, Math.max(0, value));
}
