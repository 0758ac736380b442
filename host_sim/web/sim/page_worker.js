// @ts-check
/* The page's worker: simulates experiments and sends each run after its first environment and at its end. */

import { openLog, recordedExperiment } from "./log_opening.js";
import { programState } from "./native_program.js";
import { Simulation } from "./simulation.js";
import { openWorld } from "./world_opening.js";

/**
 * @typedef {ReturnType<Simulation["result"]>} Recorded
 *
 * What else the worker is asked for, and answers: the whole log of an experiment; a robot's eight bytes after a tick, with
 * whatever its behaviour keeps in them; what its program is doing then; how many ticks an experiment takes; and the experiment that a world file is of, where
 * `base` says what the file does not, or a log with its world file, of which the text may be empty, or a recorded run.
 * @typedef {Object} Answers
 * @property {(asked: {experiment: Experiment}) => Uint8Array[]} log
 * @property {(asked: {experiment: Experiment, robot: number, tick: number}) => number[]} memory
 * @property {(asked: {experiment: Experiment, robot: number, tick: number}) => ProgramState} program
 * @property {(asked: {experiment: Experiment}) => number} ticks
 * @property {(asked: {file: {name: string, text: string}, base: Experiment}) => Experiment} world
 * @property {(asked: {text: string, world: string}) => import("./log_opening.js").Opened} open
 * @property {(asked: {recorded: RecordedRun}) => Experiment} repeat
 *
 * What it sends: an answer; or of an experiment that it is to run the run after its first environment, and `done` at its
 * end, with the changes that were refused, by their places, and why.
 * @typedef {{id: number, done: boolean, run?: Recorded, refusals?: [number, string][], answer?: any, error?: string}} Answer
 */

/** @type {{module: WebAssembly.Module, worlds: Worlds}} - From the first message. */
let parts;

/** @type {Answers} */
const ANSWERS = {
  log: ({ experiment }) => finished(experiment).log ?? [],
  memory: ({ experiment, robot, tick }) => finishedAt(experiment, tick).memory(robot),
  program: ({ experiment, robot, tick }) =>
    programState(finishedAt(experiment, tick), robot, experiment.robots[robot].program ?? ""),
  ticks: ({ experiment }) => finished(experiment, false).tick,
  world: ({ file, base }) => openWorld(parts, file, base),
  open: ({ text, world }) => openLog(parts.module, parts.worlds, text, world),
  repeat: ({ recorded }) => recordedExperiment(parts.module, parts.worlds, recorded),
};

/**
 * @param {Experiment} experiment
 * @param {boolean} [keepsLog]
 */
function finished(experiment, keepsLog = true) {
  const simulation = new Simulation(parts.module, experiment, parts.worlds, keepsLog);
  simulation.finish();
  return simulation;
}

/**
 * What is there after a tick.
 * @param {Experiment} experiment
 * @param {number} tick
 */
function finishedAt(experiment, tick) {
  const changes = experiment.changes.filter((change) => change.tick <= tick);
  return finished({ ...experiment, changes, ticks_max: tick + 1 }).native;
}

/** @param {Answer} answer */
function say(answer) {
  postMessage(answer);
}

/**
 * @param {number} id
 * @param {Experiment} experiment
 */
function run(id, experiment) {
  const simulation = new Simulation(parts.module, experiment, parts.worlds);
  for (const number of simulation.run()) {
    if (number === 1) say({ id, done: false, run: simulation.result() });
  }
  say({ id, done: true, run: simulation.result(), refusals: [...simulation.changes.refusals] });
}

/** @param {{do: "run" | keyof Answers, id: number, asked: any}} request */
function answer({ do: what, id, asked }) {
  if (what === "run") run(id, asked);
  else say({ id, done: true, answer: ANSWERS[what](asked) });
}

addEventListener("message", ({ data }) => {
  if (data.do === "begin") {
    parts = { module: new WebAssembly.Module(data.wasm), worlds: data.worlds };
    return;
  }
  try {
    answer(data);
  } catch (error) {
    say({ id: data.id, done: true, error: error instanceof Error ? error.message : `${error}` });
  }
});
