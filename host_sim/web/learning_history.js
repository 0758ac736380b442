// @ts-check
/* What a robot has learned in a run: its trials and their results, and its lessons; as host_sim/view/history.py has it. */

import { CELL_COUNT, REASON, SIDE } from "./generated.js";

/**
 * @typedef {import("./types.js").Lesson} Lesson
 * @typedef {import("./types.js").Trial} Trial
 *
 * What counts of a tick.
 * @typedef {{feel: number, left: number, right: number, reason: number, action: number, pattern: number}} Tick
 */

/** Built from the ticks of a run, in order, in which something begins. */
export class LearningHistory {
  /**
   * @param {number} node
   * @param {number[]} sides - The turn for each pattern before the first tick.
   */
  constructor(node, sides) {
    this.node = node;
    this.sides = sides;
    this.frozen = 0;
    this.pattern = 0;
    this.action = -1;
    /** @type {number} */
    this.reason = REASON.STOP;
    /** @type {Trial | null} */
    this.trial = null;
    /** @type {Lesson[]} */
    this.lessons = [];
  }

  /**
   * Adds a tick.
   * @param {number} number - Of the tick, from the start of the run.
   * @param {Tick} tick
   * @param {number[]} sides - The turn for each pattern after it.
   */
  take(number, tick, sides) {
    const begins = tick.action !== this.action;
    let judged = null;
    let forgets = false;
    if (begins) {
      this.action = tick.action;
      this.pattern = (tick.feel >> 1) & (CELL_COUNT - 1);
      judged = this.judge();
      forgets = [tick.reason, this.reason].includes(REASON.REMEMBERED) || tick.reason === REASON.BOREDOM;
    }
    this.relearn(number, sides, judged, forgets);
    if (begins) this.begin(number, tick);
  }

  /**
   * Skips ticks in which no turn from the memory and no trial began or ended, and the memory stayed the same.
   * @param {Tick} tick - The last of them.
   */
  passOver({ action, reason, pattern }) {
    [this.action, this.reason, this.pattern] = [action, reason, pattern];
  }

  /**
   * Adds a lesson for each pattern whose turn has changed.
   * @param {number} number - Of the tick.
   * @param {number[]} sides
   * @param {Trial | null} [trial] - The one that has just ended: a turn that it does not explain was written by hand.
   * @param {boolean} [forgets] - Whether the robot itself may just have erased what it used.
   */
  relearn(number, sides, trial = null, forgets = false) {
    sides.forEach((side, cell) => {
      if (side === this.sides[cell]) return;
      const learned = trial?.cell === cell && trial.side === side && trial.helped === 1;
      const itself = learned || (forgets && side === SIDE.NOTHING);
      this.lessons.push({ node: this.node, tick: number, cell, side, by_hand: Number(!itself) });
    });
    this.sides = sides;
  }

  /** The robot has been started again: its lessons stay. */
  restart() {
    [this.frozen, this.trial] = [0, null];
  }

  /** Ends the current trial, if there is one, with the pattern that decides the next action. */
  judge() {
    if (!this.trial || this.trial.helped !== null) return null;
    const fewer = ones(this.pattern) < ones(this.trial.cell);
    this.trial = { ...this.trial, helped: Number(fewer), frozen: this.frozen };
    return this.trial;
  }

  /**
   * @param {number} number
   * @param {Tick} tick
   */
  begin(number, { reason, left, right }) {
    this.reason = reason;
    if (reason !== REASON.TRIAL) return;
    const side = left < right ? SIDE.LEFT : SIDE.RIGHT;
    this.trial = { tick: number, cell: this.pattern, side, helped: null, frozen: 0 };
  }
}

/** @param {number} pattern */
function ones(pattern) {
  return [1, 2, 4].filter((bit) => pattern & bit).length;
}
