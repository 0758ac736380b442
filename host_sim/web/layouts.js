// @ts-check
/* One layout of obstacles and food for each seed and number: the same as host_sim/world/layouts.py draws. */

import { PythonRandom } from "./python_random.js";

/**
 * The dimensions of a world, as in host_sim/world/params.py.
 * @typedef {Object} SimParams
 * @property {number} width_mm
 * @property {number} height_mm
 * @property {number} body_radius_mm
 * @property {number} wheel_track_mm
 * @property {number} sensor_reach_mm
 * @property {number} front_extra_mm
 * @property {number} beam_width_mm
 * @property {number} eat_reach_mm
 * @property {number} bar_count
 * @property {number} bar_thickness_mm
 * @property {[number, number]} bar_length_mm
 * @property {[number, number][]} food_bands_mm
 * @property {number} tick_s
 * @property {number} max_wheel_speed_mm_s
 *
 * Both ends of an obstacle: ax, ay, bx, by in mm.
 * @typedef {[number, number, number, number]} Bar
 *
 * A round obstacle: x, y and its radius in mm.
 * @typedef {[number, number, number]} Plant
 *
 * x and y in mm, heading in rad.
 * @typedef {[number, number, number]} Pose
 *
 * @typedef {{bars: Bar[], food: [number, number][], starts: Pose[]}} Layout
 *
 * The mathematics of the world.
 * @typedef {{sin: (angle: number) => number, cos: (angle: number) => number}} Trig
 *
 * Draws a layout for one robot, fair or not.
 * @typedef {(draws: PythonRandom, params: SimParams, trig: Trig) => Layout} Draw
 *
 * @typedef {{seed: number, number: number, robots: number}} Which
 */

/** Of the grid on which ways are looked for. */
export const CELL_MM = 25;
const TRIES = 1000;

/**
 * The first fair layout drawn.
 * @param {Which} which
 * @param {{params: SimParams, draw: Draw}} world
 * @param {Trig} trig
 * @returns {Layout}
 */
export function generate(which, { params, draw }, trig) {
  const { seed, number } = which;
  const draws = new PythonRandom(`octet ${seed} ${number}`);
  for (let i = 0; i < TRIES; i += 1) {
    const layout = draw(draws, params, trig);
    const way = fairWay(layout, params);
    if (way) return withRobots(layout, way, which, params);
  }
  throw new Error(`no fair environment in ${TRIES} draws for seed ${seed}, number ${number}`);
}

/**
 * Distance from a point to the nearest obstacle or wall, mm; negative inside one.
 * @param {number} x
 * @param {number} y
 * @param {Bar[]} bars
 * @param {SimParams} params
 * @param {Plant[]} [plants]
 */
export function clearance(x, y, bars, params, plants = []) {
  const walls = Math.min(x, params.width_mm - x, y, params.height_mm - y);
  const room = bars.reduce((least, bar) => Math.min(least, toLine(x, y, bar) - params.bar_thickness_mm / 2), walls);
  return plants.reduce((least, [px, py, radius]) => Math.min(least, Math.hypot(x - px, y - py) - radius), room);
}

/**
 * How far from its middle a body senses things.
 * @param {SimParams} params
 */
export function reachOf({ body_radius_mm, sensor_reach_mm }) {
  return body_radius_mm + sensor_reach_mm;
}

/**
 * @param {number} x
 * @param {number} y
 * @param {Bar} bar
 */
