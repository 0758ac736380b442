/* A recorded run: gives the states of any tick. */

import { CELL_COUNT } from "../generated.js";
import { unpackColumns } from "./packed_columns.js";
import type { Trail } from "../draw/trail.js";
import type { Lesson, State } from "../generated_types.js";
import type { RobotRun, Run } from "../types.js";
import type { Columns } from "./packed_columns.js";

const VERSION = 3;
const TRAIL_TICKS = 6000;
const PLACES_PER_MM = 10;

/** A run in memory. Ticks are counted from the start of the run. */
export class RunData {
  first = this.run.first_tick;
  last = this.run.first_tick + this.run.ticks - 1;
  measures = this.run.measures;
  robots = this.run.robots.map((robot, i) => new RobotData(robot, this.columns[i], this.run.first_tick));

  /** Unpacks a run. */
  static async from(run: Run): Promise<RunData> {
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

  /** @param columns - Of each robot. */
  constructor(readonly run: Run, readonly columns: Columns[]) {}

  /** The states of all robots at a tick. */
  statesAt(tick: number): State[] {
    const eaten = latest(this.run.eaten, tick);
    return this.robots.map((robot) => robot.stateAt(tick, eaten));
  }

  /**
   * What is marked on the timeline.
   * @param robot - Counted from 0.
   */
  eventsOf(robot: number) {
    return this.robots[robot].run.events;
  }

  sceneAt(tick: number) {
    return latest(this.run.scenes, tick);
  }

  /** Fills trails with the points up to a tick, in its environment. */
  trailsAt(tick: number, trails: Trail[]) {
    const begin = this.sceneAt(tick).first_tick;
    trails.forEach((trail) => trail.clear());
    this.addTrails(trails, Math.max(this.first, begin, tick - TRAIL_TICKS), tick);
  }

  /** Adds ticks to trails, both ends included. */
  addTrails(trails: Trail[], from: number, to: number) {
    this.robots.forEach((robot, i) => robot.addTrail(trails[i], from, to));
  }
}

/** One robot's part of a recorded run. */
export class RobotData {
  /** @param first - The first tick of the columns. */
  constructor(readonly run: RobotRun, public columns: Columns, public first: number) {}

  stateAt(tick: number, eaten: number[]): State {
    const cells = this.cellsAt(tick);
    const row = Object.fromEntries(this.run.columns.map((name) => [name, this.columns[name][tick - this.first]]));
    return {
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
    } as unknown as State;
  }

  memoryAt(tick: number) {
    return latest(this.run.memory, tick);
  }

  cellsAt(tick: number) {
    const cells: RobotRun["cells"] = [];
    for (const change of this.run.cells.slice(0, countUpTo(this.run.cells, tick, ([at]) => at))) cells[change[1]] = change;
    return cells;
  }

  /** The last change of each cell up to a tick, whenever the run was started over; undefined if it did not change. */
  lastLessons(tick: number) {
    const last: (Lesson | undefined)[] = Array.from({ length: CELL_COUNT }, () => undefined);
    for (const lesson of this.lessonsUpTo(tick, 0)) last[lesson.cell] = lesson;
    return last;
  }

  /** @param start - The first tick to count. */
  lessonsUpTo(tick: number, start: number) {
    const tickOf = (lesson: Lesson) => lesson.tick;
    return this.run.lessons.slice(countUpTo(this.run.lessons, start - 1, tickOf), countUpTo(this.run.lessons, tick, tickOf));
  }

  /**
   * The tick of the next event of a kind after a tick, or the one before it; undefined if there is none.
   * @param kind - An EventKind, "decision" or "obstacle".
   * @param step - 1 or -1.
   */
  nextTick(kind: string, tick: number, step: number) {
    if (kind === "decision") return this.search(tick, step, (at) => this.begins(at));
    if (kind === "obstacle") return this.search(tick, step, (at) => this.meets(at));
    const ticks = this.run.events.filter(([at, what]) => what === kind && (at - tick) * step > 0).map(([at]) => at);
    return step > 0 ? ticks[0] : ticks.at(-1);
  }

  /** The tick in which the action of a tick began. */
  actionStart(tick: number) {
    return this.begins(tick) ? tick : (this.search(tick, -1, (at) => this.begins(at)) ?? this.first);
  }

  begins(tick: number) {
    const { first, columns: { action } } = this;
    return tick === first || action[tick - first] !== action[tick - first - 1];
  }

  /** Whether something comes in the way of a robot that had nothing there. */
  meets(tick: number) {
    const { first, columns: { pattern } } = this;
    return pattern[tick - first] !== 0 && (tick === first || pattern[tick - first - 1] === 0);
  }

  search(from: number, step: number, wanted: (tick: number) => boolean) {
    const end = this.first + this.columns.action.length;
    for (let tick = from + step; tick >= this.first && tick < end; tick += step) if (wanted(tick)) return tick;
    return undefined;
  }

  addTrail(trail: Trail, from: number, to: number) {
    const { x, y, reason } = this.columns;
    for (let i = from - this.first; i <= to - this.first; i += 1) {
      trail.add(x[i] / PLACES_PER_MM, y[i] / PLACES_PER_MM, reason[i]);
    }
  }
}

/** The value at a tick, from pairs [first tick, value] in order; the first pair must not begin later. */
function latest<T>(pairs: [number, T][], tick: number): T {
  return pairs[countUpTo(pairs, tick, ([at]) => at) - 1][1];
}

/** The number of entries at or before a tick; they are in the order of their ticks. */
function countUpTo<T>(entries: T[], tick: number, tickOf: (entry: T) => number) {
  let [low, high] = [0, entries.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (tickOf(entries[middle]) <= tick) low = middle + 1;
    else high = middle;
  }
  return low;
}
