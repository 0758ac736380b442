/* The layouts of environments, and the worlds that people write: drawn and checked in C. docs/worlds.md explains their keys. */

import { NativeRun } from "./native_run.js";
import type { Bar, Layout, Pose, SimParams, WrittenWorld } from "../types.js";

/** In the order of native/page.h. */
const DRAWING = [
  "style", "width_mm", "height_mm", "body_radius_mm", "sensor_reach_mm", "bar_thickness_mm", "bar_count",
] as const;
const KEYS = ["size", "start", "food", "bars"];
const LISTS = KEYS.slice(2);
const NUMBERS_MAX = 4;
const NO_LIST = -1;

/** A mistake in what was written: where it is, a key and an entry of its list; -1 for all of it. */
export class WrittenError extends Error {
  constructor(readonly key: string, readonly entry: number, what: string) {
    super(what);
  }
}

/**
 * Says what layouts are drawn from.
 * @param written - A world that a person wrote.
 */
export function drawFrom(native: NativeRun, params: SimParams, written: Record<string, unknown> = {}) {
  const bands = params.food_bands_mm;
  const numbers = [...DRAWING.map((name) => params[name]), ...params.bar_length_mm, bands.length, ...bands.flat()];
  native.doublesAt(native.c.page_drawing(), numbers.length).set(numbers);
  native.c.page_write_nothing();
  KEYS.forEach((key, i) => {
    if (written[key] !== undefined) write(native, i, written[key]);
  });
}

function write(native: NativeRun, key: number, value: unknown) {
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

/** Draws an environment. */
export function drawLayout(native: NativeRun, { seed, number, robots }: { seed: number, number: number, robots: number }): Layout {
  const at = native.c.page_draw(seed, number, robots);
  const [bars, food, starts] = native.tablesAt(at, [4, 2, 3]);
  if (!starts.length) throw new Error(`no fair environment in 1000 draws for seed ${seed}, number ${number}`);
  if (starts.length < robots) throw new Error(`there is room for ${starts.length} robots in environment ${number}`);
  return {
    bars: bars as Bar[],
    food: food as [number, number][],
    starts: starts as Pose[],
  };
}

/**
 * The world with these keys and values.
 * @param module - page.wasm, compiled.
 * @param params - Of the random world.
 */
export function checkedWorld(
  module: WebAssembly.Module,
  params: SimParams,
  content: Record<string, unknown>,
): Omit<WrittenWorld, "name"> {
  const strange = Object.keys(content).find((key) => !KEYS.includes(key));
  if (strange !== undefined) throw new WrittenError(strange, -1, `there is no '${strange}': a world has ${KEYS.join(", ")}`);
  const native = new NativeRun(module, 1);
  drawFrom(native, params, content);
  const fault = native.c.page_check();
  if (fault) throw faultAt(native, fault);
  const checked = content as Omit<WrittenWorld, "name" | "bars"> & { bars?: Bar[] };
  return { size: [params.width_mm, params.height_mm], bars: [], ...checked };
}

function faultAt(native: NativeRun, at: number) {
  const [key, entry, count] = native.doublesAt(at, 3);
  const values = [...native.doublesAt(at, 3 + count).slice(3)];
  const text = native.textAt(native.c.page_fault_text());
  return new WrittenError(KEYS[key], entry, text.replace(/%g/g, () => `${values.shift()}`));
}
