// @ts-check
/* A world that a person wrote, checked: as host_sim/world/written_world.py does it. docs/worlds.md explains the keys. */

import { clearance, reachOf, reachable, reaches } from "./layouts.js";
import { LineError, parseToml } from "./toml.js";

/**
 * @typedef {import("./layouts.js").Bar} Bar
 * @typedef {import("./layouts.js").SimParams} SimParams
 * @typedef {import("./types.js").WrittenWorld} WrittenWorld
 */

const BARS_MAX = 40;
const FOOD_MAX = 20;
const SIZE_MIN = 600;
const SIZE_MAX = [6000, 5000];
const NUMBER_MAX = 1e9;
const KEYS = ["size", "start", "food", "bars"];

/** A mistake in what was written: where it is, a key and an entry of its list; -1 for all of it. */
class WrittenError extends Error {
  /**
   * @param {string} key
   * @param {number} entry
   * @param {string} what
   */
  constructor(key, entry, what) {
    super(what);
    this.key = key;
    this.entry = entry;
  }
}

/**
 * The world in a file.
 * @param {string} name - Of the file.
 * @param {string} text
 * @param {SimParams} params - Of the random world.
 * @returns {WrittenWorld}
 */
export function writtenWorld(name, text, params) {
  /** @type {import("./toml.js").Toml["lines"]} */
  let lines = new Map();
  try {
    const toml = parseToml(text);
    lines = toml.lines;
    return checkedWorld(name, Object.fromEntries(toml.content), params);
  } catch (error) {
    if (error instanceof LineError) throw new Error(`${name}:${error.line}: this is not TOML: ${error.message}`);
    if (!(error instanceof WrittenError)) throw error;
    const [line, entries] = lines.get(error.key) ?? [1, []];
    throw new Error(`${name}:${entries[error.entry] ?? line}: ${error.message}`);
  }
}

/**
 * The world with these keys and values.
 * @param {string} name
 * @param {Record<string, unknown>} content
 * @param {SimParams} params - Of the random world.
 * @returns {WrittenWorld}
 */
export function checkedWorld(name, content, params) {
  const strange = Object.keys(content).find((key) => !KEYS.includes(key));
  if (strange !== undefined) throw new WrittenError(strange, -1, `there is no '${strange}': a world has ${KEYS.join(", ")}`);
  const size = sizeIn(content, params);
  const bars = listIn(content, "bars", BARS_MAX).map((bar, i) => barIn(bar, i, size, params));
  const food = listIn(content, "food", FOOD_MAX).map((at, i) => inside(numbers(at, "food", i, "[x, y]"), "food", i, size));
  if (!food.length) throw new WrittenError("food", -1, "a world needs food, such as food = [[3500, 400]]");
  const start = content.start === undefined ? undefined : numbers(content.start, "start", -1, "[x, y, heading]");
  if (start) inside(start.slice(0, 2), "start", -1, size);
  const world = /** @type {WrittenWorld} */ ({ name, size, ...(start && { start }), food, bars });
  checkFair(world, { ...params, width_mm: size[0], height_mm: size[1] });
  return world;
}

/**
 * @param {Record<string, unknown>} content
 * @param {SimParams} params
 * @returns {[number, number]}
 */
function sizeIn({ size }, { width_mm, height_mm }) {
  if (size === undefined) return [width_mm, height_mm];
  const [width, height] = numbers(size, "size", -1, "[width, height]");
  if (Math.min(width, height) >= SIZE_MIN && width <= SIZE_MAX[0] && height <= SIZE_MAX[1]) return [width, height];
  const range = `from [${SIZE_MIN}, ${SIZE_MIN}] to [${SIZE_MAX.join(", ")}]`;
  throw new WrittenError("size", -1, `size must be [width, height] in mm, ${range}`);
}

/**
 * @param {Record<string, unknown>} content
 * @param {string} key
 * @param {number} most
 * @returns {unknown[]}
 */
function listIn(content, key, most) {
  const value = content[key] ?? [];
  if (Array.isArray(value) && value.length <= most) return value;
  throw new WrittenError(key, -1, `${key} must be a list of at most ${most} lists, such as [[...], [...]]`);
}

/**
 * @param {unknown} value
 * @param {number} entry
 * @param {[number, number]} size
 * @param {SimParams} params
 * @returns {Bar}
 */
function barIn(value, entry, size, { bar_thickness_mm }) {
  const [ax, ay, bx, by] = numbers(value, "bars", entry, "[x, y, x, y]");
  inside([ax, ay], "bars", entry, size);
  inside([bx, by], "bars", entry, size);
  if (Math.hypot(bx - ax, by - ay) >= bar_thickness_mm) return [ax, ay, bx, by];
  throw new WrittenError("bars", entry, `${nth("bars", entry)} must be at least ${bar_thickness_mm} mm long`);
}

/**
 * The numbers of one entry, as many as its form has.
 * @param {unknown} value
 * @param {string} key
 * @param {number} entry
 * @param {string} form
 * @returns {number[]}
 */
function numbers(value, key, entry, form) {
  const count = form.split(",").length;
  const isNumber = (/** @type {unknown} */ part) => typeof part === "number" && Math.abs(part) < NUMBER_MAX;
  if (Array.isArray(value) && value.length === count && value.every(isNumber)) return value;
  throw new WrittenError(key, entry, `${nth(key, entry)} must be ${form}: ${count} numbers`);
}

/**
 * @param {number[]} at
 * @param {string} key
 * @param {number} entry
 * @param {[number, number]} size
 * @returns {[number, number]}
 */
function inside([x, y], key, entry, [width, height]) {
  if (x >= 0 && y >= 0 && x <= width && y <= height) return [x, y];
  const arena = `the arena, whose size is [${width}, ${height}]`;
  throw new WrittenError(key, entry, `${nth(key, entry)}: [${x}, ${y}] is outside of ${arena}`);
}

/**
 * @param {WrittenWorld} world
 * @param {SimParams} params
 */
function checkFair({ start, food, bars }, params) {
  const needed = reachOf(params);
  const places = [...(start ? [{ key: "start", entry: -1, at: start }] : []), ...food.map((at, entry) => ({ key: "food", entry, at }))];
  for (const { key, entry, at } of places) {
    const room = clearance(at[0], at[1], bars, params);
    const where = room > 0 ? `only ${room.toFixed(0)} mm away from an obstacle or a wall` : "inside an obstacle";
    const name = key === "start" ? "the start" : nth(key, entry);
    if (room < needed) throw new WrittenError(key, entry, `${name} is ${where}; ${needed} mm are needed`);
  }
  const way = reachable(bars, start ?? food[0], params).cells;
  const lost = food.findIndex((at) => !reaches(way, at, params));
  const from = start ? "the start" : "food 1";
  const what = `food ${lost + 1} cannot be reached from ${from}: the robot does not fit through`;
  if (lost >= 0) throw new WrittenError("food", lost, what);
}

/**
 * What people call an entry: bar 3.
 * @param {string} key
 * @param {number} entry
 */
function nth(key, entry) {
  return entry < 0 ? key : `${key.replace(/s$/, "")} ${entry + 1}`;
}
