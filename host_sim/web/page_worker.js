// @ts-check
/* What the page's worker does: it simulates experiments, and hands over what it has recorded after each environment. */

import { openLog, recordedExperiment } from "./log_opening.js";
import { Simulation } from "./simulation.js";

/**
 * @typedef {import("./layouts.js").SimParams} SimParams
 * @typedef {import("./run_recorder.js").Recorded} Recorded
 * @typedef {import("./types.js").Experiment} Experiment
 *
 * What the worker is asked for. `begin` comes first and once.
 * @typedef {{do: "begin", wasm: ArrayBuffer, params: SimParams}
 *   | {do: "run", id: number, experiment: Experiment}
 *   | {do: "log", id: number, experiment: Experiment}
 *   | {do: "open", id: number, text: string, world: string}
 *   | {do: "repeat", id: number, recorded: import("./log_opening.js").RecordedRun}} Request
 *
 * What it answers: a run, after each environment and at its end, with the changes that were refused; the whole log;
 * or the experiment that a log, or a recorded run, is of.
 * @typedef {{id: number, run?: Recorded, refusals?: [number, string][], done: boolean, log?: Uint8Array[],
 *   opened?: import("./log_opening.js").Opened, experiment?: Experiment, error?: string}} Answer
 */

/** @type {{module: WebAssembly.Module, params: SimParams} | undefined} */
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
  if (request.do === "open") say({ id, done: true, opened: openLog(parts.module, parts.params, request.text, request.world) });
  else if (request.do === "repeat") say({ id, done: true, experiment: recordedExperiment(parts.module, request.recorded) });
  else if (request.do === "log") say({ id, done: true, log: logOf(request.experiment, parts) });
  else run(id, request.experiment, parts);
}

/**
 * @param {number} id
 * @param {Experiment} experiment
 * @param {NonNullable<typeof parts>} made
 */
function run(id, experiment, { module, params }) {
  const simulation = new Simulation(module, experiment, params);
  for (const number of simulation.run()) {
    if (number === 1) say({ id, done: false, run: simulation.result(), refusals: [] });
  }
  say({ id, done: true, run: simulation.result(), refusals: [...simulation.refusals] });
}

/**
 * @param {Experiment} experiment
 * @param {NonNullable<typeof parts>} made
 */
function logOf(experiment, { module, params }) {
  const simulation = new Simulation(module, experiment, params, true);
  simulation.finish();
  return simulation.log;
}

addEventListener("message", ({ data }) => {
  const request = /** @type {Request} */ (data);
  if (request.do === "begin") {
    parts = { module: new WebAssembly.Module(request.wasm), params: request.params };
    return;
  }
  try {
    answer(request);
  } catch (error) {
    say({ id: request.id, done: true, error: error instanceof Error ? error.message : `${error}` });
  }
});
