// @ts-check
/* Records a run as it is simulated, in the form in which a recorded run is shown. */

import { COLUMNS, REASON, ROW } from "../generated.js";
import { LearningHistory } from "./learning_history.js";
import { AXES } from "./native_run.js";
import { newsOf } from "./world_news.js";

/**
 * A block of one robot's ticks, in the order of native/page.h.
 * @typedef {{ticks: number, rows: Int16Array, poses: Float64Array}} Block
 *
 * From which tick on how sure a robot is of each cell.
 * @typedef {[number, number[]][]} Beads
 *
 * A run, and of each robot its columns and its beads.
 * @typedef {{run: Run, columns: Columns[], beads: Beads[]}} Recorded
 */

/** Of x, y and heading in a column. */
const SCALES = /** @type {const} */ ([["x", 10], ["y", 10], ["heading", 1000]]);
const NAMES = ["x", "y", "heading", ...Object.keys(COLUMNS)];
const EAT = ROW.indexOf("eat");
const FIRST_ROOM = 1 << 13;
const SIDE_BITS = 2;

/** Its `tracks` record the blocks of one robot each. */
export class RunRecorder {
  /**
   * @param {Measures} measures
   * @param {NativeRun} native
   * @param {number[]} robots
   */
  constructor(measures, native, robots) {
    this.measures = measures;
    this.tracks = robots.map((robot) => new Track(native, robot));
    /** @type {[number, EnvironmentScene][]} */
    this.scenes = [];
    /** @type {[number, number[]][]} */
    this.eaten = [];
    /** @type {import("./world_news.js").Edited[]} */
    this.edits = [];
  }

  /** Number of ticks so far. */
  get ticks() {
    return this.tracks[0].ticks;
  }

  /**
   * The next tick begins an environment, or is the first one after a change of it.
   * @param {EnvironmentScene} scene
   */
  enter(scene) {
    const before = this.scenes.at(-1)?.[1];
    if (before?.first_tick !== scene.first_tick || before.number !== scene.number) {
      note(this.eaten, this.ticks, scene.food.map(() => 0));
    }
    if (this.scenes.at(-1)?.[0] === this.ticks) this.scenes.pop();
    this.scenes.push([this.ticks, scene]);
  }

  /** @param {number[]} eaten - After the last tick: for each piece, 1 if it is gone. */
  eat(eaten) {
    if (eaten.join() === this.eaten.at(-1)?.[1].join()) return;
    note(this.eaten, this.ticks - 1, eaten);
    for (const track of this.tracks) if (track.eats) track.meals.push(this.ticks - 1);
  }

  /**
   * All that was recorded, as it is now.
   * @param {string} title
   * @returns {Recorded}
   */
  result(title) {
    const { measures, ticks, scenes, eaten } = this;
    const begun = scenes.filter(([, { number }], i) => number !== (scenes[i - 1]?.[1].number ?? 0));
    const news = newsOf(this.edits, this.tracks.length);
    const changes = [...new Set(news.map(([tick]) => tick))];
    const robots = this.tracks.map((track) => track.result(begun.map(([tick]) => tick), changes));
    const run = { version: 3, title, measures, first_tick: 0, ticks, scenes, news, eaten, robots };
    return { run, columns: this.tracks.map((track) => track.trimmed()), beads: this.tracks.map((track) => track.beads) };
  }
}

/** One robot's part of it. */
class Track {
  /**
   * @param {NativeRun} native
   * @param {number} robot
   */
  constructor(native, robot) {
    this.native = native;
    this.robot = robot;
    this.node = robot + 1;
    this.history = new LearningHistory(native, robot);
    this.ticks = 0;
    this.eats = false;
    this.columns = Object.fromEntries(NAMES.map((name) => [name, new Int32Array(FIRST_ROOM)]));
    /** @type {[number, number[]][]} */
    this.memory = [[0, native.sides(robot)]];
    /** @type {Beads} */
    this.beads = [[0, this.sureness]];
    /** @type {RobotRun["trials"]} */
    this.trials = [[0, null]];
    /** @type {import("./learning_history.js").Note[]} */
    this.begun = [];
    /** @type {number[]} */
    this.meals = [];
  }

