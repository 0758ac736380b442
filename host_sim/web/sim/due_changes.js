// @ts-check
/* The changes of an experiment, each made when its tick comes. */

import { EditError } from "./arena.js";

/** @typedef {Change & {tick: number}} TimedChange */

/** `refusals` has the reason for each change that could not be made, by its index among the changes. */
export class DueChanges {
  /** @param {TimedChange[]} changes - In the order of their ticks. */
  constructor(changes) {
    this.changes = changes;
    this.next = 0;
    /** @type {Map<number, string>} */
    this.refusals = new Map();
  }

  /** The tick of the next one; infinite if there is none. */
  get nextTick() {
    return this.changes[this.next]?.tick ?? Infinity;
  }

  /**
   * Makes those of a tick.
   * @param {number} tick
   * @param {(change: TimedChange) => void} make - Throws an EditError if a change cannot be made.
   */
  makeThoseOf(tick, make) {
    for (; this.nextTick === tick; this.next += 1) {
      try {
        make(this.changes[this.next]);
      } catch (error) {
        if (!(error instanceof EditError)) throw error;
        this.refusals.set(this.next, error.message);
      }
    }
  }
}
