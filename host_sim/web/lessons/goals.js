// @ts-check
/* Checks of the lessons' goals on the runs, up to the tick shown. */

import { PARAMETERS, PATTERNS, SIDE } from "../generated.js";
import { hasEatenAll, hasEnded, isProgrammed, longestStretch, settingAt, stretchesOf, ticksPerObstacle } from "./evidence.js";
import { meetingsOf } from "./plant_meetings.js";

/** @typedef {{lane: ShownRun, data: RunData}} Shown - A run whose first environments are there to be looked at. */

export const FRONT_RIGHT = PATTERNS.indexOf("front-right");
export const FRONT_LEFT = PATTERNS.indexOf("front-left");
const STUCK_S = 10;
const SOON_STUCK_S = 3;
const SOON_CLEAR_S = 4;
const FAST_S = 40;
const MOVED_MM = 300;

/**
 * @param {RunData} data
 * @param {number} ticks
 */
function seconds(data, ticks) {
  return (ticks * data.measures.tick_ms) / 1000;
}

/**
 * Whether a trial has ended by a tick, with this result.
 * @param {RunData} data
 * @param {number} tick
 * @param {number} helped
 */
export function hasTried(data, tick, helped) {
  return data.robots[0].run.trials.some(([at, trial]) => at <= tick && trial?.helped === helped && !trial.frozen);
}

/**
 * @param {RunData} data
 * @param {number} tick
 */
export function hasLearnedBothSides(data, tick) {
  const last = data.robots[0].lastLessons(tick);
  const learned = (/** @type {number} */ pattern, /** @type {number} */ side) =>
    last[pattern]?.side === side && !last[pattern]?.by_hand;
  return learned(FRONT_RIGHT, SIDE.LEFT) && learned(FRONT_LEFT, SIDE.RIGHT);
}

/**
 * Whether a robot with a person's program gets clear sooner than one that learns.
 * @param {Shown[]} runs
 * @param {number} tick
 */
export function isLearnerBeaten(runs, tick) {
  const robots = runs.map(({ data }) => data.robots[0]);
  const learners = robots.filter((robot) => robot.lastLessons(tick).every((lesson) => !lesson?.by_hand));
  const programmed = robots.filter((robot) => isProgrammed(robot, tick));
  const best = Math.min(...programmed.map((robot) => ticksPerObstacle(robot, tick)));
  return learners.some((learner) => best < ticksPerObstacle(learner, tick));
}

/**
 * Whether a robot that is less patient was bored, and never stuck for long, in a run that has ended.
 * @param {Shown} run
 * @param {number} tick
 */
export function hasFreedItself({ lane, data }, tick) {
  const limit = settingAt(lane, { robot: 0, name: "boredom_limit" }, tick);
  const wasBored = data.robots[0].run.events.some(([at, what]) => what === "boredom" && at <= tick);
  const longest = seconds(data, longestStretch(data.robots[0], tick));
  return limit < PARAMETERS.boredom_limit.max && wasBored && longest <= SOON_CLEAR_S && hasEnded(lane, tick);
}

/**
 * @param {RunData} data
 * @param {number} tick
 */
export function wasStuck(data, tick) {
  return seconds(data, longestStretch(data.robots[0], tick)) >= STUCK_S;
}

/**
 * @param {RunData} data
 * @param {number} tick
 */
export function hasBeenStuck(data, tick) {
  return seconds(data, longestStretch(data.robots[0], tick)) >= SOON_STUCK_S;
}

/**
 * How often a plant was put somewhere, up to a tick.
 * @param {ShownRun} lane
 * @param {number} tick
 */
export function plantsPut({ experiment }, tick) {
  return experiment.changes.filter((change) => (change.do === "plant" || change.do === "move_plant") && change.tick <= tick + 1).length;
}

/**
 * @param {Shown} run
 * @param {number} tick
 */
export function hasEatenFast({ lane, data }, tick) {
  return hasEnded(lane, tick) && hasEatenAll(data, lane.last) && seconds(data, lane.last + 1) < FAST_S;
}

/**
 * Whether a robot that knew nothing had to try at the plant.
 * @param {RunData} data
 * @param {number} tick
 */
export function hadToTry(data, tick) {
  return meetingsOf(data).some((it) => it.last < tick && it.tried && it.knewNothing);
}

