/* Checks of goals about what robots unlearn: how sure they are of each cell, and what they know after their motors were swapped. */

import { CELL_COUNT, SIDE } from "../generated.js";
import { stretchesOf } from "./evidence.js";
import { FRONT_LEFT, FRONT_RIGHT } from "./goals.js";
import type { ShownRun } from "../lab/shown_run.js";
import type { Shown } from "./goals.js";

const BEADS_MAX = 3;
const MEETINGS_MIN = 30;
const CELLS = Array.from({ length: CELL_COUNT }, (_, cell) => cell);

/**
 * The beads of a robot at a tick, by cell; none for a robot whose behaviour keeps none.
 * @param robot - Counted from 0.
 */
export function beadsAt({ beads }: ShownRun, tick: number, robot = 0) {
  return beads[robot]?.filter(([at]) => at <= tick).at(-1)?.[1] ?? CELLS.map(() => 0);
}

/** The tick at which the motors of a run's first robot were swapped; none if they were not. */
function swappedAt({ experiment }: ShownRun) {
  return experiment.changes.find((change) => change.do === "body" && change.what === "swap-motors")?.tick;
}

export function areSwapped(lane: ShownRun, tick: number) {
  return (swappedAt(lane) ?? Infinity) <= tick + 1;
}

export function hasThreeBeads({ lane }: Shown, tick: number) {
  return (lane.beads[0] ?? []).some(([at, beads]) => at <= tick && beads.includes(BEADS_MAX));
}

/**
 * Whether a robot has become less sure of a cell, or has forgotten it.
 * @param swapped - Whether only what came after the motors were swapped counts.
 */
export function hasLostBeads({ lane }: Shown, tick: number, swapped: boolean) {
  const from = swapped ? (swappedAt(lane) ?? Infinity) : 0;
  const [known = []] = lane.beads;
  return known.some(([at, beads], i) => i > 0 && at >= from && at <= tick && CELLS.some((cell) => beads[cell] < known[i - 1][1][cell]));
}

/** Whether a robot has learned to turn the other way round since its motors were swapped. */
export function knowsMirrored({ lane, data }: Shown, tick: number) {
  const memory = data.robots[0].memoryAt(tick);
  return areSwapped(lane, tick) && memory[FRONT_RIGHT] === SIDE.RIGHT && memory[FRONT_LEFT] === SIDE.LEFT;
}

/**
 * Whether a robot has met many obstacles since its motors were swapped, and still knows what it knew, to the end of its run.
 */
export function neverRelearned({ lane, data }: Shown, tick: number) {
  const [robot] = data.robots;
  const since = swappedAt(lane) ?? Infinity;
  const met = stretchesOf(robot).filter(({ first, last }) => first >= since && last <= tick).length;
  return met >= MEETINGS_MIN && robot.memoryAt(tick).every((side, cell) => side === robot.memoryAt(since - 1)[cell]);
}

/** Whether a cell that had lost all its beads, or had others, holds the other side again. */
export function refilled({ data }: Shown, tick: number) {
  const { memory } = data.robots[0].run;
  const upTo = memory.filter(([at]) => at <= tick);
  return CELLS.some((cell) => new Set(upTo.map(([, sides]) => sides[cell]).filter(Boolean)).size > 1);
}