  /** How sure the robot is of each cell, where its behaviour keeps that: in the bits above those of the side. */
  get sureness() {
    return this.native.memory(this.robot).map((cell) => cell >> SIDE_BITS);
  }

  /** @param {number} tick - Of what its memory holds now. */
  remember(tick) {
    note(this.memory, tick, this.native.sides(this.robot));
    note(this.beads, tick, this.sureness);
  }

  /** @param {Block} block */
  add(block) {
    const notes = this.history.take(this.ticks, block.ticks);
    for (const { tick, trial } of notes) note(this.trials, tick, trial);
    this.begun.push(...notes);
    this.eats = block.rows[(block.ticks - 1) * ROW.length + EAT] !== 0;
    this.append(block);
    this.remember(this.ticks - 1);
  }

  /** Notes that the robot was given a command before the next tick. */
  relearn() {
    this.history.relearn(this.ticks);
    this.remember(this.ticks);
  }

  /** Prepares for a restart of the robot: its lessons stay. */
  restart() {
    this.native.c.page_history_restart(this.robot);
    this.history.forgetCells(this.ticks);
    note(this.trials, this.ticks, null);
  }

  /** @param {Block} block */
  append({ ticks, rows, poses }) {
    this.makeRoom(this.ticks + ticks);
    const { columns } = this;
    for (const [axis, [name, scale]] of SCALES.entries()) {
      for (let i = 0; i < ticks; i += 1) columns[name][this.ticks + i] = Math.round(poses[AXES * i + axis] * scale);
    }
    for (const [name, place] of Object.entries(COLUMNS)) {
      const column = columns[name];
      for (let i = 0; i < ticks; i += 1) column[this.ticks + i] = rows[ROW.length * i + place];
    }
    this.ticks += ticks;
  }

  /** @param {number} ticks */
  makeRoom(ticks) {
    for (const name of NAMES) {
      const old = this.columns[name];
      if (old.length >= ticks) return;
      this.columns[name] = new Int32Array(2 * ticks);
      this.columns[name].set(old);
    }
  }

  /** The columns, no longer than the run. */
  trimmed() {
    return Object.fromEntries(NAMES.map((name) => [name, this.columns[name].slice(0, this.ticks)]));
  }

  /**
   * @param {number[]} environments - The ticks in which they begin.
   * @param {number[]} changes - The ticks in which something has changed.
   * @returns {RobotRun}
   */
  result(environments, changes) {
    const { node, memory, trials, history } = this;
    const lessons = history.lessons.filter(({ tick }) => tick < this.ticks);
    const events = this.events(environments, changes);
    return { node, memory, trials, lessons, cells: history.cells, events, columns: NAMES, data: "" };
  }

  /**
   * @param {number[]} environments
   * @param {number[]} changes
   * @returns {[number, EventKind][]}
   */
  events(environments, changes) {
    const learned = this.history.lessons.filter(({ by_hand, tick }) => !by_hand && tick < this.ticks);
    /** @type {[EventKind, number[]][]} */
    const kinds = [
      ["environment", environments], ["change", changes], ["eat", this.meals],
      ["trial", this.begunFor(REASON.TRIAL)], ["boredom", this.begunFor(REASON.BOREDOM)],
      ["lesson", learned.map(({ tick }) => tick)],
    ];
    const events = kinds.flatMap(([kind, ticks]) => ticks.map((tick) => /** @type {[number, EventKind]} */ ([tick, kind])));
    return events.sort(([a, one], [b, other]) => a - b || (one < other ? -1 : 1));
  }

  /** @param {number} wanted */
  begunFor(wanted) {
    return this.begun.filter(({ reason }) => reason === wanted).map(({ tick }) => tick);
  }
}

/**
 * Adds a value if it has changed; it replaces one of the same tick.
 * @template T
 * @param {[number, T][]} changes
 * @param {number} tick
 * @param {T} value
 */
function note(changes, tick, value) {
  const last = changes.at(-1);
  if (last && JSON.stringify(last[1]) === JSON.stringify(value)) return;
  if (last?.[0] === tick) changes.pop();
  changes.push([tick, value]);
}
