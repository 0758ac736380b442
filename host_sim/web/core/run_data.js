// @ts-check
/* A recorded run: gives the states of any tick. */

import { CELL_COUNT } from "../generated.js";
import { unpackColumns } from "./packed_columns.js";

const VERSION = 3;
const TRAIL_TICKS = 6000;
const PLACES_PER_MM = 10;

/** A run in memory. Ticks are counted from the start of the run. */
export class RunData {
  /**
   * Unpacks a run.
   * @param {Run} run
   * @returns {Promise<RunData>}
   */
  static async from(run) {
    if (run.version !== VERSION) throw new Error(`This page shows runs of version ${VERSION}, not ${run.version}.`);
    const columns = await Promise.all(run.robots.map((robot) => unpackColumns(robot.data, robot.columns, run.ticks)));
    for (const { left, right, heading } of columns) {
      let turned = 0;
      left.forEach((speed, i) => {
        right[i] -= speed;
        turned += (speed - right[i]) >> 3;
        heading[i] += turned;
      });
    }
    return new RunData(run, columns);
  }

  /**
   * @param {Run} run
   * @param {Columns[]} columns - Of each robot.
   */
  constructor(run, columns) {
    this.run = run;
    this.first = run.first_tick;
    this.last = run.first_tick + run.ticks - 1;
    this.measures = run.measures;
    this.robots = run.robots.map((robot, i) => new RobotData(robot, columns[i], run.first_tick));
  }

  /**
   * The states of all robots at a tick.
   * @param {number} tick
   * @returns {State[]}
   */
  statesAt(tick) {
    const eaten = latest(this.run.eaten, tick);
    return this.robots.map((robot) => robot.stateAt(tick, eaten));
  }

  /** @param {number} tick */
  sceneAt(tick) {
    return latest(this.run.scenes, tick);
  }

  /**
   * Makes trails those up to a tick, in its environment.
   * @param {number} tick
   * @param {Trail[]} trails
   */
  trailsAt(tick, trails) {
    const begin = this.sceneAt(tick).first_tick;
    trails.forEach((trail) => trail.clear());
    this.addTrails(trails, Math.max(this.first, begin, tick - TRAIL_TICKS), tick);
  }

  /**
   * Adds ticks to trails, both ends included.
   * @param {Trail[]} trails
   * @param {number} from
   * @param {number} to
   */
  addTrails(trails, from, to) {
    this.robots.forEach((robot, i) => robot.addTrail(trails[i], from, to));
  }
}

/** One robot's part of a recorded run. */
export class RobotData {
  /**
   * @param {RobotRun} run
   * @param {Columns} columns
   * @param {number} first - The first tick of the columns.
   */
  constructor(run, columns, first) {
    this.run = run;
    this.columns = columns;
    this.first = first;
  }

  /**
   * @param {number} tick
   * @param {number[]} eaten
   * @returns {State}
   */
  stateAt(tick, eaten) {
    const cells = this.cellsAt(tick);
    const row = Object.fromEntries(this.run.columns.map((name) => [name, this.columns[name][tick - this.first]]));
    return /** @type {State} */ (/** @type {unknown} */ ({
      ...row,
      node: this.run.node,
      tick,
      x: row.x / PLACES_PER_MM,
      y: row.y / PLACES_PER_MM,
      eaten,
      memory: this.memoryAt(tick),
      uses: cells.map(([, , uses]) => uses),
      learned: cells.map(([, , , learned]) => learned),
      by_hand: cells.map(([, , , , by_hand]) => by_hand),
      trial: latest(this.run.trials, tick),
    }));
  }

  /** @param {number} tick */
  memoryAt(tick) {
    return latest(this.run.memory, tick);
  }

  /** @param {number} tick */
  cellsAt(tick) {
    /** @type {RobotRun["cells"]} */
    const cells = [];
    for (const change of this.run.cells.slice(0, countUpTo(this.run.cells, tick, ([at]) => at))) cells[change[1]] = change;
    return cells;
  }

  /**
   * The last change of each cell up to a tick, whenever the run was started over; undefined if it did not change.
   * @param {number} tick
   */
  lastLessons(tick) {
    /** @type {(Lesson | undefined)[]} */
    const last = Array.from({ length: CELL_COUNT }, () => undefined);
    for (const lesson of this.lessonsUpTo(tick, 0)) last[lesson.cell] = lesson;
    return last;
  }

  /**
   * @param {number} tick
   * @param {number} start - The first tick to count.
   */
  lessonsUpTo(tick, start) {
    const tickOf = (/** @type {Lesson} */ lesson) => lesson.tick;
    return this.run.lessons.slice(countUpTo(this.run.lessons, start - 1, tickOf), countUpTo(this.run.lessons, tick, tickOf));
  }

  /**
   * The tick of the next event of a kind after a tick, or the one before it; undefined if there is none.
   * @param {EventKind} kind
   * @param {number} tick
   * @param {number} step - 1 or -1.
   */
  eventFrom(kind, tick, step) {
    const ticks = this.run.events.filter(([at, what]) => what === kind && (at - tick) * step > 0).map(([at]) => at);
    return step > 0 ? ticks[0] : ticks.at(-1);
  }

  /**
   * @param {Trail} trail
   * @param {number} from
   * @param {number} to
   */
  addTrail(trail, from, to) {
    const { x, y, reason } = this.columns;
    for (let i = from - this.first; i <= to - this.first; i += 1) {
      trail.add(x[i] / PLACES_PER_MM, y[i] / PLACES_PER_MM, reason[i]);
    }
  }
}

/**
 * What holds at a tick, of pairs [from which tick on, what] in their order; the first holds at least from there.
 * @template T
 * @param {[number, T][]} pairs
 * @param {number} tick
 * @returns {T}
 */
function latest(pairs, tick) {
  return pairs[countUpTo(pairs, tick, ([at]) => at) - 1][1];
}

/**
 * How many entries, in the order of their ticks, are at a tick or before.
 * @template T
 * @param {T[]} entries
 * @param {number} tick
 * @param {(entry: T) => number} tickOf
 */
function countUpTo(entries, tick, tickOf) {
  let [low, high] = [0, entries.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (tickOf(entries[middle]) <= tick) low = middle + 1;
    else high = middle;
  }
  return low;
}
