/* A link to an experiment: all that reproduces it follows the # of the page's address. */

import { heard } from "../core/language.js";
import { filled } from "../core/phrases.js";
import { CELL_COUNT, PARAMETERS, PROFILES, PROGRAM_TEXT_MAX } from "../generated.js";
import type { Texts } from "../core/language.js";
import type { Change, Experiment, RobotSetup } from "../types.js";

/** What a link has. */
export type Linked = { seed: number; environments: number; robots: number; world: string; body: string; behaviour: string;
  memory: number[]; settings: Record<string, number>; setups: RobotSetup[]; changes: Experiment["changes"]; tick: number;
  lesson: string; step: number; language: string; program: string };

/** The fields that could be taken from a link, and the names of those that could not. */
type Found = { taken: Partial<Linked>; left: string[]; isCut: boolean; isOther: boolean };

/** What there is to choose from: programs by name, the names of worlds and of lessons, the codes of languages. */
export type Known = { programs: Record<string, string>; worlds: string[]; lessons: string[]; languages: string[] };

const VERSION = "1";
const END = "end";
const SEED_MAX = 999_999_999;
const ENVIRONMENTS_MAX = 20;
const ROBOTS_MAX = 4;
const TICK_MAX = 999_999;
const STEPS_MAX = 20;

const READERS: { [K in keyof Linked]: (text: string, known: Known) => Linked[K] | undefined } = {
  seed: (text) => whole(text, 0, SEED_MAX),
  environments: (text) => whole(text, 1, ENVIRONMENTS_MAX),
  robots: (text) => whole(text, 1, ROBOTS_MAX),
  world: (text, { worlds }) => oneOf(text, worlds),
  body: (text) => oneOf(text, ["ideal", "kit"]),
  behaviour: (text) => oneOf(text, PROFILES),
  memory: (text) => memoryIn(text),
  settings: (text) => settingsIn(text),
  setups: (text) => setupsIn(text),
  changes: (text) => changesIn(text),
  tick: (text) => whole(text, 0, TICK_MAX),
  lesson: (text, { lessons }) => oneOf(text, lessons),
  step: (text) => whole(text, 0, STEPS_MAX),
  language: (text, { languages }) => oneOf(text, languages),
  program: (text, { programs }) => {
    if (text.startsWith("@")) return new Map(Object.entries(programs)).get(text.slice(1));
    return text.length < PROGRAM_TEXT_MAX ? text : undefined;
  },
};

/** What the page calls the fields that it calls otherwise. */
const NAMES: Record<string, string> = { body: "bodies", settings: "parameters", setups: "the robots' own settings", tick: "time" };

/** The part of an address behind the page's own, with its #. */
export function linkOf({ memory, settings, setups, changes, program, ...others }: Partial<Linked>, { programs }: Known) {
  const name = Object.keys(programs).find((each) => programs[each] === program);
  const set = Object.entries(settings ?? {}).map(([parameter, value]) => `${parameter}:${value}`);
  const fields = {
    ...others,
    ...(memory && { memory: memory.join(".") }),
    ...(set.length && { settings: set.join(",") }),
    ...(setups && { setups: JSON.stringify(setups) }),
    ...(changes?.length && { changes: JSON.stringify(changes) }),
    ...(program !== undefined && { program: name ? `@${name}` : program }),
  };
  const parts = Object.entries(fields).map(([key, value]) => `${key}=${encodeURIComponent(value)}`);
  return `#v=${VERSION}&${parts.join("&")}&${END}`;
}

/**
 * What an address has; undefined if it is no such link.
 * @param hash - With its #.
 */
export function linkedIn(hash: string, known: Known): Found | undefined {
  if (!hash.startsWith("#v=")) return undefined;
  const [version, ...parts] = hash.slice(1).split("&");
  const isCut = parts.at(-1) !== END;
  const whatIsLost = isCut ? parts.splice(-1).map((part) => part.split("=")[0]) : parts.splice(-1).slice(1);
  const found: Found = { taken: {}, left: whatIsLost.filter(Boolean), isCut, isOther: version !== `v=${VERSION}` };
  for (const part of parts) take(part, known, found);
  return found;
}

/** Says what was taken from a link and what was not; empty if all of it was. */
export function tellFound({ taken, left, isCut, isOther }: Found, texts: Texts["program"]) {
  const named = (keys: string[]) => keys.map((key) => heard(NAMES[key] ?? key)).join(", ");
  const keys = isOther || isCut || left.length ? Object.keys(taken) : [];
  return [
    isOther ? texts.otherVersion : "", isCut ? texts.cutShort : "", keys.length ? filled(texts.taken, { taken: named(keys) }) : "",
    left.length ? filled(texts.left, { left: named(left) }) : "",
  ].filter(Boolean).join(" ");
}