/**
 * The meetings, up to a tick, after which the robot got past the plant by what it knew.
 * @param {RunData} data
 * @param {number} tick
 */
export function hasPassed(data, tick) {
  return meetingsOf(data).filter(({ last, tried, knewNothing }) => last < tick && !tried && !knewNothing);
}

/** @param {import("./plant_meetings.js").Meeting[]} meetings */
export function areApart(meetings) {
  const [{ at: first } = { at: { x: 0, y: 0 } }] = meetings;
  return meetings.some(({ at }) => Math.hypot(at.x - first.x, at.y - first.y) >= MOVED_MM);
}

/**
 * The times up to a tick during which a sensor was broken in this way.
 * @param {ShownRun} lane
 * @param {string} how
 * @param {number} tick
 */
function brokenTimes({ experiment }, how, tick) {
  /** @type {import("./evidence.js").Stretch[]} */
  const times = [];
  for (const change of experiment.changes) {
    if (change.do !== "body" || change.tick > tick) continue;
    const now = times.at(-1) ?? { first: NaN, last: NaN };
    if (change.what === "repair") now.last = Math.min(now.last, change.tick - 1);
    else if (!change.what.startsWith(how)) continue;
    else if (now.last >= change.tick - 1) now.last = tick; // not repaired, or broken anew at once
    else times.push({ first: change.tick, last: tick });
  }
  return times;
}

/**
 * Whether a sensor has ever seen what was not there.
 * @param {ShownRun} lane
 * @param {number} tick
 */
export function isBroken(lane, tick) {
  return brokenTimes(lane, "stuck-on", tick + 1).length > 0;
}

/**
 * @param {Shown} run
 * @param {number} tick
 */
export function isStuckBySensor({ lane, data }, tick) {
  const blocked = stretchesOf(data.robots[0]);
  return brokenTimes(lane, "stuck-on", tick).some((time) => blocked.some(({ first, last }) =>
    seconds(data, Math.min(last, time.last) - Math.max(first, time.first)) >= STUCK_S));
}

/**
 * @param {Shown} run
 * @param {number} tick
 */
export function eatsWithoutBelieving({ lane, data }, tick) {
  const disbelieves = settingAt(lane, { robot: 0, name: "distrust" }, tick) > 0;
  return disbelieves && brokenTimes(lane, "stuck-on", tick).some(({ first, last }) =>
    data.robots[0].run.events.some(([at, what]) => what === "eat" && at > first && at <= last));
}

/**
 * @param {Shown} run
 * @param {number} tick
 */
export function bumpsBlindly({ lane, data }, tick) {
  return brokenTimes(lane, "stuck-off", tick).some(({ first, last }) =>
    data.robots[0].columns.bump.subarray(first, last + 1).some(Boolean));
}

/**
 * @param {ShownRun} lane
 * @param {number} tick
 */
export function isSharing(lane, tick) {
  const { robots } = lane.experiment;
  return robots.length > 1 && robots.every((_, robot) => settingAt(lane, { robot, name: "share" }, tick) > 0);
}

/**
 * Whether a robot knows a turn that came neither from itself nor from a person.
 * @param {Shown} run
 * @param {number} tick
 */
export function hasHeard({ lane, data }, tick) {
  if (lane.experiment.changes.some((change) => change.do === "write")) return false;
  const heard = data.robots.flatMap(({ run }) => run.lessons).filter(({ by_hand, side }) => by_hand && side);
  return heard.some((lesson) => lesson.tick > 0 && lesson.tick <= tick);
}

/**
 * Whether all robots of a run with sharing know the turns for both sides at this tick, but not all of a run without.
 * @param {Shown[]} runs
 * @param {number} tick
 */
export function knowSooner(runs, tick) {
  const know = (/** @type {Shown} */ { data }) => data.robots.every((robot) => {
    const memory = robot.memoryAt(Math.min(tick, data.last));
    return memory[FRONT_RIGHT] && memory[FRONT_LEFT];
  });
  const sharing = runs.filter((run) => isSharing(run.lane, tick) && hasHeard(run, tick));
  const silent = runs.filter(({ lane }) => !isSharing(lane, tick) && lane.experiment.robots.length > 1);
  return sharing.some(know) && silent.some((run) => !know(run));
}
