// @ts-check
/* A run in the page: robots in one environment after the other. The same frames as those of tools/run. */

import { SOUND, faultNumbers, measured, noiseKey, withFault } from "./body_faults.js";
import { EDIT_FIELDS } from "./edit_fields.js";
import { ANSWER_WANTS_RANGES, CELL_COUNT, FEEL, OPCODE, PARAMETERS, PROFILES, RANGE_NONE } from "./generated.js";
import { generate } from "./layouts.js";
import { NativeRun } from "./native_run.js";
import { rangesOf, wallsOf } from "./ranges.js";
import { RunRecorder } from "./run_recorder.js";
import { EditError, Furniture } from "./world_edits.js";
import { RANDOM } from "./world_names.js";
import { worldOf } from "./worlds.js";

/**
 * @typedef {import("./layouts.js").Pose} Pose
 * @typedef {import("./layouts.js").SimParams} SimParams
 * @typedef {import("./types.js").Change} Change
 * @typedef {import("./types.js").Experiment} Experiment
 * @typedef {import("./types.js").RobotSetup} RobotSetup
 */

/** The order of the dimensions in native/page.h. */
const DIMENSIONS = /** @type {const} */ ([
  "width_mm", "height_mm", "body_radius_mm", "wheel_track_mm", "sensor_reach_mm", "front_extra_mm", "beam_width_mm",
  "eat_reach_mm", "tick_s", "max_wheel_speed_mm_s",
]);
const BLOCK_TICKS = 256;
const HALF = CELL_COUNT / 2;
const UPPER_HALF = 1 << HALF;
const ALL_CELLS = Array.from({ length: CELL_COUNT }, (_, cell) => cell);

/**
 * Takes robots through their environments. `refusals` are the changes that could not be made: by their place among the
 * experiment's changes, why not.
 */
export class Simulation {
  /**
   * @param {WebAssembly.Module} module - page.wasm, compiled.
   * @param {Experiment} experiment
   * @param {import("./worlds.js").Worlds} worlds
   * @param {boolean} [keepsLog] - Whether to record every frame.
   */
  constructor(module, experiment, worlds, keepsLog = false) {
    this.experiment = experiment;
    this.world = worldOf(experiment.world ?? RANDOM, worlds);
    const { params } = this.world;
    this.params = params;
    this.native = new NativeRun(module, experiment.robots.length);
    this.native.build(DIMENSIONS.map((name) => params[name]));
    this.tick = 0;
    this.nextChange = 0;
    /** @type {Map<number, string>} */
    this.refusals = new Map();
    /** @type {Uint8Array[] | undefined} */
    this.log = keepsLog ? [] : undefined;
    /** @type {import("./types.js").EnvironmentScene} */
    this.scene = { number: 0, of: experiment.environments, seed: experiment.seed, first_tick: 0, start_tick: 0, bars: [], food: [] };
    this.bodies = experiment.robots.map(() => ({ x: 0, y: 0, heading: 0, lifted: false }));
    /** @type {import("./body_faults.js").Faults[]} */
    this.faults = experiment.robots.map(() => SOUND);
    this.wantsRanges = experiment.robots.map(() => false);
    this.startRobots();
    this.recorder = new RunRecorder(measuresOf(params, experiment), experiment.robots.map((_, robot) => this.native.sides(robot)));
    this.furniture = new Furniture({ bars: [], food: [], starts: [] }, params);
  }

  /**
   * Runs all environments; pauses after each.
   * @returns {Generator<number, void>} The number of each.
   */
  *run() {
    const { environments, limit_ticks, ticks_max = Infinity } = this.experiment;
    for (let number = 1; number <= environments && this.tick < ticks_max; number += 1) {
      this.enter(number);
      const end = Math.min(this.tick + limit_ticks, ticks_max);
      while (this.tick < end && this.eaten.includes(0)) this.runBlock(end);
      this.settle();
      yield number;
    }
    for (const robot of this.bodies.keys()) this.stop(robot);
  }

  /** Runs all that is left. */
  finish() {
    const run = this.run();
    while (!run.next().done) continue;
  }

