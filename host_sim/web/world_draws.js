// @ts-check
/* The layouts that are not bars anywhere: as host_sim/world/corridors.py, dead_ends.py and written_layout.py draw them. */

import { CELL_MM, between, clearance, drawFood, drawStart, reachOf, reachable } from "./layouts.js";

/**
 * @typedef {import("./layouts.js").Bar} Bar
 * @typedef {import("./layouts.js").Layout} Layout
 * @typedef {import("./layouts.js").Pose} Pose
 * @typedef {import("./layouts.js").SimParams} SimParams
 * @typedef {import("./layouts.js").Trig} Trig
 * @typedef {import("./python_random.js").PythonRandom} PythonRandom
 * @typedef {import("./types.js").WrittenWorld} WrittenWorld
 */

const CORRIDOR_MM = 800;
const DOOR_MM = /** @type {const} */ ([450, 650]);
const POCKETS = 4;
const POCKET_WIDTH_MM = /** @type {const} */ ([380, 600]);
const POCKET_DEPTH_MM = /** @type {const} */ ([400, 800]);

/**
 * Walls across the whole arena, each with one door.
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @returns {Layout}
 */
export function drawCorridors(draws, params) {
  const upright = draws.random() >= 0.5;
  const [across, along] = upright ? [params.width_mm, params.height_mm] : [params.height_mm, params.width_mm];
  const count = Math.round(across / CORRIDOR_MM);
  /** @type {Bar[]} */
  const bars = [];
  for (let wall = 1; wall < count; wall += 1) bars.push(...wallWithDoor(draws, (across * wall) / count, along, upright));
  return { bars, food: drawFood(draws, params), starts: [drawStart(draws, params)] };
}

/**
 * @param {PythonRandom} draws
 * @param {number} at
 * @param {number} length
 * @param {boolean} upright
 * @returns {Bar[]}
 */
function wallWithDoor(draws, at, length, upright) {
  const door = between(draws, ...DOOR_MM);
  const first = between(draws, door / 2, length - 1.5 * door);
  const parts = [[0, first], [first + door, length]];
  return parts.map(([a, b]) => (upright ? [at, a, at, b] : [a, at, b, at]));
}

/**
 * Pockets that are open on one side only.
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @param {Trig} trig
 * @returns {Layout}
 */
export function drawDeadEnds(draws, params, trig) {
  /** @type {Bar[]} */
  const bars = [];
  while (bars.length < 3 * POCKETS) {
    const pocket = drawPocket(draws, params, trig);
    if (pocket.every((bar) => isInside(bar, params))) bars.push(...pocket);
  }
  return { bars, food: drawFood(draws, params), starts: [drawStart(draws, params)] };
}

/**
 * The back of a pocket and its two sides.
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @param {Trig} trig
 * @returns {Bar[]}
 */
function drawPocket(draws, params, trig) {
  const middle = drawStart(draws, params);
  const [width, depth] = [between(draws, ...POCKET_WIDTH_MM), between(draws, ...POCKET_DEPTH_MM)];
  const backs = [-Math.PI / 2, Math.PI / 2].map((bearing) => aheadOf(middle, width / 2, bearing, trig));
  const sides = backs.map(([x, y]) => /** @type {Bar} */ ([x, y, ...aheadOf([x, y, middle[2]], depth, 0, trig)]));
  return [[...backs[0], ...backs[1]], ...sides];
}

/**
 * @param {Pose} pose
 * @param {number} distance
 * @param {number} bearing
 * @param {Trig} trig
 * @returns {[number, number]}
 */
function aheadOf([x, y, heading], distance, bearing, trig) {
  const angle = heading + bearing;
  return [x + distance * trig.cos(angle), y + distance * trig.sin(angle)];
}

/**
 * @param {Bar} bar
 * @param {SimParams} params
 */
function isInside([ax, ay, bx, by], { width_mm, height_mm, bar_thickness_mm }) {
  const edge = bar_thickness_mm / 2;
  const fits = (/** @type {number} */ at, /** @type {number} */ size) => edge <= at && at <= size - edge;
  return fits(ax, width_mm) && fits(bx, width_mm) && fits(ay, height_mm) && fits(by, height_mm);
}

/**
 * Always the same layout; only a start that is not given is drawn.
 * @param {WrittenWorld} world
 * @returns {import("./layouts.js").Draw}
 */
export function drawWritten({ bars, food, start }) {
  return (draws, params) => {
    const pose = start ? poseOf(start) : drawFairStart(draws, params, bars, food);
    return { bars, food, starts: [pose] };
  };
}

/**
 * @param {[number, number, number]} start - The heading in degrees.
 * @returns {Pose}
 */
function poseOf([x, y, degrees]) {
  const heading = degrees * (Math.PI / 180);
  const turns = Math.abs(heading) > Math.PI ? Math.round(heading / (2 * Math.PI)) : 0;
  return [x, y, heading - 2 * Math.PI * turns];
}

/**
 * A place from which all food can be reached, with nothing in sensor reach: at least that of the food is.
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @param {Bar[]} bars
 * @param {[number, number][]} food
 * @returns {Pose}
 */
function drawFairStart(draws, params, bars, food) {
  const { cells, columns } = reachable(bars, food[0], params);
  const middles = [...cells.keys()].filter((cell) => cells[cell]).map((cell) => {
    return [((cell % columns) - 0.5) * CELL_MM, (Math.floor(cell / columns) - 0.5) * CELL_MM];
  });
  const fair = [...middles, ...food].filter(([x, y]) => clearance(x, y, bars, params) >= reachOf(params));
  const [x, y] = fair[Math.floor(draws.random() * fair.length)];
  return [x, y, between(draws, -Math.PI, Math.PI)];
}
