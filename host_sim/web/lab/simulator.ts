/* Asks the worker for runs. Of an experiment that changes meanwhile, only the newest version is simulated next. */

import type { Answer, Answers } from "../sim/page_worker.js";
import type { Experiment } from "../types.js";
import type { Parts } from "./laboratory.js";

export type OnAnswer = (answer: Answer) => void;

/** Has one worker; answers come in the order of the questions. */
export class Simulator {
  lastId = 0;
  waiting: Map<number, OnAnswer> = new Map();
  /** What is to be run next, by caller. */
  queued: Map<object, [Experiment, OnAnswer]> = new Map();
  /** The run that is simulated now. */
  running: number | undefined;
  begun: Worker | undefined;

  constructor(readonly parts: Parts) {}

  get worker() {
    return (this.begun ??= this.begin(this.parts));
  }

  begin({ wasm, worker, worlds }: Parts) {
    const begun = new Worker(URL.createObjectURL(new Blob([worker], { type: "text/javascript" })));
    begun.addEventListener("message", ({ data }) => this.take(data));
    begun.postMessage({ do: "begin", wasm, worlds });
    return begun;
  }

  /**
   * Queues an experiment to run; it replaces one that waits there for the same caller.
   * @param onAnswer - Called after the first environment and at the end.
   */
  run(who: object, experiment: Experiment, onAnswer: OnAnswer) {
    this.queued.set(who, [experiment, onAnswer]);
    this.next();
  }

  /** Asks for something other than a run. */
  ask<K extends keyof Answers>(what: K, asked: Parameters<Answers[K]>[0]): Promise<ReturnType<Answers[K]>> {
    return new Promise((resolve, reject) => {
      this.post(what, asked, ({ answer, error }) => (error ? reject(new Error(error)) : resolve(answer)));
    });
  }

  post(what: "run" | keyof Answers, asked: object, onAnswer: OnAnswer) {
    this.lastId += 1;
    const [id, { why }] = [this.lastId, this.parts];
    this.waiting.set(id, onAnswer);
    if (why) setTimeout(() => this.take({ id, done: true, error: why }));
    else this.worker.postMessage({ do: what, id, asked });
    return id;
  }

  next() {
    const [who] = this.queued.keys();
    const asked = who && this.queued.get(who);
    if (this.running !== undefined || !asked) return;
    this.queued.delete(who);
    this.running = this.post("run", ...asked);
  }

  take(answer: Answer) {
    this.waiting.get(answer.id)?.(answer);
    if (!answer.done) return;
    this.waiting.delete(answer.id);
    if (answer.id === this.running) this.running = undefined;
    this.next();
  }
}