  /** What was recorded so far. */
  result() {
    const { seed, environments } = this.experiment;
    return this.recorder.result(`seed ${seed}, ${environments} environment${environments === 1 ? "" : "s"}`);
  }

  /** For each piece of food, 1 if it was eaten. */
  get eaten() {
    return this.furniture.food.map((_, i) => this.native.c.page_is_eaten(i));
  }

  /** As in the handshake of tools/run, then its starts. */
  startRobots() {
    for (const robot of this.bodies.keys()) this.stop(robot);
    for (const [robot, setup] of this.experiment.robots.entries()) {
      this.startRobot(robot, setup.profile);
      if (setup.memory) this.writeMemory(robot, setup.memory);
    }
  }

  /** Asks robots that have stopped by themselves how they are: of their frames, not each came when it should. */
  settle() {
    for (const robot of this.bodies.keys()) {
      if (!this.native.c.page_has_halted(robot)) continue;
      this.native.command(robot, OPCODE.REPORT);
      this.native.c.page_take_reports(robot);
    }
    this.keepLog();
  }

  /** @param {number} robot */
  stop(robot) {
    this.native.command(robot, OPCODE.STOP);
    this.native.c.page_take_reports(robot);
    this.keepLog();
  }

  /**
   * @param {number} robot
   * @param {string} profile
   */
  startRobot(robot, profile) {
    const { native } = this;
    const { seed = this.experiment.seed + robot } = this.experiment.robots[robot];
    native.command(robot, OPCODE.START, PROFILES.indexOf(profile), seed);
    this.wantsRanges[robot] = Boolean(native.c.page_answer_value() & ANSWER_WANTS_RANGES);
    for (const [name, value] of Object.entries(this.experiment.robots[robot].settings)) this.set(robot, name, value);
  }

  /**
   * @param {number} robot
   * @param {string} name
   * @param {number} value
   */
  set(robot, name, value) {
    this.native.command(robot, OPCODE.SET, Object.keys(PARAMETERS).indexOf(name), value);
  }

  /**
   * Writes all eight bytes, translated to what the robot understands.
   * @param {number} robot
   * @param {number[]} memory
   */
  writeMemory(robot, memory) {
    const { native } = this;
    native.bytes.set(memory);
    if (!native.c.page_translate(robot)) throw new Error("these eight bytes are no memory of a robot");
    this.write(robot, [...native.bytes], ALL_CELLS);
  }

  /**
   * Writes some bytes of a memory.
   * @param {number} robot
   * @param {number[]} memory
   * @param {number[]} cells - Those to write.
   */
  write(robot, memory, cells) {
    if (cells.length === CELL_COUNT && !memory.some(Boolean)) this.command(robot, OPCODE.ERASE);
    else {
      for (const first of [0, HALF]) this.writeHalf(robot, memory, cells.filter((cell) => cell >= first && cell < first + HALF));
    }
  }

  /**
   * @param {number} robot
   * @param {number[]} memory
   * @param {number[]} cells - Of one half.
   */
  writeHalf(robot, memory, cells) {
    if (!cells.length) return;
    const [mask, value] = cells.reduce(
      ([bits, bytes], cell) => [bits | (1 << cell % HALF), bytes | (memory[cell] << (8 * (cell % HALF)))], [0, 0],
    );
    this.command(robot, OPCODE.WRITE, mask | (cells[0] >= HALF ? UPPER_HALF : 0), value);
  }

  /**
   * A command that changes the memory, and the report of what it is now.
   * @param {number} robot
   * @param {number} opcode
   * @param {number} [which]
   * @param {number} [value]
   */
  command(robot, opcode, which = 0, value = 0) {
    this.native.command(robot, opcode, which, value);
    this.native.c.page_take_reports(robot);
  }

  /** @param {number} number */
  enter(number) {
    const { experiment, params } = this;
    const { c } = this.native;
    const which = { seed: experiment.seed, number, robots: this.bodies.length };
    const layout = generate(which, this.world, { sin: c.page_sin, cos: c.page_cos });
    this.furniture = new Furniture(layout, params);
    layout.starts.forEach((start, robot) => this.putDown(robot, start));
    this.placeFurniture();
    c.page_enter(layout.bars.length, layout.food.length);
    this.scene = { ...this.scene, number, first_tick: this.tick };
    this.show();
  }