function toLine(x, y, [ax, ay, bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const along = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
  return Math.hypot(x - ax - along * dx, y - ay - along * dy);
}

/**
 * Bars of random length and angle, anywhere inside the walls.
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @param {Trig} trig
 * @returns {Layout}
 */
export function drawBars(draws, params, trig) {
  const bars = Array.from({ length: params.bar_count }, () => drawBar(draws, params, trig));
  return { bars, food: drawFood(draws, params), starts: [drawStart(draws, params)] };
}

/**
 * A piece of food in each of its bands.
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @returns {[number, number][]}
 */
export function drawFood(draws, params) {
  return params.food_bands_mm.map(([low, high]) => [between(draws, low, high), between(draws, 0, params.height_mm)]);
}

/**
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @param {Trig} trig
 * @returns {Bar}
 */
function drawBar(draws, params, trig) {
  const half = (between(draws, ...params.bar_length_mm) - params.bar_thickness_mm) / 2;
  const angle = between(draws, 0, Math.PI);
  const [dx, dy] = [half * trig.cos(angle), half * trig.sin(angle)];
  const radius = params.bar_thickness_mm / 2;
  const [marginX, marginY] = [Math.abs(dx) + radius, Math.abs(dy) + radius];
  const x = between(draws, marginX, params.width_mm - marginX);
  const y = between(draws, marginY, params.height_mm - marginY);
  return [x - dx, y - dy, x + dx, y + dy];
}

/**
 * A pose anywhere in the arena.
 * @param {PythonRandom} draws
 * @param {SimParams} params
 * @returns {Pose}
 */
export function drawStart(draws, params) {
  const [x, y] = [between(draws, 0, params.width_mm), between(draws, 0, params.height_mm)];
  return [x, y, between(draws, -Math.PI, Math.PI)];
}

/**
 * A number from low to high, each as likely.
 * @param {PythonRandom} draws
 * @param {number} low
 * @param {number} high
 */
export function between(draws, low, high) {
  return low + (high - low) * draws.random();
}

/**
 * Where the body can get to from the start, if it can get to all the food, and has room there; else undefined.
 * @param {Layout} layout
 * @param {SimParams} params
 */
function fairWay({ bars, food, starts: [start] }, params) {
  const reach = reachOf(params);
  if ([start, ...food].some(([x, y]) => clearance(x, y, bars, params) < reach)) return undefined;
  const way = reachable(bars, start, params).cells;
  return food.every((at) => reaches(way, at, params)) ? way : undefined;
}

/**
 * Whether a way leads to the cell of a point.
 * @param {Uint8Array} way
 * @param {number[]} at
 * @param {SimParams} params
 */
export function reaches(way, [x, y], params) {
  return way[cellOf(x, y, params)] === 1;
}

/**
 * Adds a start for each other robot.
 * @param {Layout} layout
 * @param {Uint8Array} way
 * @param {Which} which
 * @param {SimParams} params
 */
function withRobots(layout, way, { seed, number, robots }, params) {
  const draws = new PythonRandom(`octet ${seed} ${number} starts`);
  const reach = reachOf(params);
  const { starts, bars } = layout;
  for (let i = 0; i < TRIES && starts.length < robots; i += 1) {
    const start = drawStart(draws, params);
    const [x, y] = start;
    const apart = Math.min(...starts.map(([ox, oy]) => Math.hypot(x - ox, y - oy))) - params.body_radius_mm;
    const room = Math.min(clearance(x, y, bars, params), apart);
    if (reaches(way, start, params) && room >= reach) starts.push(start);
  }
  if (starts.length < robots) throw new Error(`there is room for ${starts.length} robots in environment ${number}`);
  return layout;
}

/** @param {SimParams} params */
function columnsOf(params) {
  return Math.ceil(params.width_mm / CELL_MM) + 2;
}

/**
 * The cell of a point, in a grid that has a border of one cell.
 * @param {number} x
 * @param {number} y
 * @param {SimParams} params
 */
function cellOf(x, y, params) {
  return (1 + Math.floor(y / CELL_MM)) * columnsOf(params) + 1 + Math.floor(x / CELL_MM);
}

/**
 * 1 for each cell, row by row, that the centre of the body can get to.
 * @param {Bar[]} bars
 * @param {number[]} start
 * @param {SimParams} params
 */
export function reachable(bars, [x, y], params) {
  const columns = columnsOf(params);
  const rows = Math.ceil(params.height_mm / CELL_MM) + 2;
  const room = params.body_radius_mm + CELL_MM * Math.SQRT1_2;
  const isFree = (/** @type {number} */ cell) => {
    const [row, column] = [Math.floor(cell / columns), cell % columns];
    const isInside = row > 0 && column > 0 && row < rows - 1 && column < columns - 1;
    return isInside && clearance((column - 0.5) * CELL_MM, (row - 0.5) * CELL_MM, bars, params) >= room;
  };
  return { cells: flooded(cellOf(x, y, params), columns, new Uint8Array(rows * columns), isFree), columns };
}

/**
 * @param {number} start
 * @param {number} columns
 * @param {Uint8Array} reached - Of each cell, nothing yet.
 * @param {(cell: number) => boolean} isFree
 */
function flooded(start, columns, reached, isFree) {
  const seen = reached.slice();
  const frontier = [start];
  for (let cell = frontier.pop(); cell !== undefined; cell = frontier.pop()) {
    if (seen[cell]) continue;
    seen[cell] = 1;
    if (!isFree(cell)) continue;
    reached[cell] = 1;
    frontier.push(cell - 1, cell + 1, cell - columns, cell + columns);
  }
  return reached;
}
