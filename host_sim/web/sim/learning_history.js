// @ts-check
/* What a robot has learned in a run, told by C: its trials and their results, and its lessons. */

/**
 * @typedef {import("../types.js").Lesson} Lesson
 * @typedef {import("../types.js").Trial} Trial
 */

/** In the order of native/page.h. */
const TRIAL_NUMBERS = 5;
const LESSON_NUMBERS = 3;

/** Built from the ticks of a run, in order, in which something begins. */
export class LearningHistory {
  /**
   * @param {import("./native_run.js").NativeRun} native
   * @param {number} robot
   * @param {number[]} sides - The turn for each pattern before the first tick.
   */
  constructor(native, robot, sides) {
    this.native = native;
    this.robot = robot;
    this.frozen = 0;
    /** @type {Trial | null} */
    this.trial = null;
    /** @type {Lesson[]} */
    this.lessons = [];
    native.bytes.set(sides);
    native.c.page_history_begin(robot);
  }

  /**
   * Adds a tick.
   * @param {number} number - Of the tick, from the start of the run.
   * @param {number} tick - Its place in the last block.
   * @param {number[]} sides - The turn for each pattern after it.
   */
  take(number, tick, sides) {
    this.native.bytes.set(sides);
    this.native.c.page_history_take(this.robot, number, tick);
    this.refresh(number);
  }

  /**
   * Skips ticks in which no turn from the memory and no trial began or ended, and the memory stayed the same.
   * @param {number} tick - The place of the last of them in the last block.
   */
  passOver(tick) {
    this.native.c.page_history_pass_over(this.robot, tick);
  }

  /**
   * Adds a lesson for each pattern whose turn has changed: it was told.
   * @param {number} number - Of the tick.
   * @param {number[]} sides
   */
  relearn(number, sides) {
    this.native.bytes.set(sides);
    this.native.c.page_history_relearn(this.robot, number);
    this.refresh(number);
  }

  /** @param {number} on */
  freeze(on) {
    this.frozen = on;
    this.native.c.page_history_freeze(this.robot, on);
  }

  /**
   * The robot has been started again: its lessons stay.
   * @param {number[]} sides
   */
  restart(sides) {
    [this.frozen, this.trial] = [0, null];
    this.native.bytes.set(sides);
    this.native.c.page_history_restart(this.robot);
  }

  /** @param {number} number - Of the tick of new lessons. */
  refresh(number) {
    const at = this.native.c.page_history(this.robot);
    const [tick, cell, side, helped, frozen, count] = this.native.doublesAt(at, TRIAL_NUMBERS + 1);
    this.trial = tick < 0 ? null : { tick, cell, side, helped: helped < 0 ? null : helped, frozen };
    for (let i = 0; i < count; i += 1) {
      const [its, turn, by_hand] = this.native.doublesAt(at, TRIAL_NUMBERS + 1 + LESSON_NUMBERS * (i + 1)).slice(-LESSON_NUMBERS);
      this.lessons.push({ node: this.robot + 1, tick: number, cell: its, side: turn, by_hand });
    }
  }
}
