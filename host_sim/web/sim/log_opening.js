// @ts-check
/* Recovers the experiment of a recorded log from its commands and its world file. */

import { Arena, EditError, IDEAL, KIT } from "./arena.js";
import { CELL_COUNT, EDITS, FRAMES, OPCODE, PAGE_ROBOTS_MAX, PARAMETERS, PROFILES } from "../generated.js";
import { bytesOf, framesOf, replayLog } from "./log_replay.js";
import { checkedWorld } from "./native_layouts.js";
import { NativeRun } from "./native_run.js";
import { Simulation } from "./simulation.js";

/**
 * @typedef {{experiment: Experiment, news: string}} Opened
 *
 * A recorded run, from host_sim/report/laboratory.py.
 * @typedef {{commands: [number, number, string][], ticks: number, world: string}} RecordedRun
 *
 * What a world file has.
 * @typedef {{seed: number, of: number, limit_ticks: number, robots?: number, edits: (WorldEdit & {tick: number})[],
 *   world?: Experiment["world"], body?: Experiment["body"]}} World
 */

const LIMIT_TICKS = 30_000;
const ENVIRONMENTS_MAX = 10_000;
/** Fields of an edit: the one that is a text, and the optional ones. */
const OTHERS = ["what", "robot", "seed"];
const HALF = CELL_COUNT / 2;
const NO_WORLD = "that is not a world file: open a run.world.json";

/**
 * @param {WebAssembly.Module} module - page.wasm, compiled.
 * @param {Worlds} worlds
 * @param {string} text - The log.
 * @param {string} world - The text of its world file; empty if there is none.
 * @returns {Opened}
 */
export function openLog(module, worlds, text, world) {
  const read = experimentIn(module, framesOf(text), world ? worldIn(module, worlds, world) : undefined);
  const simulation = new Simulation(module, read, worlds, true);
  simulation.finish();
  const experiment = { ...read, environments: Math.min(read.environments, simulation.scene.number) };
  return { experiment, news: comparison(module, text, simulation.log ?? []) };
}

/**
 * The experiment that a recorded run is of.
 * @param {WebAssembly.Module} module - page.wasm, compiled.
 * @param {Worlds} worlds
 * @param {RecordedRun} recorded
 * @returns {Experiment}
 */
export function recordedExperiment(module, worlds, { commands, ticks, world }) {
  return experimentIn(module, recordedFrames(commands, ticks), world ? worldIn(module, worlds, world) : undefined);
}

/**
 * The commands of a recorded run, with one frame of senses for each of its ticks.
 * @param {RecordedRun["commands"]} commands
 * @param {number} ticks
 */
function* recordedFrames(commands, ticks) {
  const sensed = { robot: 0, base: FRAMES.SENSES, data: new Uint8Array() };
  let done = 0;
  for (const [tick, robot, hex] of commands) {
    for (; done < tick; done += 1) yield sensed;
    yield { robot, base: FRAMES.COMMAND, data: bytesOf(hex) };
  }
  for (; done < ticks; done += 1) yield sensed;
}

/**
 * The content of a world file.
 * @param {WebAssembly.Module} module - page.wasm, compiled.
 * @param {Worlds} worlds
 * @param {string} text
 * @returns {World}
 */
export function worldIn(module, worlds, text) {
  const world = parsed(text);
  if (world?.format !== 1 || !Array.isArray(world.edits)) throw new Error(NO_WORLD);
  const arena = new Arena(new NativeRun(module, 1), worlds.random);
  if (!isBody(module, worlds, world.body)) throw new Error(NO_WORLD);
  const isEdited = world.edits.every((/** @type {Record<string, unknown> | null} */ edit, /** @type {number} */ i) =>
    isEdit(arena, edit) && Number(edit?.tick) >= (world.edits[i - 1]?.tick ?? 0));
  if (!isCount(world.of) || !isCount(world.limit_ticks) || !isEdited) throw new Error(NO_WORLD);
  return { ...world, world: placeIn(module, worlds, world.world) };
}

/**
 * Where the run of a world file takes place: a world with a name, or all of one that a person wrote.
 * @param {WebAssembly.Module} module
 * @param {Worlds} worlds
 * @param {unknown} world
 * @returns {Experiment["world"]}
 */
function placeIn(module, worlds, world) {
  if (world === undefined || (typeof world === "string" && Object.hasOwn(worlds, world))) return world;
  if (typeof world !== "object" || world === null) throw new Error(`this page has no world ${JSON.stringify(world)}`);
  const { name, ...content } = /** @type {Record<string, unknown>} */ (world);
  return { name: `${name}`, ...checkedWorld(module, worlds.random, content) };
}

/**
 * @param {WebAssembly.Module} module
 * @param {Worlds} worlds
 * @param {Experiment["body"]} body
 */
function isBody(module, worlds, body) {
  if (body === undefined) return true;
  try {
    new Arena(new NativeRun(module, 1), worlds.random, { body });
    return typeof body === "object" || [IDEAL, KIT].includes(body);
  } catch {
    return false;
  }
}

