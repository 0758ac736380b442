/* The page's worker: simulates experiments and sends each run after its first environment and at its end. */

import { inflate } from "../core/packed_columns.js";
import { openLog, recordedExperiment } from "./log_opening.js";
import { programState } from "./native_program.js";
import { Simulation } from "./simulation.js";
import { openWorld } from "./world_opening.js";
import type { Experiment } from "../types.js";
import type { Opened, RecordedRun } from "./log_opening.js";
import type { ProgramState } from "./native_program.js";
import type { Worlds } from "./simulation.js";

export type Recorded = ReturnType<Simulation["result"]>;

/**
 * What else the worker answers: the whole log of an experiment; a robot's eight bytes after a tick, with all that its
 * behaviour keeps in them; what its program is doing then; how many ticks an experiment takes; and the experiment in
 * a world file, where `base` gives what the file lacks, in a log with the text of its world file, which may be empty,
 * or in a recorded run.
 */
export interface Answers {
  log: (asked: { experiment: Experiment }) => Uint8Array[];
  memory: (asked: { experiment: Experiment; robot: number; tick: number }) => number[];
  program: (asked: { experiment: Experiment; robot: number; tick: number }) => ProgramState;
  ticks: (asked: { experiment: Experiment }) => number;
  world: (asked: { file: { name: string; text: string }; base: Experiment }) => Experiment;
  open: (asked: { text: string; world: string }) => Opened;
  repeat: (asked: { recorded: RecordedRun }) => Experiment;
}

/**
 * What it sends: an answer; or for an experiment to run, the run after the first environment, and again at its end
 * with `done`, and the changes that were refused, each with its place and the reason.
 */
export type Answer = { id: number; done: boolean; run?: Recorded; refusals?: [number, string][]; answer?: any; error?: string };

/** The parts from the first message, and when they are ready. */
let parts: { module: WebAssembly.Module; worlds: Worlds };
let ready: Promise<void>;

async function begin(wasm: string, worlds: Worlds) {
  parts = { module: await WebAssembly.compile(await inflate(wasm)), worlds };
}

const ANSWERS: Answers = {
  log: ({ experiment }) => finished(experiment).log ?? [],
  memory: ({ experiment, robot, tick }) => finishedAt(experiment, tick).memory(robot),
  program: ({ experiment, robot, tick }) =>
    programState(finishedAt(experiment, tick), robot, experiment.robots[robot].program ?? ""),
  ticks: ({ experiment }) => finished(experiment, false).tick,
  world: ({ file, base }) => openWorld(parts, file, base),
  open: ({ text, world }) => openLog(parts.module, parts.worlds, text, world),
  repeat: ({ recorded }) => recordedExperiment(parts.module, parts.worlds, recorded),
};

function finished(experiment: Experiment, keepsLog = true) {
  const simulation = new Simulation(parts.module, experiment, parts.worlds, keepsLog);
  simulation.finish();
  return simulation;
}

/** The robots and their arena after a tick. */
function finishedAt(experiment: Experiment, tick: number) {
  const changes = experiment.changes.filter((change) => change.tick <= tick);
  return finished({ ...experiment, changes, ticks_max: tick + 1 }).native;
}

function say(answer: Answer) {
  postMessage(answer);
}

function run(id: number, experiment: Experiment) {
  const simulation = new Simulation(parts.module, experiment, parts.worlds);
  for (const number of simulation.run()) {
    if (number === 1) say({ id, done: false, run: simulation.result() });
  }
  say({ id, done: true, run: simulation.result(), refusals: [...simulation.changes.refusals] });
}

function answer({ do: what, id, asked }: { do: "run" | keyof Answers; id: number; asked: any }) {
  if (what === "run") run(id, asked);
  else say({ id, done: true, answer: ANSWERS[what](asked) });
}

addEventListener("message", async ({ data }) => {
  if (data.do === "begin") {
    ready = begin(data.wasm, data.worlds);
    return;
  }
  try {
    await ready;
    answer(data);
  } catch (error) {
    say({ id: data.id, done: true, error: error instanceof Error ? error.message : `${error}` });
  }
});
