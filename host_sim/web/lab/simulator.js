// @ts-check
/* Asks the worker for runs. Of an experiment that changes meanwhile, only the newest version is simulated next. */

import { inflate } from "../core/packed_columns.js";

/**
 * @typedef {import("../sim/page_worker.js").Answer} Answer
 * @typedef {import("../sim/page_worker.js").Answers} Answers
 *
 * @typedef {(answer: Answer) => void} OnAnswer
 */

/** Has one worker; answers come in the order of the questions. */
export class Simulator {
  /** @param {import("./laboratory.js").Parts} parts */
  constructor(parts) {
    this.lastId = 0;
    /** @type {Map<number, OnAnswer>} */
    this.waiting = new Map();
    /** @type {Map<object, [Experiment, OnAnswer]>} - What is to be run next, by who asks. */
    this.queued = new Map();
    /** @type {number | undefined} - The run that is simulated now. */
    this.running = undefined;
    /** The worker, when it has what it needs. */
    this.worker = this.begin(parts);
    this.worker.catch(() => {}); // who asks is told
  }

  /** @param {import("./laboratory.js").Parts} parts */
  async begin({ wasm, worker, worlds, why }) {
    if (why) throw new Error(why);
    const [bytes, script] = await Promise.all([inflate(wasm), inflate(worker)]);
    const begun = new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
    begun.addEventListener("message", ({ data }) => this.take(data));
    begun.postMessage({ do: "begin", wasm: bytes, worlds });
    return begun;
  }

  /**
   * Queues an experiment to run; it replaces one that waits there for the same caller.
   * @param {object} who
   * @param {Experiment} experiment
   * @param {OnAnswer} onAnswer - Called after the first environment and at the end.
   */
  run(who, experiment, onAnswer) {
    this.queued.set(who, [experiment, onAnswer]);
    this.next();
  }

  /**
   * Asks for something else than a run.
   * @template {keyof Answers} K
   * @param {K} what
   * @param {Parameters<Answers[K]>[0]} asked
   * @returns {Promise<ReturnType<Answers[K]>>}
   */
  ask(what, asked) {
    return new Promise((resolve, reject) => {
      this.post(what, asked, ({ answer, error }) => (error ? reject(new Error(error)) : resolve(answer)));
    });
  }

  /**
   * @param {"run" | keyof Answers} what
   * @param {object} asked
   * @param {OnAnswer} onAnswer
   */
  post(what, asked, onAnswer) {
    this.lastId += 1;
    const id = this.lastId;
    this.waiting.set(id, onAnswer);
    this.worker.then((worker) => worker.postMessage({ do: what, id, asked }), ({ message }) => this.take({ id, done: true, error: message }));
    return id;
  }

  next() {
    const [who] = this.queued.keys();
    const asked = who && this.queued.get(who);
    if (this.running !== undefined || !asked) return;
    this.queued.delete(who);
    this.running = this.post("run", ...asked);
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