  /**
   * @param {number} robot
   * @param {Pose} pose
   */
  putDown(robot, [x, y, heading]) {
    this.native.c.page_put_body(robot, x, y, heading);
    this.bodies[robot] = { x, y, heading, lifted: false };
  }

  placeFurniture() {
    const { c } = this.native;
    this.furniture.capsules.forEach((capsule, i) => c.page_put_obstacle(i, ...capsule));
    this.furniture.food.forEach((at, i) => c.page_put_food(i, ...at));
  }

  /** Records the scene as it is now. */
  show() {
    const tenths = (/** @type {number[]} */ places) => places.map((mm) => Math.round(mm * 10) / 10);
    const bars = [...this.furniture.bars].map(([id, bar]) => [id, ...tenths(bar)]);
    const plants = [...this.furniture.plants].map(([id, plant]) => [id, ...tenths(plant)]);
    const { plants: _, ...before } = this.scene;
    this.scene = { ...before, bars, food: this.furniture.food.map(tenths), ...(plants.length && { plants }) };
    this.recorder.enter(this.scene);
  }

  /** @param {number} end - The tick at which the environment ends. */
  runBlock(end) {
    this.makeChanges();
    this.keepLog();
    const { changes } = this.experiment;
    const measures = this.wantsRanges.includes(true);
    const next = Math.min(end, changes[this.nextChange]?.tick ?? end);
    const before = this.bodies.map((_, robot) => this.native.sides(robot));
    if (measures) this.sendRanges();
    const ticks = this.native.c.page_run(this.tick, measures ? 1 : Math.min(next - this.tick, BLOCK_TICKS));
    this.keepLog();
    if (!ticks) throw new Error(`a robot does not answer tick ${this.tick}: it was not started, or was stopped`);
    this.bodies.forEach((_, robot) => this.record(robot, ticks, before[robot]));
    this.tick += ticks;
    this.recorder.eat(this.eaten);
  }

  /**
   * @param {number} robot
   * @param {number} ticks
   * @param {number[]} before
   */
  record(robot, ticks, before) {
    const block = this.native.block(robot, ticks);
    this.recorder.tracks[robot].add(block, before, this.native.sides(robot));
    const [x, y, heading] = block.poses.slice(-3);
    Object.assign(this.bodies[robot], { x, y, heading });
  }

  /** Tells the robots that want it how far away things are. */
  sendRanges() {
    this.setTime();
    const { params, native } = this;
    const obstacles = [...wallsOf(params), ...this.furniture.capsules];
    for (const [robot, { x, y, heading, lifted }] of this.bodies.entries()) {
      if (!this.wantsRanges[robot]) continue;
      const others = this.bodies.filter((_, i) => i !== robot && !this.bodies[i].lifted);
      const discs = others.map((at) => /** @type {import("./ranges.js").Capsule} */ ([at.x, at.y, at.x, at.y, params.body_radius_mm]));
      const things = lifted ? [] : [...obstacles, ...discs];
      const ranges = rangesOf([x, y, heading], things, params, RANGE_NONE).slice(0, Object.keys(FEEL).length);
      native.bytes.set(measured(ranges, this.faults[robot], RANGE_NONE));
      native.c.page_send_ranges(robot, this.tick);
    }
    this.keepLog();
  }

  /** Makes the changes that are due. */
  makeChanges() {
    const { changes } = this.experiment;
    for (; changes[this.nextChange]?.tick === this.tick; this.nextChange += 1) {
      try {
        this.change(changes[this.nextChange]);
      } catch (error) {
        if (!(error instanceof EditError)) throw error;
        this.refusals.set(this.nextChange, error.message);
      }
    }
  }

  /** @param {Change} change */
  change(change) {
    if (isWorldEdit(change)) this.changeWorld(change);
    else this.changeRobot(change);
  }

