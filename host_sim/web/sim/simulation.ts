/* A run in the page: robots in one environment after the other. Its frames are those of tools/run. */

import { Arena, isWorldEdit, EditError } from "./arena.js";
import { drawFrom, drawLayout } from "./native_layouts.js";
import { loadProgram } from "./native_program.js";
import { NativeRun } from "./native_run.js";
import { RobotCommands } from "./robot_commands.js";
import { RunRecorder } from "./run_recorder.js";
import { RANDOM } from "../core/world_names.js";
import type { EnvironmentScene } from "../generated_types.js";
import type { Change, Experiment, RobotChange, SimParams, WorldEdit, WrittenWorld } from "../types.js";

/** The dimensions of each world with a name. */
export type Worlds = Record<string, SimParams>;

const BLOCK_TICKS = 256;

/** Takes robots through their environments. */
export class Simulation {
  world = worldOf(this.experiment.world ?? RANDOM, this.worlds);
  native = new NativeRun(this.module, this.experiment.robots.length);
  arena: Arena;
  commands = new RobotCommands(this.native, this.experiment);
  changes = new DueChanges(this.experiment.changes);
  robots = [...this.experiment.robots.keys()];
  tick = 0;
  tours: number[] = [];
  log: Uint8Array[] | undefined;
  scene: EnvironmentScene;
  recorder: RunRecorder;

  /**
   * @param module - page.wasm, compiled.
   * @param keepsLog - Whether to record every frame.
   */
  constructor(readonly module: WebAssembly.Module, readonly experiment: Experiment, readonly worlds: Worlds, keepsLog = false) {
    const { environments, seed, robots } = experiment;
    for (const [robot, { program }] of robots.entries()) if (program !== undefined) loadProgram(this.native, robot, program);
    drawFrom(this.native, this.world.params, this.world.written);
    this.arena = new Arena(this.native, this.world.params, experiment);
    this.log = keepsLog ? [] : undefined;
    this.scene = { number: 0, of: environments, seed, first_tick: 0, start_tick: 0, bars: [], food: [] };
    this.stopAll(); // as in the handshake of tools/run
    this.commands.startAll();
    this.recorder = new RunRecorder(this.measures, this.native, this.robots);
  }

  /**
   * Runs all environments; pauses after each.
   * @returns The number of each.
   */
  *run(): Generator<number, void> {
    const { environments, limit_ticks, ticks_max = Infinity } = this.experiment;
    for (let number = 1; number <= environments && this.tick < ticks_max; number += 1) {
      this.enter(number);
      const end = Math.min(this.tick + limit_ticks, ticks_max);
      while (this.tick < end && this.arena.eaten.includes(0)) this.runBlock(end);
      this.settle();
      yield number;
    }
    this.stopAll();
  }

  /** Runs all that is left. */
  finish() {
    for (const _ of this.run()) continue;
  }

  /** What was recorded so far. */
  result() {
    const { seed, environments } = this.experiment;
    const title = `seed ${seed}, ${environments} environment${environments === 1 ? "" : "s"}`;
    return { ...this.recorder.result(title), tours: this.tours };
  }

  /** What a drawing needs. */
  get measures() {
    const { measures, width_mm: width, height_mm: height } = this.world.params;
    return { ...measures, width, height, boredom: this.experiment.robots[0].settings.boredom_limit ?? measures.boredom };
  }

  stopAll() {
    for (const robot of this.robots) {
      this.commands.stop(robot);
      this.keepLog();
    }
  }

  /** Asks the robots that have stopped by themselves for a report. */
  settle() {
    for (const robot of this.robots) this.commands.askIfHalted(robot);
    this.keepLog();
  }

  enter(number: number) {
    drawLayout(this.native, { seed: this.experiment.seed, number, robots: this.robots.length });
    this.tours.push(this.native.c.page_tour());
    this.native.c.page_enter();
    this.scene = { ...this.scene, number, first_tick: this.tick };
    this.show();
  }

  /** Records the scene as it is now. */
  show() {
    const { plants: _, ...before } = this.scene;
    const { plants, ...drawn } = this.arena.drawn;
    this.scene = { ...before, ...drawn, ...(plants.length && { plants }) };
    this.recorder.enter(this.scene);
  }

  /** @param end - The tick at which the environment ends. */
  runBlock(end: number) {
    this.changes.makeThoseOf(this.tick, (change) => this.change(change));
    this.keepLog();
    const measures = this.commands.wantsRanges.includes(true);
    const next = Math.min(end, this.changes.nextTick);
    if (measures) this.sendRanges();
    const ticks = this.native.c.page_run(this.tick, measures ? 1 : Math.min(next - this.tick, BLOCK_TICKS));
    this.keepLog();
    if (!ticks) throw new Error(`a robot does not answer tick ${this.tick}: it was not started, or was stopped`);
    for (const robot of this.robots) this.recorder.tracks[robot].add(this.native.block(robot, ticks));
    this.tick += ticks;
    this.recorder.eat(this.arena.eaten);
  }

  /** Tells the robots that want it how far away things are. */
  sendRanges() {
    this.setTime();
    for (const robot of this.robots) if (this.commands.wantsRanges[robot]) this.native.c.page_send_ranges(robot, this.tick);
    this.keepLog();
  }

  change(change: Change) {
    if (isWorldEdit(change)) this.changeWorld(change);
    else this.changeRobot(change);
  }

  changeWorld(edit: WorldEdit) {
    this.arena.edit(edit);
    this.recorder.edits.push({ ...edit, tick: this.tick });
    this.show();
  }

  changeRobot(change: RobotChange) {
    const { robot } = change;
    const track = this.recorder.tracks[robot];
    if (change.do === "start") track.restart();
    this.setTime();
    this.commands.carryOut(change);
    if (change.do === "freeze") this.native.c.page_history_freeze(robot, change.on);
    track.relearn();
  }

  /** Sets the log's time to that of the next tick. */
  setTime() {
    this.native.c.page_set_time(Math.round(this.tick * this.world.params.tick_s * 1e6));
  }

  keepLog() {
    const lines = this.native.takeLog();
    if (lines.length) this.log?.push(lines);
  }
}

/** What the environments of a world are drawn from. */
export function worldOf(world: string | WrittenWorld, worlds: Worlds): { params: SimParams; written?: WrittenWorld } {
  if (typeof world === "string") return { params: worlds[world] };
  const [width_mm, height_mm] = world.size ?? [worlds.random.width_mm, worlds.random.height_mm];
  return { params: { ...worlds.random, width_mm, height_mm }, written: world };
}

type TimedChange = Change & { tick: number };

/** `refusals` has the reason for each change that could not be made, by its index among the changes. */
class DueChanges {
  next = 0;
  refusals: Map<number, string> = new Map();

  /** @param changes - In the order of their ticks. */
  constructor(readonly changes: TimedChange[]) {}

  /** The tick of the next one; infinite if there is none. */
  get nextTick() {
    return this.changes[this.next]?.tick ?? Infinity;
  }

  /**
   * Makes the changes of a tick.
   * @param make - Throws an EditError if a change cannot be made.
   */
  makeThoseOf(tick: number, make: (change: TimedChange) => void) {
    for (; this.nextTick === tick; this.next += 1) {
      try {
        make(this.changes[this.next]);
      } catch (error) {
        if (!(error instanceof EditError)) throw error;
        this.refusals.set(this.next, error.message);
      }
    }
  }
}