function take(part: string, known: Known, { taken, left }: Found) {
  const [key, ...rest] = part.split("=");
  const read = Object.hasOwn(READERS, key) ? READERS[key as keyof Linked] : undefined;
  const text = decoded(rest.join("="));
  const value = text === undefined ? text : read?.(text, known);
  if (value === undefined) left.push(key);
  else Object.assign(taken, { [key]: value });
}

function decoded(text: string) {
  try {
    return decodeURIComponent(text);
  } catch {
    return undefined;
  }
}

function whole(text: string, least: number, most: number) {
  const number = /^\d{1,9}$/.test(text) ? Number(text) : NaN;
  return number >= least && number <= most ? number : undefined;
}

function oneOf(text: string, choices: readonly string[]) {
  return choices.includes(text) ? text : undefined;
}

function memoryIn(text: string) {
  const cells = text.split(".").map((cell) => whole(cell, 0, 255));
  return cells.length === CELL_COUNT && cells.every((cell) => cell !== undefined) ? cells as number[] : undefined;
}

function settingsIn(text: string) {
  const settings: Record<string, number> = {};
  for (const part of text.split(",")) {
    const [name, value] = part.split(":");
    const parameter = Object.hasOwn(PARAMETERS, name) ? PARAMETERS[name as keyof typeof PARAMETERS] : undefined;
    const number = parameter && whole(value ?? "", parameter.min, parameter.max);
    if (number === undefined) return undefined;
    settings[name] = number;
  }
  return settings;
}

/* The changes and the robots in a link: each has the fields of its kind and no others, so that a link from a stranger can
   do no more. */

const CHANGES_MAX = 500;

type Rule = (value: unknown) => boolean;
type LinkedChange = Experiment["changes"][number];

const isWhole = (value: unknown) => Number.isInteger(value) && Number(value) >= 0;
const number = (value: unknown) => Number.isFinite(value);
const text = (value: unknown) => typeof value === "string" && value.length <= 40;
const place = (value: unknown) => Array.isArray(value) && value.length === 2 && value.every(number);
const parameter = (value: unknown) => typeof value === "string" && Object.hasOwn(PARAMETERS, value);
const profile = (value: unknown) => PROFILES.some((name) => name === value);
const missing = (rule: Rule) => (value: unknown) => value === undefined || rule(value);

/** The fields of each kind of change. */
const FIELDS: Record<Change["do"], Record<string, Rule>> = {
  add_bar: { a: place, b: place },
  move_bar: { id: isWhole, a: place, b: place },
  remove_bar: { id: isWhole },
  move_food: { id: isWhole, at: place },
  plant: { at: place, radius: number },
  move_plant: { id: isWhole, at: place },
  grow_plant: { id: isWhole, radius: number },
  remove_plant: { id: isWhole },
  body: { what: text, robot: missing(isWhole), seed: missing(isWhole) },
  lift: { robot: missing(isWhole) },
  put: { robot: missing(isWhole), at: place, heading: number },
  write: { robot: isWhole, cell: isWhole, side: isWhole },
  erase: { robot: isWhole },
  freeze: { robot: isWhole, on: isWhole },
  set: { robot: isWhole, parameter, value: isWhole },
  start: { robot: isWhole, profile },
  command: { robot: isWhole, opcode: isWhole, which: isWhole, value: isWhole },
};

/** The changes in a text; undefined if one of them is invalid. */
function changesIn(json: string): LinkedChange[] | undefined {
  const read = listIn(json, CHANGES_MAX, isChange);
  return read?.every((it, i) => i === 0 || read[i - 1].tick <= it.tick) ? read : undefined;
}

/** The robots in a text; undefined if one of them is invalid. */
function setupsIn(json: string): RobotSetup[] | undefined {
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
  if (typeof it.do !== "string" || !Object.hasOwn(FIELDS, it.do) || !isWhole(it.tick)) return false;
  const fields = FIELDS[it.do as Change["do"]];
  const known = Object.keys(it).every((key) => key === "do" || key === "tick" || Object.hasOwn(fields, key));
  return known && Object.entries(fields).every(([key, rule]) => rule(it[key]));
}

function isSetup(said: unknown): said is RobotSetup {
  const it = (said ?? {}) as Record<string, unknown>;
  if (typeof it.settings !== "object" || it.settings === null) return false;
  const { profile: name, settings, memory, seed, ...others } = it;
  const isMemory = memory === null || (Array.isArray(memory) && memory.length === CELL_COUNT && memory.every(isWhole));
  const areSettings = Object.entries(settings).every(([key, value]) => parameter(key) && isWhole(value));
  return profile(name) && isMemory && areSettings && missing(isWhole)(seed) && Object.keys(others).length === 0;
}
