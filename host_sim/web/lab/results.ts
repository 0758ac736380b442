/* The results of a run up to a tick: numbers for curves, for a table and for a file. */

import { AVOIDING, PARAMETERS } from "../generated.js";
import type { RobotData } from "../core/run_data.js";
import type { ShownRun } from "./shown_run.js";

export type Curve = "trials" | "blocked" | "meals";

/** A count that grows: the ticks in which it does, and what it is from then on. */
export type Growth = { ticks: number[]; counts: number[] };

/** The columns of the table and of the file. */
export const NAMES = ["run", "robot", "behaviour", "seed", "environment", "finished", "time (s)", "shortest tour (s)", "trials", "lessons", "bored", "blocked (s)", "meals"];

/** How something grows in a run. */
export function growthOf(robot: RobotData, curve: Curve, tickMs: number): Growth {
  if (curve === "blocked") return blockedGrowth(robot, tickMs / 1000);
  const kind = curve === "trials" ? "trial" : "eat";
  const ticks = robot.run.events.filter(([, what]) => what === kind).map(([tick]) => tick);
  return { ticks, counts: ticks.map((_, i) => i + 1) };
}

/** One row for each robot and environment that has begun by a tick. */
export function rowsOf(lane: ShownRun, upTo: number): (string | number)[][] {
  const { data, experiment } = lane;
  if (!data) return [];
  const begun = data.robots[0].run.events.filter(([tick, kind]) => kind === "environment" && tick <= upTo);
  return begun.flatMap(([first], i) => {
    const last = Math.min(upTo, data.last, (begun[i + 1]?.[0] ?? Infinity) - 1);
    const eaten = data.statesAt(last)[0].eaten;
    return data.robots.map((robot, r) => {
      const { profile, settings } = lane.setupAt(last, r);
      return [
        lane.name, robot.run.node, profile, experiment.seed, data.sceneAt(first).number,
        eaten.every(Boolean) ? "yes" : "no", seconds(last + 1 - first, data.measures.tick_ms),
        tourOf(lane, i, settings), ...numbersOf(robot, first, last, data.measures.tick_ms),
      ];
    });
  });
}

function numbersOf(robot: RobotData, first: number, last: number, tickMs: number) {
  const inside = (tick: number) => tick >= first && tick <= last;
  const count = (kind: string) => robot.run.events.filter(([tick, what]) => what === kind && inside(tick)).length;
  const blocked = robot.columns.reason.subarray(first - robot.first, last + 1 - robot.first).filter((reason) => AVOIDING.includes(reason)).length;
  return [count("trial"), count("lesson"), count("boredom"), seconds(blocked, tickMs), count("eat")];
}

function seconds(ticks: number, tickMs: number) {
  return Number(((ticks * tickMs) / 1000).toFixed(2));
}

/**
 * How long the shortest tour through all food of an environment takes at the robot's speed, s, without turning.
 * @param environment - Counted from 0.
 * @param settings - Of the robot.
 */
function tourOf(
  { tours, experiment }: ShownRun,
  environment: number,
  { speed_mm_s: speed = PARAMETERS.speed_mm_s.default }: Record<string, number>,
) {
  const isKnown = Number.isFinite(tours[environment]) && experiment.robots.length === 1;
  return isKnown ? Number((tours[environment] / speed).toFixed(2)) : "";
}

function blockedGrowth({ first, columns }: RobotData, tickS: number): Growth {
  const growth: Growth = { ticks: [], counts: [] };
  let blocked = 0;
  columns.reason.forEach((reason, i) => {
    if (!AVOIDING.includes(reason)) return;
    blocked += 1;
    growth.ticks.push(first + i);
    growth.counts.push(blocked * tickS);
  });
  return growth;
}
