// @ts-check
/* Programs for robots in page.wasm, and their state: see native/page_program.c. */

import { PROGRAM_TEXT_MAX } from "../generated.js";

/**
 * @typedef {import("./native_run.js").NativeRun} NativeRun
 *
 * A step of a program: its line, from 1, and, unless cell is negative, the new value of a cell.
 * @typedef {{line: number, cell: number, value: number}} Step
 *
 * A variable, or an array, which has several cells.
 * @typedef {{name: string, cell: number, size: number}} Variable
 *
 * What was expected in place of a word: an `enum program_expected`, and in words. The word is empty at the end of a line.
 * @typedef {{line: number, word: string, expected: number, words: string}} Mistake
 *
 * The steps of a program's last decision, its cells before them, and what it shows.
 * @typedef {{ended: boolean, mistake: Mistake | null, steps: Step[], variables: Variable[], before: number[], shown: string[]}} ProgramState
 */

/** Numbers of page_program_state: the first ones, and those of a step and of a variable. */
const FIRST = 7;
const STEP = 3;
const VARIABLE = 4;

/**
 * Makes a program a robot's brain, before the robot is started.
 * @param {NativeRun} native
 * @param {number} robot
 * @param {string} text
 */
export function loadProgram(native, robot, text) {
  const bytes = new TextEncoder().encode(text);
  if (bytes.length >= PROGRAM_TEXT_MAX) throw new Error(`a program has up to ${PROGRAM_TEXT_MAX - 1} bytes, not ${bytes.length}`);
  native.bytesAt(native.c.page_program_text(), bytes.length).set(bytes);
  if (!native.c.page_program(robot, bytes.length)) throw new Error("not enough memory for another program");
}

/**
 * @param {NativeRun} native
 * @param {number} robot - Has a program.
 * @param {string} text - That program.
 * @returns {ProgramState}
 */
export function programState(native, robot, text) {
  const { c } = native;
  const at = c.page_program_state(robot);
  const [ended, line, expected, cells, shown, steps, variables] = native.doublesAt(at, FIRST);
  const numbers = [...native.doublesAt(at, FIRST + STEP * steps + VARIABLE * variables)];
  const bytes = new TextEncoder().encode(text);
  const mistake = { line, word: textAt(native, c.page_program_word(robot)), expected, words: textAt(native, c.page_program_expected(expected)) };
  return {
    ended: ended !== 0,
    mistake: expected ? mistake : null,
    steps: rowsOf(numbers, FIRST, steps, STEP).map(([row, cell, value]) => ({ line: row, cell, value })),
    variables: rowsOf(numbers, FIRST + STEP * steps, variables, VARIABLE).map(
      ([cell, size, first, length]) => ({ name: new TextDecoder().decode(bytes.subarray(first, first + length)), cell, size }),
    ),
    before: [...native.doublesAt(c.page_program_cells(robot), cells)],
    shown: Array.from({ length: shown }, (_, place) => textAt(native, c.page_program_shown(robot, place))),
  };
}

/**
 * @param {number[]} numbers
 * @param {number} first
 * @param {number} count
 * @param {number} size
 */
function rowsOf(numbers, first, count, size) {
  return Array.from({ length: count }, (_, i) => numbers.slice(first + i * size, first + (i + 1) * size));
}

/**
 * @param {NativeRun} native
 * @param {number} at
 */
function textAt(native, at) {
  const bytes = new Uint8Array(native.c.memory.buffer, at);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}
