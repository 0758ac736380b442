// @ts-check
/* The C code behind a run: page.wasm, whose interface is native/page.h. An instance is a run. */

import { CELL_COUNT, ROW } from "../generated.js";

/**
 * What page.wasm exports: functions that take and return numbers, and its memory.
 * @typedef {Record<string, (...numbers: number[]) => number> & {memory: WebAssembly.Memory}} Exports
 *
 * A CAN frame.
 * @typedef {{id: number, data: Uint8Array}} Frame
 */

/** A `struct frame`: the identifier, the number of bytes, the bytes. */
const FRAME_BYTES = 16;
const LENGTH_AT = 4;
const DATA_AT = 5;
/** Longer texts do not fit into page_text, if each character has three bytes. */
const TEXT_MAX = 80;
/** Numbers of a pose: x, y and heading. */
export const AXES = 3;

/** A run's robots, with an empty memory each. */
export class NativeRun {
  /**
   * @param {WebAssembly.Module} module - page.wasm, compiled.
   * @param {number} robots - Number of robots, 1..PAGE_ROBOTS_MAX.
   */
  constructor(module, robots) {
    this.c = /** @type {Exports} */ (/** @type {unknown} */ (new WebAssembly.Instance(module).exports));
    if (!this.c.page_open(robots)) throw new Error("not enough memory for another run");
  }

  /**
   * Gives a robot a frame.
   * @param {number} robot
   * @param {Frame} frame
   * @returns {Frame[]} What it answers.
   */
  exchange(robot, { id, data }) {
    this.bytes.fill(0);
    this.bytes.set(data);
    const count = this.c.page_exchange(robot, id, data.length);
    const first = this.c.page_answers(robot);
    return Array.from({ length: count }, (_, i) => this.frameAt(first + i * FRAME_BYTES));
  }

  /**
   * Sends a command; its frames go to the log.
   * @param {number} robot
   * @param {number} opcode
   * @param {number} [which] - As in `struct command`.
   * @param {number} [value]
   * @returns {number} The answer's result.
   */
  command(robot, opcode, which = 0, value = 0) {
    return this.c.page_command(robot, opcode, which, value);
  }

  /**
   * What a COMMAND to a robot says, as in `struct command`.
   * @param {number} robot
   * @param {Uint8Array} data
   */
  readCommand(robot, data) {
    this.bytes.set(data);
    const opcode = this.c.page_read_command(robot);
    return { opcode, which: this.c.page_command_which(), value: this.c.page_command_value() >>> 0 };
  }

  /**
   * A robot's eight bytes.
   * @param {number} robot
   */
  memory(robot) {
    return [...this.bytesAt(this.c.page_memory(robot), CELL_COUNT)];
  }

  /**
   * The turn that a robot knows for each pattern.
   * @param {number} robot
   */
  sides(robot) {
    return [...this.bytesAt(this.c.page_sides(robot), CELL_COUNT)];
  }

  /** The lines of the log since it was taken last. */
  takeLog() {
    const lines = this.bytesAt(this.c.page_log(), this.c.page_log_used()).slice();
    this.c.page_clear_log();
    return lines;
  }

  /** What C has recorded of a robot in the last block.
   * @param {number} robot
   * @param {number} ticks
   */
  block(robot, ticks) {
    const { c } = this;
    const { buffer } = c.memory;
    const rows = new Int16Array(buffer, c.page_rows(robot), ticks * ROW.length);
    const poses = new Float64Array(buffer, c.page_poses(robot), ticks * AXES);
    return { ticks, rows, poses };
  }

  /**
   * Hands over what the next call of C wants.
   * @param {number[]} numbers - In the order of native/page.h.
   * @param {string} [text]
   */
  handOver(numbers, text = "") {
    const bytes = new TextEncoder().encode(text.slice(0, TEXT_MAX));
    this.doublesAt(this.c.page_numbers(), numbers.length).set(numbers);
    this.bytesAt(this.c.page_text(), bytes.length + 1).set([...bytes, 0]);
  }

  /**
   * Numbers in its memory.
   * @param {number} at
   * @param {number} count
   */
  doublesAt(at, count) {
    return new Float64Array(this.c.memory.buffer, at, count);
  }

  /**
   * Tables in its memory: the number of rows of each, then the numbers of all rows.
   * @param {number} at
   * @param {number[]} sizes - Of each table, the numbers of a row.
   */
  tablesAt(at, sizes) {
    const counts = [...this.doublesAt(at, sizes.length)];
    const end = counts.reduce((sum, count, i) => sum + count * sizes[i], sizes.length);
    const numbers = [...this.doublesAt(at, end)].slice(sizes.length);
    return counts.map((count, i) => Array.from({ length: count }, () => numbers.splice(0, sizes[i])));
  }

  /**
   * Whole numbers in its memory.
   * @param {number} at
   * @param {number} count
   */
  numbersAt(at, count) {
    return new Int32Array(this.c.memory.buffer, at, count);
  }

  /**
   * A text in its memory, up to its 0.
   * @param {number} at
   */
  textAt(at) {
    const bytes = new Uint8Array(this.c.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  /** What is handed over to C. */
  get bytes() {
    return this.bytesAt(this.c.page_bytes(), CELL_COUNT);
  }

  /**
   * @param {number} at
   * @param {number} length
   */
  bytesAt(at, length) {
    return new Uint8Array(this.c.memory.buffer, at, length);
  }

  /**
   * @param {number} at
   * @returns {Frame}
   */
  frameAt(at) {
    const view = new DataView(this.c.memory.buffer, at, FRAME_BYTES);
    return { id: view.getUint32(0, true), data: this.bytesAt(at + DATA_AT, view.getUint8(LENGTH_AT)).slice() };
  }
}