  /** @param {import("./types.js").WorldEdit} edit */
  changeWorld(edit) {
    if ("robot" in edit && !this.bodies[edit.robot ?? 0]) throw new EditError(`there is no such robot; there are ${this.bodies.length}`);
    if (edit.do === "lift") this.lift(edit.robot ?? 0);
    else if (edit.do === "put") this.put(edit.robot ?? 0, edit);
    else if (edit.do === "body") this.breakBody(edit.robot ?? 0, edit);
    else this.furniture.edit(edit, this.bodies);
    this.placeFurniture();
    this.native.c.page_settle(this.furniture.capsules.length);
    this.recorder.edits.push({ ...edit, tick: this.tick });
    this.show();
  }

  /** @param {number} robot */
  lift(robot) {
    if (this.bodies[robot].lifted) throw new EditError("the robot is in the air already");
    this.native.c.page_lift(robot);
    this.bodies[robot].lifted = true;
  }

  /**
   * @param {number} robot
   * @param {{at: [number, number], heading: number}} where
   */
  put(robot, { at, heading }) {
    const others = this.bodies.filter((_, i) => i !== robot);
    if (!this.bodies[robot].lifted) throw new EditError("the robot is not in the air");
    if (!this.furniture.hasRoom(at, others)) throw new EditError("there is no room for the robot");
    this.putDown(robot, [...at, heading / 1000]);
  }

  /**
   * @param {number} robot
   * @param {{what: string, seed?: number}} edit
   */
  breakBody(robot, { what, seed = 0 }) {
    const faults = withFault(this.faults[robot], what, noiseKey(seed, robot));
    if (!faults) throw new EditError(`'${what}' cannot happen to a body`);
    this.faults[robot] = faults;
    this.native.setFaults(robot, faultNumbers(faults));
  }

  /** @param {Exclude<Change, import("./types.js").WorldEdit>} change */
  changeRobot(change) {
    const { robot } = change;
    const { history } = this.recorder.tracks[robot];
    this.setTime();
    if (change.do === "write") this.writeSide(robot, change.cell, change.side);
    else if (change.do === "erase") this.command(robot, OPCODE.ERASE);
    else if (change.do === "set") this.set(robot, change.parameter, change.value);
    else if (change.do === "command") this.command(robot, change.opcode, change.which, change.value);
    else if (change.do === "freeze") {
      this.native.command(robot, OPCODE.FREEZE, change.on);
      history.frozen = change.on;
    } else {
      this.startRobot(robot, change.profile);
      history.restart();
    }
    history.relearn(this.tick, this.native.sides(robot));
  }

  /**
   * Writes the turn for one pattern.
   * @param {number} robot
   * @param {number} cell
   * @param {number} side
   */
  writeSide(robot, cell, side) {
    const { native } = this;
    const before = native.memory(robot);
    native.bytes.set(before);
    native.c.page_write_side(robot, cell, side);
    const after = [...native.bytes];
    this.write(robot, after, ALL_CELLS.filter((i) => after[i] !== before[i] || (i === cell && !after[0])));
  }

  /** Sets the log's time to that of the next tick. */
  setTime() {
    this.native.c.page_set_time(Math.round(this.tick * this.params.tick_s * 1e6));
  }

  keepLog() {
    const lines = this.native.takeLog();
    if (lines.length) this.log?.push(lines);
  }
}

/**
 * Whether it changes the world or the bodies in it; all else is said to a robot.
 * @param {Change} change
 * @returns {change is import("./types.js").WorldEdit}
 */
function isWorldEdit(change) {
  return EDIT_FIELDS.has(change.do);
}

/**
 * The dimensions that a drawing needs, as host_sim/view/state.py has them.
 * @param {SimParams} params
 * @param {Experiment} experiment
 * @returns {import("./types.js").Measures}
 */
function measuresOf(params, { robots }) {
  return {
    width: params.width_mm,
    height: params.height_mm,
    body: params.body_radius_mm,
    track: params.wheel_track_mm,
    reach: params.sensor_reach_mm,
    beam: params.beam_width_mm,
    eat: params.eat_reach_mm,
    bar: params.bar_thickness_mm,
    tick_ms: params.tick_s * 1000,
    boredom: robots[0].settings.boredom_limit ?? PARAMETERS.boredom_limit.default,
  };
}
