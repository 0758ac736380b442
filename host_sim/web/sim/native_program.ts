/* Programs for robots in page.wasm, and their state: see native/page_program.c. */

import { PROGRAM_TEXT_MAX } from "../generated.js";
import type { NativeRun } from "./native_run.js";

/** A step of a program: its line, from 1, and, unless cell is negative, the new value of a cell. */
type Step = { line: number; cell: number; value: number };

/** A variable, or an array, which has several cells. */
type Variable = { name: string; cell: number; size: number };

/**
 * What was expected in place of a word: an `enum program_expected`, and in words. The word is empty at the end of a line.
 */
type Mistake = { line: number; word: string; expected: number; words: string };

/** The steps of a program's last decision, its cells before them, and what it shows. */
export type ProgramState = { ended: boolean; mistake: Mistake | null; steps: Step[]; variables: Variable[]; before: number[]; shown: string[]; printed: string[] };

/** Numbers of page_program_state before its tables. */
const FIRST = 5;

/** The last lines that are kept of what a program has printed. */
const LINES_PRINTED = 8;

/** Makes a program a robot's brain, before the robot is started. */
export function loadProgram(native: NativeRun, robot: number, text: string) {
  const bytes = new TextEncoder().encode(text);
  if (bytes.length >= PROGRAM_TEXT_MAX) throw new Error(`a program has up to ${PROGRAM_TEXT_MAX - 1} bytes, not ${bytes.length}`);
  native.bytesAt(native.c.page_program_text(), bytes.length).set(bytes);
  if (!native.c.page_program(robot, bytes.length)) throw new Error("not enough memory for another program");
}

/**
 * @param robot - Has a program.
 * @param text - That program.
 */
export function programState(native: NativeRun, robot: number, text: string): ProgramState {
  const { c } = native;
  const at = c.page_program_state(robot);
  const [ended, line, expected, cells, shown] = native.doublesAt(at, FIRST);
  const [steps, variables] = native.tablesAt(at + FIRST * Float64Array.BYTES_PER_ELEMENT, [3, 4]);
  const bytes = new TextEncoder().encode(text);
  const mistake = { line, word: native.textAt(c.page_program_word(robot)), expected, words: native.textAt(c.page_program_expected(expected)) };
  const printed = native.textAt(c.page_program_printed(robot)).split("\n").filter(Boolean);
  return {
    ended: ended !== 0,
    mistake: expected ? mistake : null,
    steps: steps.map(([row, cell, value]) => ({ line: row, cell, value })),
    variables: variables.map(
      ([cell, size, first, length]) => ({ name: new TextDecoder().decode(bytes.subarray(first, first + length)), cell, size }),
    ),
    before: [...native.doublesAt(c.page_program_cells(robot), cells)],
    shown: Array.from({ length: shown }, (_, place) => native.textAt(c.page_program_shown(robot, place))),
    printed: printed.slice(-LINES_PRINTED),
  };
}
