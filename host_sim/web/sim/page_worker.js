// @ts-check
/* The page's worker: simulates experiments and sends each run after its first environment and at its end. */

import { openLog, recordedExperiment } from "./log_opening.js";
import { programState } from "./native_program.js";
import { Simulation } from "./simulation.js";
import { openWorld } from "./world_opening.js";

/**
 * @typedef {ReturnType<Simulation["result"]>} Recorded
 *
 * What the worker is asked for. `begin` comes first and once.
 * @typedef {{do: "begin", wasm: ArrayBuffer, worlds: Worlds}
 *   | {do: "run", id: number, experiment: Experiment}
 *   | {do: "log", id: number, experiment: Experiment}
 *   | {do: "memory", id: number, experiment: Experiment, robot: number}
 *   | {do: "program", id: number, experiment: Experiment, robot: number}
 *   | {do: "world", id: number, file: {name: string, text: string}, base: Experiment}
 *   | {do: "open", id: number, text: string, world: string}
 *   | {do: "repeat", id: number, recorded: RecordedRun}} Request
 *
 * What it answers: a run, after its first environment and at its end, with the changes that were refused; the whole log; the
 * eight bytes of a robot at the end, or what its program is doing then; or the experiment that a world file, a log, or a recorded run, is of.
 * @typedef {{id: number, run?: Recorded, refusals?: [number, string][], done: boolean, log?: Uint8Array[],
 *   memory?: number[], program?: ProgramState, opened?: import("./log_opening.js").Opened, experiment?: Experiment, error?: string}} Answer
 */

/** @type {{module: WebAssembly.Module, worlds: Worlds} | undefined} */
let parts;

/**
 * @param {Answer} answer
 */
function say(answer) {
  postMessage(answer);
}

/** @param {Exclude<Request, {do: "begin"}>} request */
function answer(request) {
  if (!parts) throw new Error("the worker has not begun");
  const { id } = request;
  if (request.do === "open") say({ id, done: true, opened: openLog(parts.module, parts.worlds, request.text, request.world) });
  else if (request.do === "repeat") say({ id, done: true, experiment: recordedExperiment(parts.module, parts.worlds, request.recorded) });
  else if (request.do === "log") say({ id, done: true, log: finished(request.experiment, parts).log });
  else if (request.do === "world") say({ id, done: true, experiment: openWorld(parts, request.file, request.base) });
  else if (request.do === "memory") say({ id, done: true, memory: finished(request.experiment, parts).native.memory(request.robot) });
  else if (request.do === "program") say({ id, done: true, program: program(request.experiment, request.robot, parts) });
  else run(id, request.experiment, parts);
}

/**
 * @param {number} id
 * @param {Experiment} experiment
 * @param {NonNullable<typeof parts>} made
 */
function run(id, experiment, { module, worlds }) {
  const simulation = new Simulation(module, experiment, worlds);
  for (const number of simulation.run()) {
    if (number === 1) say({ id, done: false, run: simulation.result(), refusals: [] });
  }
  say({ id, done: true, run: simulation.result(), refusals: [...simulation.changes.refusals] });
}

/**
 * @param {Experiment} experiment
 * @param {number} robot
 * @param {NonNullable<typeof parts>} made
 */
function program(experiment, robot, made) {
  return programState(finished(experiment, made).native, robot, experiment.robots[robot].program ?? "");
}

/**
 * @param {Experiment} experiment
 * @param {NonNullable<typeof parts>} made
 */
function finished(experiment, { module, worlds }) {
  const simulation = new Simulation(module, experiment, worlds, true);
  simulation.finish();
  return simulation;
}

addEventListener("message", ({ data }) => {
  const request = /** @type {Request} */ (data);
  if (request.do === "begin") {
    parts = { module: new WebAssembly.Module(request.wasm), worlds: request.worlds };
    return;
  }
  try {
    answer(request);
  } catch (error) {
    say({ id: request.id, done: true, error: error instanceof Error ? error.message : `${error}` });
  }
});
