// @ts-check
/* What a robot has learned in a run, told by C: its turns and trials, and its lessons. */

/**
 * @typedef {import("../types.js").Lesson} Lesson
 * @typedef {import("../types.js").Trial} Trial
 *
 * A turn or a trial that began, or a trial that ended; `trial` is the last one, after it.
 * @typedef {{tick: number, reason: number, cell: number, trial: Trial | null}} Note
 */

/** In `struct history_note` and `struct history_lesson`, as 32-bit numbers; the ticks are doubles. */
const NOTE_NUMBERS = 10;
const LESSON_NUMBERS = 3;

/** Built from the blocks of a run, in order. */
export class LearningHistory {
  /**
   * @param {import("./native_run.js").NativeRun} native
   * @param {number} robot
   */
  constructor(native, robot) {
    this.native = native;
    this.robot = robot;
    /** @type {Lesson[]} */
    this.lessons = [];
    native.c.page_history_begin(robot);
  }

  /**
   * Adds the last block.
   * @param {number} tick - Its first one, from the start of the run.
   * @param {number} ticks
   */
  take(tick, ticks) {
    const count = this.native.c.page_history_take(this.robot, tick);
    this.addLessons(tick + ticks - 1);
    return Array.from({ length: count }, (_, i) => this.noteAt(this.native.c.page_notes() + 4 * NOTE_NUMBERS * i));
  }

  /**
   * Adds a lesson for each pattern whose turn has changed: it was told.
   * @param {number} tick - The next one.
   */
  relearn(tick) {
    this.native.c.page_history_relearn(this.robot, tick);
    this.addLessons(tick);
  }

  /** @param {number} tick - Of new lessons. */
  addLessons(tick) {
    const { c } = this.native;
    const numbers = this.native.numbersAt(c.page_lessons(this.robot), LESSON_NUMBERS * c.page_lesson_count(this.robot));
    for (let at = 0; at < numbers.length; at += LESSON_NUMBERS) {
      const [cell, side, by_hand] = numbers.slice(at, at + LESSON_NUMBERS);
      this.lessons.push({ node: this.robot + 1, tick, cell, side, by_hand });
    }
  }

  /**
   * @param {number} at
   * @returns {Note}
   */
  noteAt(at) {
    const [tick, , begun] = this.native.doublesAt(at, NOTE_NUMBERS / 2);
    const [, , reason, its, , , cell, side, helped, frozen] = this.native.numbersAt(at, NOTE_NUMBERS);
    const trial = begun < 0 ? null : { tick: begun, cell, side, helped: helped < 0 ? null : helped, frozen };
    return { tick, reason, cell: its, trial };
  }
}
