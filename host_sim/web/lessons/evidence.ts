/* Facts about a run up to a tick, for the goals of the lessons. */

import { AVOIDING, PARAMETERS } from "../generated.js";
import type { RobotData, RunData } from "../core/run_data.js";
import type { ShownRun } from "../lab/shown_run.js";

/** Ticks, both ends included. */
export type Stretch = { first: number; last: number };

const known: WeakMap<RobotData, Stretch[]> = new WeakMap();

/** The times at which a robot had something in its way, in their order. */
export function stretchesOf(robot: RobotData) {
  const found = known.get(robot) ?? search(robot.columns.reason);
  known.set(robot, found);
  return found;
}

function search(reasons: Int32Array) {
  const stretches: Stretch[] = [];
  reasons.forEach((reason, tick) => {
    if (!AVOIDING.includes(reason)) return;
    const last = stretches.at(-1);
    if (last?.last === tick - 1) last.last = tick;
    else stretches.push({ first: tick, last: tick });
  });
  return stretches;
}

/** The longest time up to a tick for which a robot could not get clear, in ticks. */
export function longestStretch(robot: RobotData, upTo: number) {
  const begun = stretchesOf(robot).filter(({ first }) => first <= upTo);
  return Math.max(0, ...begun.map(({ first, last }) => Math.min(last, upTo) - first + 1));
}

/** The mean number of ticks in which a robot got clear of an obstacle; NaN if it met none. */
export function ticksPerObstacle(robot: RobotData, upTo: number) {
  const begun = stretchesOf(robot).filter(({ first }) => first <= upTo);
  return begun.reduce((sum, { first, last }) => sum + Math.min(last, upTo) - first + 1, 0) / begun.length;
}

/** Whether a run was simulated to its end and is shown up to there. */
export function hasEnded(lane: ShownRun, tick: number) {
  const { data, experiment } = lane;
  if (!data || tick < lane.last) return false;
  const { number, first_tick } = data.sceneAt(lane.last);
  const isOver = lane.last + 1 - first_tick >= experiment.limit_ticks || hasEatenAll(data, lane.last);
  return number === experiment.environments && isOver;
}

/** Whether nothing is left to eat in the environment of a tick. */
export function hasEatenAll(data: RunData, tick: number) {
  return data.statesAt(tick)[0].eaten.every(Boolean);
}

/** A parameter of a robot at a tick. */
export function settingAt(lane: ShownRun, { robot, name }: { robot: number, name: keyof typeof PARAMETERS }, tick: number) {
  return lane.setupAt(tick, robot).settings[name] ?? PARAMETERS[name].default;
}

/** Whether a robot knows a turn for each pattern at a tick, all written by a person. */
export function isByHand(robot: RobotData, tick: number) {
  const last = robot.lastLessons(tick);
  return last.every((lesson, cell) => cell === 0 || Boolean(lesson?.by_hand && lesson.side));
}
