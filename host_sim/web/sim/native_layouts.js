// @ts-check
/* The layouts of environments, and the worlds that people write: drawn and checked in C. docs/worlds.md explains their keys. */

import { NativeRun } from "./native_run.js";

/**
 * @typedef {import("../types.js").Bar} Bar
 * @typedef {import("../types.js").Layout} Layout
 * @typedef {import("../types.js").Pose} Pose
 */

/** In the order of native/page.h. */
const DRAWING = /** @type {const} */ ([
  "style", "width_mm", "height_mm", "body_radius_mm", "sensor_reach_mm", "bar_thickness_mm", "bar_count",
]);
const KEYS = ["size", "start", "food", "bars"];
const LISTS = KEYS.slice(2);
const NUMBERS_MAX = 4;
const NO_LIST = -1;

/** A mistake in what was written: where it is, a key and an entry of its list; -1 for all of it. */
export class WrittenError extends Error {
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
 * Says what layouts are drawn from.
 * @param {NativeRun} native
 * @param {SimParams} params
 * @param {Record<string, unknown>} [written] - A world that a person wrote.
 */
export function drawFrom(native, params, written = {}) {
  const bands = params.food_bands_mm;
  const numbers = [...DRAWING.map((name) => params[name]), ...params.bar_length_mm, bands.length, ...bands.flat()];
  native.doublesAt(native.c.page_drawing(), numbers.length).set(numbers);
  native.c.page_write_nothing();
  KEYS.forEach((key, i) => {
    if (written[key] !== undefined) write(native, i, written[key]);
  });
}

/**
 * @param {NativeRun} native
 * @param {number} key
 * @param {unknown} value
 */
function write(native, key, value) {
  const isList = LISTS.includes(KEYS[key]);
  const entries = isList ? value : [value];
  if (isList) native.c.page_write_list(key, Array.isArray(value) ? value.length : NO_LIST);
  if (!Array.isArray(entries)) return;
  entries.forEach((entry, i) => {
    const at = native.c.page_write_entry(key, i, Array.isArray(entry) ? entry.length : NO_LIST);
    if (!at || !Array.isArray(entry)) return;
    native.doublesAt(at, NUMBERS_MAX).set(entry.slice(0, NUMBERS_MAX).map((part) => (typeof part === "number" ? part : NaN)));
  });
}

/**
 * Draws an environment.
 * @param {NativeRun} native
 * @param {{seed: number, number: number, robots: number}} which
 * @returns {Layout}
 */
export function drawLayout(native, { seed, number, robots }) {
  const at = native.c.page_draw(seed, number, robots);
  const [bars, food, starts] = native.tablesAt(at, [4, 2, 3]);
  if (!starts.length) throw new Error(`no fair environment in 1000 draws for seed ${seed}, number ${number}`);
  if (starts.length < robots) throw new Error(`there is room for ${starts.length} robots in environment ${number}`);
  return {
    bars: /** @type {Bar[]} */ (bars),
    food: /** @type {[number, number][]} */ (food),
    starts: /** @type {Pose[]} */ (starts),
  };
}

/**
 * The world with these keys and values.
 * @param {WebAssembly.Module} module - page.wasm, compiled.
 * @param {SimParams} params - Of the random world.
 * @param {Record<string, unknown>} content
 * @returns {Omit<WrittenWorld, "name">}
 */
export function checkedWorld(module, params, content) {
  const strange = Object.keys(content).find((key) => !KEYS.includes(key));
  if (strange !== undefined) throw new WrittenError(strange, -1, `there is no '${strange}': a world has ${KEYS.join(", ")}`);
  const native = new NativeRun(module, 1);
  drawFrom(native, params, content);
  const fault = native.c.page_check();
  if (fault) throw faultAt(native, fault);
  const checked = /** @type {Omit<WrittenWorld, "name" | "bars"> & {bars?: Bar[]}} */ (content);
  return { size: [params.width_mm, params.height_mm], bars: [], ...checked };
}

/**
 * @param {NativeRun} native
 * @param {number} at
 */
function faultAt(native, at) {
  const [key, entry, count] = native.doublesAt(at, 3);
  const values = [...native.doublesAt(at, 3 + count).slice(3)];
  const text = native.textAt(native.c.page_fault_text());
  return new WrittenError(KEYS[key], entry, text.replace(/%g/g, () => `${values.shift()}`));
}
