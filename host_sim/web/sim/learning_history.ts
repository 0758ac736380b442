/* What a robot has learned in a run, told by C: its turns and trials, and its lessons. */

import { CELL_COUNT, REASON } from "../generated.js";
import type { Lesson, Trial } from "../generated_types.js";
import type { RobotRun } from "../types.js";
import type { NativeRun } from "./native_run.js";

/** What is known of a cell from a tick on: tick, cell, uses, learned, by_hand. */
type Cell = RobotRun["cells"][number];

/** A turn or a trial that began, or a trial that ended; `trial` is the last one, after it. */
export type Note = { tick: number; reason: number; cell: Cell; trial: Trial | null };

/** In `struct history_note` and `struct history_lesson`, as 32-bit numbers; the ticks are doubles. */
const NOTE_NUMBERS = 14;
const LESSON_NUMBERS = 4;

/** Built from the blocks of a run, in order. */
export class LearningHistory {
  lessons: Lesson[] = [];
  cells: Cell[] = [];

  constructor(readonly native: NativeRun, readonly robot: number) {
    this.forgetCells(0);
    native.c.page_history_begin(robot);
  }

  /**
   * Adds the last block.
   * @param tick - Its first one, from the start of the run.
   */
  take(tick: number, ticks: number) {
    const count = this.native.c.page_history_take(this.robot, tick);
    const notes = Array.from({ length: count }, (_, i) => this.noteAt(this.native.c.page_notes() + 4 * NOTE_NUMBERS * i));
    this.cells.push(...notes.filter(({ reason }) => reason === REASON.REMEMBERED).map(({ cell }) => cell));
    this.addLessons(tick + ticks - 1);
    return notes;
  }

  /** Makes all cells unused from a tick on, and when they were learned unknown. */
  forgetCells(tick: number) {
    for (let cell = 0; cell < CELL_COUNT; cell += 1) this.cells.push([tick, cell, 0, -1, 0]);
  }

  /**
   * Adds a lesson for each pattern whose turn has changed: it was told.
   * @param tick - The next one.
   */
  relearn(tick: number) {
    this.native.c.page_history_relearn(this.robot, tick);
    this.addLessons(tick);
  }

  /** @param tick - The tick of new lessons. */
  addLessons(tick: number) {
    const { c } = this.native;
    const numbers = this.native.numbersAt(c.page_lessons(this.robot), LESSON_NUMBERS * c.page_lesson_count(this.robot));
    for (let at = 0; at < numbers.length; at += LESSON_NUMBERS) {
      const [cell, side, uses, by_hand] = numbers.slice(at, at + LESSON_NUMBERS);
      this.lessons.push({ node: this.robot + 1, tick, cell, side, by_hand });
      this.cells.push([tick, cell, uses, tick, by_hand]);
    }
  }

  noteAt(at: number): Note {
    const [tick, , , learned, begun] = this.native.doublesAt(at, NOTE_NUMBERS / 2);
    const [, , reason, pattern, uses, by_hand, , , , , cell, side, helped, frozen] = this.native.numbersAt(at, NOTE_NUMBERS);
    const trial = begun < 0 ? null : { tick: begun, cell, side, helped: helped < 0 ? null : helped, frozen };
    return { tick, reason, cell: [tick, pattern, uses, learned, by_hand], trial };
  }
}
