/* The changes and the robots in a link: each has the fields of its kind and no others, so that a link from a stranger can
   do no more. */

import { CELL_COUNT, PARAMETERS, PROFILES } from "../generated.js";
import type { Change, Experiment, RobotSetup } from "../types.js";

const CHANGES_MAX = 500;
const ROBOTS_MAX = 4;

type Rule = (value: unknown) => boolean;
type LinkedChange = Experiment["changes"][number];

const whole = (value: unknown) => Number.isInteger(value) && Number(value) >= 0;
const number = (value: unknown) => Number.isFinite(value);
const text = (value: unknown) => typeof value === "string" && value.length <= 40;
const place = (value: unknown) => Array.isArray(value) && value.length === 2 && value.every(number);
const parameter = (value: unknown) => typeof value === "string" && Object.hasOwn(PARAMETERS, value);
const profile = (value: unknown) => PROFILES.some((name) => name === value);
const missing = (rule: Rule) => (value: unknown) => value === undefined || rule(value);

/** The fields of each kind of change. */
const FIELDS: Record<Change["do"], Record<string, Rule>> = {
  add_bar: { a: place, b: place },
  move_bar: { id: whole, a: place, b: place },
  remove_bar: { id: whole },
  move_food: { id: whole, at: place },
  plant: { at: place, radius: number },
  move_plant: { id: whole, at: place },
  grow_plant: { id: whole, radius: number },
  remove_plant: { id: whole },
  body: { what: text, robot: missing(whole), seed: missing(whole) },
  lift: { robot: missing(whole) },
  put: { robot: missing(whole), at: place, heading: number },
  write: { robot: whole, cell: whole, side: whole },
  erase: { robot: whole },
  freeze: { robot: whole, on: whole },
  set: { robot: whole, parameter, value: whole },
  start: { robot: whole, profile },
  command: { robot: whole, opcode: whole, which: whole, value: whole },
};

/** The changes in a text; undefined if one of them is invalid. */
export function changesIn(json: string): LinkedChange[] | undefined {
  const read = listIn(json, CHANGES_MAX, isChange);
  return read?.every((it, i) => i === 0 || read[i - 1].tick <= it.tick) ? read : undefined;
}

/** The robots in a text; undefined if one of them is invalid. */
export function setupsIn(json: string): RobotSetup[] | undefined {
  const read = listIn(json, ROBOTS_MAX, isSetup);
  return read?.length ? read : undefined;
}

function listIn<T>(json: string, most: number, isOne: (it: unknown) => it is T): T[] | undefined {
  try {
    const read: unknown = JSON.parse(json);
    return Array.isArray(read) && read.length <= most && read.every(isOne) ? read : undefined;
  } catch {
    return undefined;
  }
}

function isChange(said: unknown): said is LinkedChange {
  const it = (said ?? {}) as Record<string, unknown>;
  if (typeof it.do !== "string" || !Object.hasOwn(FIELDS, it.do) || !whole(it.tick)) return false;
  const fields = FIELDS[it.do as Change["do"]];
  const known = Object.keys(it).every((key) => key === "do" || key === "tick" || Object.hasOwn(fields, key));
  return known && Object.entries(fields).every(([key, rule]) => rule(it[key]));
}

function isSetup(said: unknown): said is RobotSetup {
  const it = (said ?? {}) as Record<string, unknown>;
  if (typeof it.settings !== "object" || it.settings === null) return false;
  const { profile: name, settings, memory, seed, ...others } = it;
  const isMemory = memory === null || (Array.isArray(memory) && memory.length === CELL_COUNT && memory.every(whole));
  const areSettings = Object.entries(settings).every(([key, value]) => parameter(key) && whole(value));
  return profile(name) && isMemory && areSettings && missing(whole)(seed) && Object.keys(others).length === 0;
}
