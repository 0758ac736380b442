/* The C code behind a run: page.wasm, whose interface is native/page.h. An instance is a run. */

import { CELL_COUNT, ROW } from "../generated.js";

/** What page.wasm exports: functions that take and return numbers, and its memory. */
type Exports = Record<string, (...numbers: number[]) => number> & { memory: WebAssembly.Memory };

/** A CAN frame. */
export type Frame = { id: number; data: Uint8Array };

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
  c = new WebAssembly.Instance(this.module).exports as unknown as Exports;

  /**
   * @param module - page.wasm, compiled.
   * @param robots - Number of robots, 1..PAGE_ROBOTS_MAX.
   */
  constructor(readonly module: WebAssembly.Module, robots: number) {
    if (!this.c.page_open(robots)) throw new Error("not enough memory for another run");
  }

  /**
   * Gives a robot a frame.
   * @returns What it answers.
   */
  exchange(robot: number, { id, data }: Frame): Frame[] {
    this.bytes.fill(0);
    this.bytes.set(data);
    const count = this.c.page_exchange(robot, id, data.length);
    const first = this.c.page_answers(robot);
    return Array.from({ length: count }, (_, i) => this.frameAt(first + i * FRAME_BYTES));
  }

  /**
   * Sends a command; its frames go to the log.
   * @param which - As in `struct command`.
   * @returns The answer's result.
   */
  command(robot: number, opcode: number, which = 0, value = 0): number {
    return this.c.page_command(robot, opcode, which, value);
  }

  /** What a COMMAND to a robot says, as in `struct command`. */
  readCommand(robot: number, data: Uint8Array) {
    this.bytes.set(data);
    const opcode = this.c.page_read_command(robot);
    return { opcode, which: this.c.page_command_which(), value: this.c.page_command_value() >>> 0 };
  }

  /** A robot's eight bytes. */
  memory(robot: number) {
    return [...this.bytesAt(this.c.page_memory(robot), CELL_COUNT)];
  }

  /** The turn that a robot knows for each pattern. */
  sides(robot: number) {
    return [...this.bytesAt(this.c.page_sides(robot), CELL_COUNT)];
  }

  /** The lines of the log since it was taken last. */
  takeLog() {
    const lines = this.bytesAt(this.c.page_log(), this.c.page_log_used()).slice();
    this.c.page_clear_log();
    return lines;
  }

  /** What C has recorded of a robot in the last block. */
  block(robot: number, ticks: number) {
    const { c } = this;
    const { buffer } = c.memory;
    const rows = new Int16Array(buffer, c.page_rows(robot), ticks * ROW.length);
    const poses = new Float64Array(buffer, c.page_poses(robot), ticks * AXES);
    return { ticks, rows, poses };
  }

  /**
   * Hands over what the next call of C wants.
   * @param numbers - In the order of native/page.h.
   */
  handOver(numbers: number[], text = "") {
    const bytes = new TextEncoder().encode(text.slice(0, TEXT_MAX));
    this.doublesAt(this.c.page_numbers(), numbers.length).set(numbers);
    this.bytesAt(this.c.page_text(), bytes.length + 1).set([...bytes, 0]);
  }

  /** Numbers in its memory. */
  doublesAt(at: number, count: number) {
    return new Float64Array(this.c.memory.buffer, at, count);
  }

  /**
   * Tables in its memory: the number of rows of each, then the numbers of all rows.
   * @param sizes - Of each table, the numbers of a row.
   */
  tablesAt(at: number, sizes: number[]) {
    const counts = [...this.doublesAt(at, sizes.length)];
    const end = counts.reduce((sum, count, i) => sum + count * sizes[i], sizes.length);
    const numbers = [...this.doublesAt(at, end)].slice(sizes.length);
    return counts.map((count, i) => Array.from({ length: count }, () => numbers.splice(0, sizes[i])));
  }

  /** Whole numbers in its memory. */
  numbersAt(at: number, count: number) {
    return new Int32Array(this.c.memory.buffer, at, count);
  }

  /** A text in its memory, up to its 0. */
  textAt(at: number) {
    const bytes = new Uint8Array(this.c.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  /** What is handed over to C. */
  get bytes() {
    return this.bytesAt(this.c.page_bytes(), CELL_COUNT);
  }

  bytesAt(at: number, length: number) {
    return new Uint8Array(this.c.memory.buffer, at, length);
  }

  frameAt(at: number): Frame {
    const view = new DataView(this.c.memory.buffer, at, FRAME_BYTES);
    return { id: view.getUint32(0, true), data: this.bytesAt(at + DATA_AT, view.getUint8(LENGTH_AT)).slice() };
  }
}
