/* The shapes of what the server sends and takes. What the fields mean is explained where they are made: Message in
   host_sim/live/feed.py, Run in host_sim/report/replay_page.py, the generated ones where generated_types.ts says. */

import type { EnvironmentScene, Lesson, Measures, SimParams as Dimensions, State, Trial } from "./generated_types.js";

export interface Play {
  playing: boolean;
  speed: number;
  done: boolean;
  rate: number;
  stays: boolean;
  ended: Ended | null;
}

/** An environment that has just ended, and all that have since the run was started over. */
export interface Ended {
  number: number;
  finished: boolean;
  eaten: number;
  food: number;
  robot_s: number;
  environments: number;
  environments_finished: number;
  environments_robot_s: number;
}

interface Health {
  sent: number;
  lost: number;
  refused: number;
  late: number;
  orders_refused: number;
}

/** `counts` and `duty`: left, right. */
export type PinFigures = { volts: number; counts: number[]; duty: number[] };

/** What the live page receives; `states` and `trails` have one entry per robot. */
export interface Message {
  measures?: Measures;
  environment?: EnvironmentScene;
  states: State[];
  trails: number[][];
  lessons: Lesson[];
  /** For each robot, those since the last message. */
  events: RobotRun["events"][];
  play: Play;
  health: Health;
  pins: PinFigures[];
  news?: News[];
  notes?: string[];
  answers?: Answer[];
}

/**
 * An answer, and what its facts rest on and are about: ticks, cells, food. `log` if each fact in it is known.
 */
export type Said = { mark: "log" | "words"; text: string; ticks: number[]; cells: number[]; food: number[] };

/** What a page asked, and the answer: see PageTalk in host_sim/live/feed.py. */
type Answer = { who: string; sentence: string; said: Said; places: WirePlace[] };

/** What changed in the world or the bodies before a tick, in a sentence. */
export type News = [number, string];

export type EventKind = "environment" | "change" | "trial" | "lesson" | "boredom" | "eat";

/** What a recorded run has of each robot. */
export interface RobotRun {
  node: number;
  memory: [number, number[]][];
  trials: [number, Trial | null][];
  lessons: Lesson[];
  cells: [number, number, number, number, number][];
  events: [number, EventKind][];
  columns: string[];
  data: string;
}

/** A recorded run. */
export interface Run {
  version: number;
  title: string;
  measures: Measures;
  first_tick: number;
  ticks: number;
  /** The tick at which its page opens. */
  shown?: number;
  /** Names its log to the debugger's command. */
  log?: string;
  scenes: [number, EnvironmentScene][];
  news?: News[];
  eaten: [number, number[]][];
  robots: RobotRun[];
}

/** A place in the arena, mm. */
export type Place = { x: number; y: number };

/** A place as commands have it: whole mm, [x, y]. */
export type WirePlace = [number, number];

/** What the live page sends. */
export type Command = { do: "play" | "pause" | "decision" | "next" }
  | { do: "speed"; factor: number }
  | { do: "seed"; seed: number; keep: number }
  | { do: "write"; node: number; cell: number; side: number }
  | { do: "erase"; node: number }
  | { do: "freeze"; node: number; on: number }
  | { do: "ask"; who: string; text: string; node: number }
  | Exclude<WorldEdit, { do: "lift" | "put" }>
  | { do: "lift"; node: number }
  | { do: "put"; node: number; at: WirePlace; heading: number };

/** How a robot of an experiment is started. */
export interface RobotSetup {
  profile: string;
  settings: Record<string, number>;
  memory: number[] | null;
  /** The seed of its random turns; by default the experiment's, plus its place among the robots. */
  seed?: number;
  /** Its brain, in the language of the listing; without one, the firmware's own. */
  program?: string;
}

/** A change of the world, as world files have it. */
export type WorldEdit = { do: "add_bar"; a: WirePlace; b: WirePlace }
  | { do: "move_bar"; id: number; a: WirePlace; b: WirePlace }
  | { do: "remove_bar"; id: number }
  | { do: "move_food"; id: number; at: WirePlace }
  | { do: "plant"; at: WirePlace; radius: number }
  | { do: "move_plant"; id: number; at: WirePlace }
  | { do: "grow_plant"; id: number; radius: number }
  | { do: "remove_plant"; id: number }
  | { do: "body"; what: string; robot?: number; seed?: number }
  | { do: "lift"; robot?: number }
  | { do: "put"; robot?: number; at: WirePlace; heading: number };

/**
 * What a robot is told between two ticks; robots are counted from 0. A start restarts the robot with another
 * behaviour, and keeps its memory. A command is as in a log: `struct command`.
 */
export type RobotChange = { do: "write"; robot: number; cell: number; side: number }
  | { do: "erase"; robot: number }
  | { do: "freeze"; robot: number; on: number }
  | { do: "set"; robot: number; parameter: string; value: number }
  | { do: "start"; robot: number; profile: string }
  | { do: "command"; robot: number; opcode: number; which: number; value: number };

/** What a person changes between two ticks: the world, as in world files, or a robot. */
export type Change = WorldEdit | RobotChange;

/**
 * The dimensions of a world; the style of its layouts, an enum layout_style; and its measures, with the default limit
 * of boredom.
 */
export type SimParams = Dimensions & { style: number; measures: Measures };

/** Both ends of an obstacle: ax, ay, bx, by in mm. */
export type Bar = [number, number, number, number];

/** x and y in mm, heading in rad. */
export type Pose = [number, number, number];

export type Layout = { bars: Bar[]; food: [number, number][]; starts: Pose[] };

/** A world that a person wrote, as run.world.json has it: mm, and the start's heading in degrees. */
export type WrittenWorld = { name: string; size?: [number, number]; start?: [number, number, number]; food: [number, number][];
  bars: [number, number, number, number][] };

/**
 * All that a simulated run depends on. Changes are made before the senses of their tick, and are in the order of ticks.
 */
export interface Experiment {
  seed: number;
  environments: number;
  limit_ticks: number;
  robots: RobotSetup[];
  changes: (Change & { tick: number })[];
  /** Where it takes place; by default, the random one. */
  world?: string | WrittenWorld;
  /** What the robots' bodies are like: "ideal", "kit", or as in docs/bodies.md; by default, ideal. */
  body?: string | Traits;
  /** The number of ticks of a run that was ended early. */
  ticks_max?: number;
}

/** What bodies are like: the value and the tolerance of each trait. */
export type Traits = Record<string, [number, number]>;