/** @param {string} text */
function parsed(text) {
  try {
    return JSON.parse(text);
  } catch {
    throw new Error(NO_WORLD);
  }
}

/** @param {unknown} number */
function isCount(number) {
  return Number.isInteger(number) && Number(number) > 0;
}

/**
 * @param {Arena} arena - Tells what a fault is.
 * @param {Record<string, unknown> | null} edit
 */
function isEdit(arena, edit) {
  const fields = new Map(Object.entries(EDITS)).get(`${edit?.do}`)?.filter((name) => !OTHERS.includes(name));
  const isWhole = edit !== null && Number.isInteger(edit.tick)
    && Boolean(fields?.every((name) => isField(edit[name])))
    && ["robot", "seed"].every((name) => Number.isInteger(edit[name] ?? 0));
  return isWhole && (edit.do !== "body" || isFault(arena, `${edit.what}`));
}

/**
 * @param {Arena} arena
 * @param {string} what
 */
function isFault(arena, what) {
  try {
    arena.edit({ do: "body", what });
    return true;
  } catch (error) {
    if (!(error instanceof EditError)) throw error;
    return false;
  }
}

/** @param {unknown} value - Either a whole number or a place. */
function isField(value) {
  return Array.isArray(value) ? value.length === 2 && value.every(Number.isInteger) : Number.isInteger(value);
}

/**
 * @param {WebAssembly.Module} module
 * @param {Iterable<{robot: number, base: number, data: Uint8Array}>} frames
 * @param {World | undefined} world
 * @returns {Experiment}
 */
function experimentIn(module, frames, world) {
  const native = new NativeRun(module, PAGE_ROBOTS_MAX);
  /** @type {RobotSetup[]} */
  const robots = [];
  /** @type {(Change & {tick: number})[]} */
  const changes = [];
  let [seed, ticks] = [0, 0];
  for (const { robot, base, data } of frames) {
    if (base === FRAMES.SENSES && robot === 0) ticks += 1;
    if (base !== FRAMES.COMMAND) continue;
    const command = native.readCommand(robot, data);
    if (ticks > 0) changes.push({ do: "command", robot, ...command, tick: ticks });
    else if (command.opcode === OPCODE.START && robot === 0) seed = command.value;
    if (ticks === 0) robots[robot] = setUp(robots[robot], command);
  }
  if (!robots.length || !ticks) throw new Error("this log starts no robot of nodes 1 to 4");
  const [environments, limit_ticks] = world ? [world.of, world.limit_ticks] : [ENVIRONMENTS_MAX, LIMIT_TICKS];
  const during = changes.filter((change) => change.tick < ticks);
  const all = [...during, ...(world?.edits ?? [])].sort((a, b) => a.tick - b.tick);
  return { seed, environments, limit_ticks, robots, changes: all, ticks_max: ticks, world: world?.world, body: world?.body };
}

/**
 * How a robot is started, with one more command.
 * @param {RobotSetup | undefined} before
 * @param {{opcode: number, which: number, value: number}} command
 * @returns {RobotSetup}
 */
function setUp(before, { opcode, which, value }) {
  const setup = before ?? { profile: PROFILES[0], settings: {}, memory: null };
  if (opcode === OPCODE.START && !PROFILES[which]) throw new Error("this log has a behaviour that this page does not know");
  if (opcode === OPCODE.START) return { ...setup, profile: PROFILES[which], settings: {}, seed: value };
  if (opcode === OPCODE.SET) return { ...setup, settings: { ...setup.settings, [Object.keys(PARAMETERS)[which]]: value } };
  if (opcode === OPCODE.ERASE) return { ...setup, memory: Array.from({ length: CELL_COUNT }, () => 0) };
  if (opcode === OPCODE.WRITE) return { ...setup, memory: written(setup.memory, which, value) };
  return setup;
}

/**
 * @param {number[] | null} memory
 * @param {number} which
 * @param {number} value
 */
function written(memory, which, value) {
  const first = which >> HALF ? HALF : 0;
  const bytes = memory ?? Array.from({ length: CELL_COUNT }, () => 0);
  return bytes.map((byte, i) => (i >= first && i < first + HALF && (which >> (i - first)) & 1 ? (value >>> (8 * (i - first))) & 255 : byte));
}

/**
 * How the log and what was simulated compare.
 * @param {WebAssembly.Module} module
 * @param {string} text
 * @param {Uint8Array[]} simulated
 */
function comparison(module, text, simulated) {
  const decoder = new TextDecoder();
  const lines = simulated.map((part) => decoder.decode(part)).join("").split("\n");
  const recorded = text.trimEnd().split("\n");
  const at = recorded.findIndex((line, i) => line !== lines[i]);
  if (at < 0 && lines.length > recorded.length + 1) return "The log ends before the run does; this is its run so far, byte for byte.";
  if (at < 0) return "This is the run of the log, byte for byte.";
  const { difference } = replayLog(module, text);
  const line = `From line ${at + 1} on, the log and this page's run differ`;
  if (difference) return `${line}: the robot in the log was built from other sources (line ${difference.line}).`;
  return `${line}: open the log together with its run.world.json.`;
}
