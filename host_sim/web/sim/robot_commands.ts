/* The commands sent to a run's robots, in the order of tools/run. */

import { ANSWER_WANTS_RANGES, CELL_COUNT, OPCODE, PARAMETERS, PROFILES } from "../generated.js";
import type { Experiment, RobotChange, RobotSetup } from "../types.js";
import type { NativeRun } from "./native_run.js";

const HALF = CELL_COUNT / 2;
const UPPER_HALF = 1 << HALF;
const ALL_CELLS = Array.from({ length: CELL_COUNT }, (_, cell) => cell);

/** `wantsRanges` tells for each robot whether its behaviour asks for distances. */
export class RobotCommands {
  setups: (RobotSetup & { seed: number })[];
  wantsRanges: boolean[] = [];

  /** @param experiment - How the robots are set up. */
  constructor(readonly native: NativeRun, { robots, seed }: Experiment) {
    this.setups = robots.map((setup, robot) => ({ ...setup, seed: setup.seed ?? seed + robot }));
  }

  /** Starts all robots as they are set up. */
  startAll() {
    for (const [robot, { profile, memory }] of this.setups.entries()) {
      this.start(robot, profile);
      if (memory) this.writeMemory(robot, memory);
    }
  }

  start(robot: number, profile: string) {
    const { native } = this;
    const { seed, settings } = this.setups[robot];
    native.command(robot, OPCODE.START, PROFILES.indexOf(profile), seed);
    this.wantsRanges[robot] = Boolean(native.c.page_answer_value() & ANSWER_WANTS_RANGES);
    for (const [name, value] of Object.entries(settings)) this.set(robot, name, value);
  }

  stop(robot: number) {
    this.send(robot, OPCODE.STOP);
  }

  /** Asks a robot that has stopped by itself for a report. */
  askIfHalted(robot: number) {
    if (this.native.c.page_has_halted(robot)) this.send(robot, OPCODE.REPORT);
  }

  carryOut(change: RobotChange) {
    const { robot } = change;
    if (change.do === "write") this.writeSide(robot, change.cell, change.side);
    else if (change.do === "erase") this.send(robot, OPCODE.ERASE);
    else if (change.do === "set") this.set(robot, change.parameter, change.value);
    else if (change.do === "command") this.send(robot, change.opcode, change.which, change.value);
    else if (change.do === "freeze") this.native.command(robot, OPCODE.FREEZE, change.on);
    else this.start(robot, change.profile);
  }

  /** @param name - The name of a parameter. */
  set(robot: number, name: string, value: number) {
    this.native.command(robot, OPCODE.SET, Object.keys(PARAMETERS).indexOf(name), value);
  }

  /** Writes all eight bytes, translated to what the robot understands. */
  writeMemory(robot: number, memory: number[]) {
    const { native } = this;
    native.bytes.set(memory);
    if (!native.c.page_translate(robot)) throw new Error("these eight bytes are not a robot's memory");
    this.write(robot, [...native.bytes], ALL_CELLS);
  }

  /** Writes the turn for one pattern. */
  writeSide(robot: number, cell: number, side: number) {
    const { native } = this;
    const before = native.memory(robot);
    native.bytes.set(before);
    native.c.page_write_side(robot, cell, side);
    const after = [...native.bytes];
    this.write(robot, after, ALL_CELLS.filter((i) => after[i] !== before[i] || (i === cell && !after[0])));
  }

  /**
   * Writes some bytes of a memory.
   * @param cells - Those to write.
   */
  write(robot: number, memory: number[], cells: number[]) {
    if (cells.length === CELL_COUNT && !memory.some(Boolean)) this.send(robot, OPCODE.ERASE);
    else {
      for (const first of [0, HALF]) this.writeHalf(robot, memory, cells.filter((cell) => cell >= first && cell < first + HALF));
    }
  }

  /** @param cells - Cells of one half. */
  writeHalf(robot: number, memory: number[], cells: number[]) {
    if (!cells.length) return;
    const [mask, value] = cells.reduce(
      ([bits, bytes], cell) => [bits | (1 << cell % HALF), bytes | (memory[cell] << (8 * (cell % HALF)))], [0, 0],
    );
    this.send(robot, OPCODE.WRITE, mask | (cells[0] >= HALF ? UPPER_HALF : 0), value);
  }

  /** Sends a command, and takes the reports that follow it. */
  send(robot: number, opcode: number, which = 0, value = 0) {
    this.native.command(robot, opcode, which, value);
    this.native.c.page_take_reports(robot);
  }
}
