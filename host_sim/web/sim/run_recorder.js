// @ts-check
/* Records a run as it is simulated, in the form in which a recorded run is shown. */

import { CELL_COUNT, REASON } from "../generated.js";
import { LearningHistory } from "./learning_history.js";
import { AXES, ROW } from "./native_run.js";
import { newsOf } from "./world_news.js";

/**
 * @typedef {import("../core/packed_columns.js").Columns} Columns
 * @typedef {import("../types.js").EnvironmentScene} EnvironmentScene
 * @typedef {import("../types.js").EventKind} EventKind
 * @typedef {import("../types.js").Measures} Measures
 * @typedef {import("../types.js").RobotRun} RobotRun
 * @typedef {import("../types.js").Run} Run
 *
 * A block of one robot's ticks, as native/page.h has it.
 * @typedef {{ticks: number, rows: Int16Array, poses: Float64Array, decisions: Uint32Array}} Block
 *
 * A run, and the columns of each robot.
 * @typedef {{run: Run, columns: Columns[]}} Recorded
 */

/** Where in a row of host_sim/sim/native/loop.h each column is. */
const PLACES = {
  lifted: 15, feel: 1, bump: 2, beacon: 4, left: 8, right: 9, reason: 10, repeat_count: 11, action: 12, pattern: 14,
};
const MEAL_PLACE = 13;
/** Of x, y and heading in a column. */
const SCALES = /** @type {const} */ ([["x", 10], ["y", 10], ["heading", 1000]]);
const NAMES = ["x", "y", "heading", ...Object.keys(PLACES), "frozen"];
const FIRST_ROOM = 1 << 13;

/** Is called with each block of each robot. */
export class RunRecorder {
  /**
   * @param {Measures} measures
   * @param {import("./native_run.js").NativeRun} native
   * @param {number[][]} sides - What each robot knows before the first tick.
   */
  constructor(measures, native, sides) {
    this.measures = measures;
    this.tracks = sides.map((known, robot) => new Track(new LearningHistory(native, robot, known)));
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
    for (const track of this.tracks) track.isNew = true;
  }

  /**
   * Food was eaten in the last tick.
   * @param {number[]} eaten - For each piece, 1 if it is gone.
   */
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
    const run = { version: 2, title, measures, first_tick: 0, ticks, scenes, news, eaten, robots };
    return { run, columns: this.tracks.map((track) => track.trimmed()) };
  }
}

/** One robot's part of it. */
class Track {
  /** @param {LearningHistory} history */
  constructor(history) {
    this.node = history.robot + 1;
    this.history = history;
    this.ticks = 0;
    this.isNew = true;
    this.eats = false;
    this.columns = Object.fromEntries(NAMES.map((name) => [name, new Int32Array(FIRST_ROOM)]));
    /** @type {[number, number[]][]} */
    this.memory = [];
    /** @type {RobotRun["trials"]} */
    this.trials = [];
    /** @type {number[]} */
    this.meals = [];
  }

  /**
   * @param {Block} block
   * @param {number[]} before - What the robot knew before it, for each pattern,
   * @param {number[]} after - and after its last tick.
   */
  add(block, before, after) {
    const last = block.ticks - 1;
    const first = this.isNew || before.join() !== this.memory.at(-1)?.[1].join() ? [0] : [];
    for (const tick of new Set([...first, ...block.decisions, last])) {
      if (tick) this.history.passOver(tick - 1);
      this.take(this.ticks + tick, tick, tick === last ? after : before);
    }
    this.isNew = false;
    this.eats = block.rows[last * ROW + MEAL_PLACE] !== 0;
    this.append(block);
  }

  /**
   * @param {number} number
   * @param {number} tick - In the last block.
   * @param {number[]} sides
   */
  take(number, tick, sides) {
    this.history.take(number, tick, sides);
    note(this.memory, number, sides);
    note(this.trials, number, this.history.trial);
  }

  /** @param {Block} block */
  append({ ticks, rows, poses }) {
    this.makeRoom(this.ticks + ticks);
    const { columns, history } = this;
    for (const [axis, [name, scale]] of SCALES.entries()) {
      for (let i = 0; i < ticks; i += 1) columns[name][this.ticks + i] = Math.round(poses[AXES * i + axis] * scale);
    }
    for (const [name, place] of Object.entries(PLACES)) {
      const column = columns[name];
      for (let i = 0; i < ticks; i += 1) column[this.ticks + i] = rows[ROW * i + place];
    }
    columns.frozen.fill(history.frozen, this.ticks, this.ticks + ticks);
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
    const { pattern } = this.columns;
    const lessons = history.lessons.filter(({ tick }) => tick < this.ticks);
    const turns = this.begun(REASON.REMEMBERED).map((tick) => /** @type {[number, number]} */ ([tick, pattern[tick]]));
    const uses_before = Array.from({ length: CELL_COUNT }, () => 0);
    const events = this.events(environments, changes);
    return { node, memory, trials, lessons, turns, uses_before, events, columns: NAMES, data: "" };
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
      ["environment", environments], ["change", changes], ["trial", this.begun(REASON.TRIAL)], ["boredom", this.begun(REASON.BOREDOM)],
      ["lesson", learned.map(({ tick }) => tick)], ["eat", this.meals],
    ];
    const events = kinds.flatMap(([kind, ticks]) => ticks.map((tick) => /** @type {[number, EventKind]} */ ([tick, kind])));
    return events.sort(([a, one], [b, other]) => a - b || (one < other ? -1 : 1));
  }

  /**
   * The ticks in which actions with a reason began.
   * @param {number} wanted
   */
  begun(wanted) {
    const { action, reason } = this.columns;
    const ticks = [];
    for (let tick = 0; tick < this.ticks; tick += 1) {
      if (reason[tick] === wanted && (tick === 0 || action[tick] !== action[tick - 1])) ticks.push(tick);
    }
    return ticks;
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
