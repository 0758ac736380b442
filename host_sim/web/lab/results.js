// @ts-check
/* The results of a run up to a tick: numbers for curves, for a table and for a file. */

import { AVOIDING, PARAMETERS } from "../generated.js";

/**
 * @typedef {"trials" | "blocked" | "meals"} Curve
 *
 * A count that grows: the ticks in which it does, and what it is from then on.
 * @typedef {{ticks: number[], counts: number[]}} Growth
 */

/** The columns of the table and of the file. */
export const NAMES = ["run", "robot", "behaviour", "seed", "environment", "finished", "time (s)", "shortest tour (s)", "trials", "lessons", "bored", "blocked (s)", "meals"];

/**
 * How something grows in a run.
 * @param {RobotData} robot
 * @param {Curve} curve
 * @param {number} tickMs
 * @returns {Growth}
 */
export function growthOf(robot, curve, tickMs) {
  if (curve === "blocked") return blockedGrowth(robot, tickMs / 1000);
  const kind = curve === "trials" ? "trial" : "eat";
  const ticks = robot.run.events.filter(([, what]) => what === kind).map(([tick]) => tick);
  return { ticks, counts: ticks.map((_, i) => i + 1) };
}

/**
 * One row for each robot and environment that has begun by a tick.
 * @param {ShownRun} lane
 * @param {number} upTo
 * @returns {(string | number)[][]}
 */
export function rowsOf(lane, upTo) {
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

/**
 * @param {RobotData} robot
 * @param {number} first
 * @param {number} last
 * @param {number} tickMs
 */
function numbersOf(robot, first, last, tickMs) {
  const inside = (/** @type {number} */ tick) => tick >= first && tick <= last;
  const count = (/** @type {string} */ kind) => robot.run.events.filter(([tick, what]) => what === kind && inside(tick)).length;
  const blocked = robot.columns.reason.subarray(first - robot.first, last + 1 - robot.first).filter((reason) => AVOIDING.includes(reason)).length;
  return [count("trial"), count("lesson"), count("boredom"), seconds(blocked, tickMs), count("eat")];
}

/**
 * @param {number} ticks
 * @param {number} tickMs
 */
function seconds(ticks, tickMs) {
  return Number(((ticks * tickMs) / 1000).toFixed(2));
}

/**
 * How long the shortest tour through all food of an environment takes at the robot's speed, s, without turning.
 * @param {ShownRun} lane
 * @param {number} environment - Counted from 0.
 * @param {Record<string, number>} settings - Of the robot.
 */
function tourOf({ tours, experiment }, environment, { speed_mm_s: speed = PARAMETERS.speed_mm_s.default }) {
  const isKnown = Number.isFinite(tours[environment]) && experiment.robots.length === 1;
  return isKnown ? Number((tours[environment] / speed).toFixed(2)) : "";
}

/**
 * @param {RobotData} robot
 * @param {number} tickS
 * @returns {Growth}
 */
function blockedGrowth({ first, columns }, tickS) {
  /** @type {Growth} */
  const growth = { ticks: [], counts: [] };
  let blocked = 0;
  columns.reason.forEach((reason, i) => {
    if (!AVOIDING.includes(reason)) return;
    blocked += 1;
    growth.ticks.push(first + i);
    growth.counts.push(blocked * tickS);
  });
  return growth;
}
