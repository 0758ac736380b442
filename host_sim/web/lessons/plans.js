// @ts-check
/* The seven lessons: how each begins, and when its goals are reached. Their texts are in texts/. */

import { PARAMETERS } from "../generated.js";
import { experimentOf } from "../lab/shown_run.js";
import { hasEnded, isProgrammed } from "./evidence.js";
import { areApart, bumpsBlindly, eatsWithoutBelieving, hadToTry, hasEatenFast, hasFreedItself } from "./goals.js";
import { hasHeard, hasLearnedBothSides, hasPassed, hasTried, isLearnerBeaten, isSharing } from "./goals.js";
import { isStuckBySensor, knowSooner, wasStuck } from "./goals.js";
import { changedAnswer, repeatsWhatItWasTaught, tellsKnowingFromSaying } from "./talk_goals.js";

/**
 * @typedef {import("./goals.js").Shown} Shown
 *
 * Whether a goal is reached, by what these runs show up to a tick, and by what was said.
 * @typedef {(runs: Shown[], tick: number, talk: TalkBox) => boolean} Goal
 *
 * `begin` are the runs that a lesson begins with; the last one is selected. `tool` is what it needs beside the rest of
 * the page.
 * @typedef {Object} Plan
 * @property {"watch" | "program" | "boredom" | "plant" | "sensor" | "share" | "talk"} id
 * @property {() => Experiment[]} begin
 * @property {"patience" | "sensors" | "share" | "score" | "talk" | ""} tool
 * @property {Goal[]} goals
 */

/** The memory of a robot that has learned everything. */
const LEARNED = [0, 1, 1, 1, 2, 1, 2, 1];

/** @type {Plan[]} */
export const PLANS = [
  {
    id: "watch",
    begin: () => [runOf({ seed: 12, environments: 3 })],
    tool: "",
    goals: [
      (runs, tick) => runs.some(({ data }) => hasTried(data, tick, 0)),
      (runs, tick) => runs.some(({ data }) => hasTried(data, tick, 1)),
      (runs, tick) => runs.some(({ data }) => hasLearnedBothSides(data, tick)),
    ],
  },
  {
    id: "program",
    begin: () => [runOf({ seed: 14, environments: 2 }), runOf({ seed: 14, environments: 2 })],
    tool: "score",
    goals: [
      (runs, tick) => runs.some(({ data }) => isProgrammed(data.robots[0], tick)),
      (runs, tick) => runs.every(({ lane }) => hasEnded(lane, tick)) && isLearnerBeaten(runs, tick),
    ],
  },
  {
    id: "boredom",
    begin: () => [runOf({ seed: 111, memory: LEARNED, settings: { boredom_limit: PARAMETERS.boredom_limit.max } })],
    tool: "patience",
    goals: [
      (runs, tick) => runs.some(({ data }) => wasStuck(data, tick)),
      (runs, tick) => runs.some((run) => hasFreedItself(run, tick)),
      (runs, tick) => runs.some((run) => hasEatenFast(run, tick)),
    ],
  },
  {
    id: "plant",
    begin: () => [runOf({ seed: 3, environments: 2, memory: LEARNED })],
    tool: "",
    goals: [
      (runs, tick) => runs.some(({ data }) => hasPassed(data, tick).length > 0),
      (runs, tick) => runs.some(({ data }) => areApart(hasPassed(data, tick))),
      (runs, tick) => runs.some(({ data }) => hadToTry(data, tick)),
    ],
  },
  {
    id: "sensor",
    begin: () => [runOf({ seed: 5, memory: LEARNED })],
    tool: "sensors",
    goals: [
      (runs, tick) => runs.some((run) => isStuckBySensor(run, tick)),
      (runs, tick) => runs.some((run) => eatsWithoutBelieving(run, tick)),
      (runs, tick) => runs.some((run) => bumpsBlindly(run, tick)),
    ],
  },
  {
    id: "share",
    begin: () => [runOf({ seed: 1, robots: 3 })],
    tool: "share",
    goals: [
      (runs, tick) => runs.some(({ lane }) => isSharing(lane, tick)),
      (runs, tick) => runs.some((run) => isSharing(run.lane, tick) && hasHeard(run, tick)),
      (runs, tick) => knowSooner(runs, tick),
    ],
  },
  {
    id: "talk",
    begin: () => [runOf({ seed: 12 })],
    tool: "talk",
    goals: [
      (_runs, _tick, talk) => tellsKnowingFromSaying(talk),
      (_runs, _tick, talk) => repeatsWhatItWasTaught(talk),
      (_runs, _tick, talk) => changedAnswer(talk),
    ],
  },
];

/**
 * @param {{seed: number, environments?: number, robots?: number, memory?: number[], settings?: Record<string, number>}} wanted
 * @returns {Experiment}
 */
function runOf({ seed, environments = 1, robots = 1, memory, settings = {} }) {
  const made = experimentOf({ seed, environments, robots, profile: "article" });
  return { ...made, robots: made.robots.map((setup) => ({ ...setup, memory: memory ?? null, settings })) };
}
