// @ts-check
/* Asks the worker for runs. If an experiment changes while it is simulated, only the newest version comes next. */

import { inflate } from "../core/packed_columns.js";

/**
 * @typedef {import("../sim/page_worker.js").Answer} Answer
 * @typedef {import("../sim/page_worker.js").Request} Request
 *
 * @typedef {(answer: Answer) => void} OnAnswer
 */

/** Has one worker; answers come in the order of the questions. */
export class Simulator {
  /** @param {import("./laboratory.js").Parts} parts */
  constructor(parts) {
    this.nextId = 0;
    /** @type {Map<number, OnAnswer>} */
    this.waiting = new Map();
    /** @type {Map<object, [Experiment, OnAnswer]>} - What is to be run next, by who asks. */
    this.queued = new Map();
    /** @type {number | undefined} - The run that is simulated now. */
    this.running = undefined;
    /** The worker, when it has what it needs. */
    this.worker = this.begin(parts);
  }

  /** @param {import("./laboratory.js").Parts} parts */
  async begin({ wasm, worker, worlds }) {
    const [bytes, script] = await Promise.all([inflate(wasm), inflate(worker)]);
    const begun = new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
    begun.addEventListener("message", ({ data }) => this.take(data));
    begun.postMessage({ do: "begin", wasm: bytes, worlds });
    return begun;
  }

  /**
   * Runs an experiment, in place of one that the same one has asked for and that has not begun.
   * @param {object} who
   * @param {Experiment} experiment
   * @param {OnAnswer} onAnswer - Called after the first environment and at the end.
   */
  run(who, experiment, onAnswer) {
    this.queued.set(who, [experiment, onAnswer]);
    this.next();
  }

  /**
   * The whole log of an experiment.
   * @param {Experiment} experiment
   * @returns {Promise<Uint8Array[]>}
   */
  async log(experiment) {
    const { log } = await this.ask({ do: "log", id: this.newId(), experiment });
    return log ?? [];
  }

  /**
   * A robot's eight bytes at a tick, with whatever its behaviour keeps in them.
   * @param {Experiment} experiment
   * @param {number} robot
   * @param {number} tick
   */
  async memory(experiment, robot, tick) {
    const { memory } = await this.ask({ do: "memory", id: this.newId(), experiment: upTo(experiment, tick), robot });
    return Uint8Array.from(memory ?? []);
  }

  /**
   * What a robot's program is doing at a tick.
   * @param {Experiment} experiment
   * @param {number} robot
   * @param {number} tick
   */
  async program(experiment, robot, tick) {
    const { program } = await this.ask({ do: "program", id: this.newId(), experiment: upTo(experiment, tick), robot });
    if (!program) throw new Error("the worker has no program");
    return program;
  }

  /**
   * The experiment that a world file is of.
   * @param {{name: string, text: string}} file
   * @param {Experiment} base - Says what the file does not.
   */
  async world(file, base) {
    const { experiment } = await this.ask({ do: "world", id: this.newId(), file, base });
    return experiment ?? base;
  }

  /**
   * The experiment that a recorded log is of.
   * @param {string} text
   * @param {string} world - The text of its world file; empty if there is none.
   */
  async open(text, world) {
    const { opened } = await this.ask({ do: "open", id: this.newId(), text, world });
    return opened;
  }

  /**
   * The experiment that a recorded run is of.
   * @param {RecordedRun} recorded
   */
  async repeat(recorded) {
    const { experiment } = await this.ask({ do: "repeat", id: this.newId(), recorded });
    if (!experiment) throw new Error("the worker has no experiment");
    return experiment;
  }

  /** @param {Exclude<Request, {do: "begin"}>} request */
  ask(request) {
    return new Promise((/** @type {OnAnswer} */ resolve, reject) => {
      this.waiting.set(request.id, (answer) => (answer.error ? reject(new Error(answer.error)) : resolve(answer)));
      this.post(request);
    });
  }

  /** @param {Request} request */
  post(request) {
    this.worker.then((worker) => worker.postMessage(request));
  }

  newId() {
    this.nextId += 1;
    return this.nextId;
  }

  next() {
    const [who] = this.queued.keys();
    const asked = who && this.queued.get(who);
    if (this.running !== undefined || !asked) return;
    this.queued.delete(who);
    const id = this.newId();
    this.running = id;
    this.waiting.set(id, asked[1]);
    this.post({ do: "run", id, experiment: asked[0] });
  }

  /** @param {Answer} answer */
  take(answer) {
    this.waiting.get(answer.id)?.(answer);
    if (!answer.done) return;
    this.waiting.delete(answer.id);
    if (answer.id === this.running) this.running = undefined;
    this.next();
  }
}

/**
 * An experiment that ends after a tick.
 * @param {Experiment} experiment
 * @param {number} tick
 * @returns {Experiment}
 */
function upTo(experiment, tick) {
  return { ...experiment, changes: experiment.changes.filter((change) => change.tick <= tick), ticks_max: tick + 1 };
}
