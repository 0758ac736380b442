// @ts-check
/* Where items come to lie: whole numbers of mm, within the walls. */

/**
 * @typedef {import("./scene.js").Item} Item
 * @typedef {import("./types.js").EnvironmentScene} EnvironmentScene
 * @typedef {import("./types.js").Measures} Measures
 * @typedef {import("./types.js").Place} Place
 * @typedef {import("./types.js").WirePlace} WirePlace
 *
 * The two ends of a bar.
 * @typedef {{a: Place, b: Place}} Ends
 */

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
 * A bar's ends moved, both or one; it keeps its length at a wall.
 * @param {Ends} ends
 * @param {Item["part"]} part
 * @param {Place} by
 * @param {Measures} measures
 */
export function movedBar(ends, part, by, measures) {
  const step = part === "whole" ? roomFor(ends, by, measures) : by;
  const moved = (/** @type {"a" | "b"} */ name) => {
    if (part !== "whole" && part !== name) return wirePlace(ends[name], measures);
    return wirePlace({ x: ends[name].x + step.x, y: ends[name].y + step.y }, measures);
  };
  return { a: moved("a"), b: moved("b") };
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
