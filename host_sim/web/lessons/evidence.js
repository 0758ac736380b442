// @ts-check
/* Facts about a run up to a tick, for the goals of the lessons. */

import { AVOIDING, PARAMETERS } from "../generated.js";

/** @typedef {{first: number, last: number}} Stretch - Ticks, both ends included. */

/** @type {WeakMap<RobotData, Stretch[]>} */
const known = new WeakMap();

/**
 * The times at which a robot had something in its way, in their order.
 * @param {RobotData} robot
 */
export function stretchesOf(robot) {
  const found = known.get(robot) ?? search(robot.columns.reason);
  known.set(robot, found);
  return found;
}

/** @param {Int32Array} reasons */
function search(reasons) {
  /** @type {Stretch[]} */
  const stretches = [];
  reasons.forEach((reason, tick) => {
    if (!AVOIDING.includes(reason)) return;
    const last = stretches.at(-1);
    if (last?.last === tick - 1) last.last = tick;
    else stretches.push({ first: tick, last: tick });
  });
  return stretches;
}

/**
 * The longest time up to a tick for which a robot could not get clear, in ticks.
 * @param {RobotData} robot
 * @param {number} upTo
 */
export function longestStretch(robot, upTo) {
  const begun = stretchesOf(robot).filter(({ first }) => first <= upTo);
  return Math.max(0, ...begun.map(({ first, last }) => Math.min(last, upTo) - first + 1));
}

/**
 * The mean number of ticks in which a robot got clear of an obstacle; NaN if it met none.
 * @param {RobotData} robot
 * @param {number} upTo
 */
export function ticksPerObstacle(robot, upTo) {
  const begun = stretchesOf(robot).filter(({ first }) => first <= upTo);
  return begun.reduce((sum, { first, last }) => sum + Math.min(last, upTo) - first + 1, 0) / begun.length;
}

/**
 * Whether a run was simulated to its end and is shown up to there.
 * @param {ShownRun} lane
 * @param {number} tick
 */
export function hasEnded(lane, tick) {
  const { data, experiment } = lane;
  if (!data || tick < lane.last) return false;
  const { number, first_tick } = data.sceneAt(lane.last);
  const isOver = lane.last + 1 - first_tick >= experiment.limit_ticks || hasEatenAll(data, lane.last);
  return number === experiment.environments && isOver;
}

/**
 * Whether nothing is left to eat in the environment of a tick.
 * @param {RunData} data
 * @param {number} tick
 */
export function hasEatenAll(data, tick) {
  return data.statesAt(tick)[0].eaten.every(Boolean);
}

/**
 * A parameter of a robot at a tick.
 * @param {ShownRun} lane
 * @param {{robot: number, name: keyof typeof PARAMETERS}} which
 * @param {number} tick
 */
export function settingAt(lane, { robot, name }, tick) {
  return lane.setupAt(tick, robot).settings[name] ?? PARAMETERS[name].default;
}

/**
 * Whether a robot knows a turn for each pattern at a tick, all written by a person.
 * @param {RobotData} robot
 * @param {number} tick
 */
export function isProgrammed(robot, tick) {
  const last = robot.lastLessons(tick);
  return last.every((lesson, cell) => cell === 0 || Boolean(lesson?.by_hand && lesson.side));
}
