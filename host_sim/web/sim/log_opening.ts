/* Recovers the experiment of a recorded log from its commands and its world file. */

import { Arena, EditError, IDEAL, KIT } from "./arena.js";
import { CELL_COUNT, EDITS, FRAMES, OPCODE, PAGE_ROBOTS_MAX, PARAMETERS, PROFILES } from "../generated.js";
import { bytesOf, framesOf, replayLog } from "./log_replay.js";
import { checkedWorld } from "./native_layouts.js";
import { NativeRun } from "./native_run.js";
import { Simulation } from "./simulation.js";
import type { Change, Experiment, RobotSetup, WorldEdit } from "../types.js";
import type { Worlds } from "./simulation.js";

export type Opened = { experiment: Experiment; news: string };

/** A recorded run, from host_sim/report/laboratory.py. */
export type RecordedRun = { commands: [number, number, string][]; ticks: number; world: string };

/** What a world file has. */
type World = { seed: number; of: number; limit_ticks: number; robots?: number; edits: (WorldEdit & { tick: number })[];
  world?: Experiment["world"]; body?: Experiment["body"] };

const LIMIT_TICKS = 30_000;
const ENVIRONMENTS_MAX = 10_000;
/** Fields of an edit: the one that is a text, and the optional ones. */
const OTHERS = ["what", "robot", "seed"];
const HALF = CELL_COUNT / 2;
const NO_WORLD = "that is not a world file: open a run.world.json";

/**
 * @param module - page.wasm, compiled.
 * @param text - The log.
 * @param world - The text of its world file; empty if there is none.
 */
export function openLog(module: WebAssembly.Module, worlds: Worlds, text: string, world: string): Opened {
  const read = experimentIn(module, framesOf(text), world ? worldIn(module, worlds, world) : undefined);
  const simulation = new Simulation(module, read, worlds, true);
  simulation.finish();
  const experiment = { ...read, environments: Math.min(read.environments, simulation.scene.number) };
  return { experiment, news: comparison(module, text, simulation.log ?? []) };
}

/**
 * The experiment that a recorded run is of.
 * @param module - page.wasm, compiled.
 */
export function recordedExperiment(
  module: WebAssembly.Module,
  worlds: Worlds,
  { commands, ticks, world }: RecordedRun,
): Experiment {
  return experimentIn(module, recordedFrames(commands, ticks), world ? worldIn(module, worlds, world) : undefined);
}

/** The commands of a recorded run, with one frame of senses for each of its ticks. */
function* recordedFrames(commands: RecordedRun["commands"], ticks: number) {
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
 * @param module - page.wasm, compiled.
 */
export function worldIn(module: WebAssembly.Module, worlds: Worlds, text: string): World {
  const world = read(module, worlds, text);
  if (world.format !== 1 || !Array.isArray(world.edits)) throw new Error(NO_WORLD);
  const arena = new Arena(new NativeRun(module, 1), worlds.random);
  const isEdited = world.edits.every((edit: Record<string, unknown> | null, i: number) =>
    isEdit(arena, edit) && Number(edit?.tick) >= (world.edits[i - 1]?.tick ?? 0));
  if (!isCount(world.of) || !isCount(world.limit_ticks) || !isEdited) throw new Error(NO_WORLD);
  return { ...world, world: placeIn(module, worlds, world.world) };
}

/** Where the run of a world file takes place: a world with a name, or all of one that a person wrote. */
function placeIn(module: WebAssembly.Module, worlds: Worlds, world: unknown): Experiment["world"] {
  if (world === undefined || (typeof world === "string" && Object.hasOwn(worlds, world))) return world;
  if (typeof world !== "object" || world === null) throw new Error(`this page has no world ${JSON.stringify(world)}`);
  const { name, ...content } = world as Record<string, unknown>;
  return { name: `${name}`, ...checkedWorld(module, worlds.random, content) };
}

/** What a text has, with a body that can be made; not checked otherwise. */
function read(module: WebAssembly.Module, worlds: Worlds, text: string) {
  try {
    const world = JSON.parse(text);
    const { body = IDEAL } = world;
    if (typeof body === "object" || body === IDEAL || body === KIT) new Arena(new NativeRun(module, 1), worlds.random, { body });
    else throw new Error(NO_WORLD);
    return world;
  } catch {
    throw new Error(NO_WORLD);
  }
}

function isCount(number: unknown) {
  return Number.isInteger(number) && Number(number) > 0;
}

/** @param arena - Tells what a fault is. */
function isEdit(arena: Arena, edit: Record<string, unknown> | null) {
  const fields = new Map(Object.entries(EDITS)).get(`${edit?.do}`)?.filter((name) => !OTHERS.includes(name));
  const isWhole = edit !== null && Number.isInteger(edit.tick)
    && Boolean(fields?.every((name) => isField(edit[name])))
    && ["robot", "seed"].every((name) => Number.isInteger(edit[name] ?? 0));
  return isWhole && (edit.do !== "body" || isFault(arena, `${edit.what}`));
}

function isFault(arena: Arena, what: string) {
  try {
    arena.edit({ do: "body", what });
    return true;
  } catch (error) {
    if (!(error instanceof EditError)) throw error;
    return false;
  }
}

/** @param value - Either a whole number or a place. */
function isField(value: unknown) {
  return Array.isArray(value) ? value.length === 2 && value.every(Number.isInteger) : Number.isInteger(value);
}

function experimentIn(
  module: WebAssembly.Module,
  frames: Iterable<{ robot: number, base: number, data: Uint8Array }>,
  world: World | undefined,
): Experiment {
  const native = new NativeRun(module, PAGE_ROBOTS_MAX);
  const robots: RobotSetup[] = [];
  const changes: (Change & { tick: number })[] = [];
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

/** How a robot is started, with one more command. */
function setUp(
  before: RobotSetup | undefined,
  { opcode, which, value }: { opcode: number, which: number, value: number },
): RobotSetup {
  const setup = before ?? { profile: PROFILES[0], settings: {}, memory: null };
  if (opcode === OPCODE.START && !PROFILES[which]) throw new Error("this log has a behaviour that this page does not know");
  if (opcode === OPCODE.START) return { ...setup, profile: PROFILES[which], settings: {}, seed: value };
  if (opcode === OPCODE.SET) return { ...setup, settings: { ...setup.settings, [Object.keys(PARAMETERS)[which]]: value } };
  if (opcode === OPCODE.ERASE) return { ...setup, memory: Array.from({ length: CELL_COUNT }, () => 0) };
  if (opcode === OPCODE.WRITE) return { ...setup, memory: written(setup.memory, which, value) };
  return setup;
}

function written(memory: number[] | null, which: number, value: number) {
  const first = which >> HALF ? HALF : 0;
  const bytes = memory ?? Array.from({ length: CELL_COUNT }, () => 0);
  return bytes.map((byte, i) => (i >= first && i < first + HALF && (which >> (i - first)) & 1 ? (value >>> (8 * (i - first))) & 255 : byte));
}

/** How the log and what was simulated compare. */
function comparison(module: WebAssembly.Module, text: string, simulated: Uint8Array[]) {
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
