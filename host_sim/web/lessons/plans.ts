/* The ten lessons: how each begins, what each step needs, when it is done, and when goals are reached. Their texts are in texts/. */

import { PARAMETERS } from "../generated.js";
import { experimentOf } from "../lab/shown_run.js";
import { areSwapped, hasLostBeads, hasThreeBeads, knowsMirrored, neverRelearned, refilled } from "./bead_goals.js";
import { hasEnded, isProgrammed } from "./evidence.js";
import { areApart, bumpsBlindly, eatsWithoutBelieving, hadToTry, hasEatenFast, hasFreedItself, isBroken } from "./goals.js";
import { hasBeenStuck, hasHeard, hasLearnedBothSides, hasPassed, hasTried, isLearnerBeaten, isSharing } from "./goals.js";
import { isStuckBySensor, knowSooner, plantsPut, wasStuck } from "./goals.js";
import { changedAnswer, repeatsWhatItWasTaught, tellsKnowingFromSaying, wasAsked } from "./goals.js";
import type { TalkBox } from "../talk/talk_box.js";
import type { Experiment } from "../types.js";
import type { Shown } from "./goals.js";
import type { Samples } from "./samples.js";
import type { ToolName } from "./tools.js";

/** What was said, and how long robots took in runs that no arena shows. */
type Told = { talk: TalkBox; samples: Samples };

/**
 * Whether a goal is reached or a step done, by what these runs show up to a tick, and by what was said and counted.
 */
export type Goal = (runs: Shown[], tick: number, told: Told) => boolean;

/** What a step has in it, and when the page has seen it done; without that, a person says so. */
type Step = { tools?: ToolName[]; seen?: Goal };

/**
 * `begin` are the runs that a lesson begins with; the last one is selected. `names` are what they are called: keys of the
 * texts, or behaviours.
 */
export interface Plan {
  id: "watch" | "program" | "boredom" | "plant" | "sensor" | "share" | "talk" | "unlearn" | "chance" | "matchboxes";
  begin: () => Experiment[];
  names?: string[];
  steps: Step[];
  goals: Goal[];
}

/** The memory of a robot that has learned everything. */
const LEARNED = [0, 1, 1, 1, 2, 1, 2, 1];
const BEGUN_TICKS = 50;
const TALK_TICKS = 1000;

const hasBegun: Goal = (_runs, tick) => tick >= BEGUN_TICKS;
const areTwo: Goal = (runs) => runs.length > 1;
const haveEnded: (runs: Shown[], tick: number) => boolean = (runs, tick) => runs.every(({ lane }) => hasEnded(lane, tick));

export const PLANS: Plan[] = [
  {
    id: "watch",
    begin: () => [runOf({ seed: 12, environments: 3 })],
    steps: [
      { seen: hasBegun },
      { seen: (runs, tick) => runs.some(({ data }) => hasTried(data, tick, 0) || hasTried(data, tick, 1)) },
      { tools: ["boxes"], seen: (runs, tick) => runs.some(({ data }) => data.robots[0].memoryAt(tick).some(Boolean)) },
      { tools: ["boxes"], seen: (runs, tick) => runs.some(({ data }) => hasLearnedBothSides(data, tick)) },
    ],
    goals: [
      (runs, tick) => runs.some(({ data }) => hasTried(data, tick, 0)),
      (runs, tick) => runs.some(({ data }) => hasTried(data, tick, 1)),
      (runs, tick) => runs.some(({ data }) => hasLearnedBothSides(data, tick)),
    ],
  },
  {
    id: "program",
    begin: () => [runOf({ seed: 48, environments: 2 }), runOf({ seed: 48, environments: 2 })],
    names: ["learner", "yours"],
    steps: [
      { seen: areTwo },
      { tools: ["boxes"], seen: (runs, tick) => runs.some(({ data }) => isProgrammed(data.robots[0], tick)) },
      { tools: ["score"], seen: haveEnded },
      { tools: ["score"], seen: (runs, tick) => haveEnded(runs, tick) && isLearnerBeaten(runs, tick) },
    ],
    goals: [
      (runs, tick) => runs.some(({ data }) => isProgrammed(data.robots[0], tick)),
      (runs, tick) => haveEnded(runs, tick) && isLearnerBeaten(runs, tick),
    ],
  },
  {
    id: "boredom",
    begin: () => [runOf({ seed: 111, memory: LEARNED, settings: { boredom_limit: PARAMETERS.boredom_limit.max } })],
    steps: [
      { seen: (runs, tick) => runs.some(({ data }) => hasBeenStuck(data, tick)) },
      { tools: ["whatIf"], seen: areTwo },
      { tools: ["patience"], seen: (runs, tick) => runs.some((run) => hasFreedItself(run, tick)) },
      { tools: ["patience"], seen: (runs, tick) => runs.some((run) => hasEatenFast(run, tick)) },
    ],
    goals: [
      (runs, tick) => runs.some(({ data }) => wasStuck(data, tick)),
      (runs, tick) => runs.some((run) => hasFreedItself(run, tick)),
      (runs, tick) => runs.some((run) => hasEatenFast(run, tick)),
    ],
  },
  {
    id: "plant",
    begin: () => [runOf({ seed: 3, environments: 2, memory: LEARNED })],
    steps: [
      { tools: ["addPlant"], seen: (runs, tick) => runs.some(({ lane }) => plantsPut(lane, tick) > 0) },
      { tools: ["addPlant"], seen: (runs, tick) => runs.some(({ lane }) => plantsPut(lane, tick) > 1) },
      { tools: ["addPlant"], seen: (runs, tick) => runs.some(({ data }) => areApart(hasPassed(data, tick))) },
      { tools: ["erase", "addPlant"], seen: (runs, tick) => runs.some(({ data }) => hadToTry(data, tick)) },
    ],
    goals: [
      (runs, tick) => runs.some(({ data }) => hasPassed(data, tick).length > 0),
      (runs, tick) => runs.some(({ data }) => areApart(hasPassed(data, tick))),
      (runs, tick) => runs.some(({ data }) => hadToTry(data, tick)),
    ],
  },
  {
    id: "sensor",
    begin: () => [runOf({ seed: 5, memory: LEARNED })],
    steps: [
      { tools: ["sensors"], seen: (runs, tick) => runs.some(({ lane }) => isBroken(lane, tick)) },
      { seen: (runs, tick) => runs.some((run) => isStuckBySensor(run, tick)) },
      { tools: ["distrust"], seen: (runs, tick) => runs.some((run) => eatsWithoutBelieving(run, tick)) },
      { tools: ["sensors"], seen: (runs, tick) => runs.some((run) => bumpsBlindly(run, tick)) },
    ],
    goals: [
      (runs, tick) => runs.some((run) => isStuckBySensor(run, tick)),
      (runs, tick) => runs.some((run) => eatsWithoutBelieving(run, tick)),
      (runs, tick) => runs.some((run) => bumpsBlindly(run, tick)),
    ],
  },
  {
    id: "share",
    begin: () => [runOf({ seed: 1, robots: 3 })],
    steps: [
      { seen: () => true },
      { tools: ["whatIf"], seen: areTwo },
      { tools: ["share"], seen: (runs, tick) => runs.some(({ lane }) => isSharing(lane, tick)) },
      { seen: (runs, tick) => knowSooner(runs, tick) },
    ],
    goals: [
      (runs, tick) => runs.some(({ lane }) => isSharing(lane, tick)),
      (runs, tick) => runs.some((run) => isSharing(run.lane, tick) && hasHeard(run, tick)),
      (runs, tick) => knowSooner(runs, tick),
    ],
  },
  {
    id: "talk",
    begin: () => [runOf({ seed: 12 })],
    steps: [
      { seen: (_runs, tick) => tick >= TALK_TICKS },
      { tools: ["talk"], seen: (_runs, _tick, { talk }) => wasAsked(talk, "eliza") },
      { tools: ["talk"], seen: (_runs, _tick, { talk }) => tellsKnowingFromSaying(talk) },
      { tools: ["teach", "talk"], seen: (_runs, _tick, { talk }) => repeatsWhatItWasTaught(talk) },
      { tools: ["talk", "boxes"], seen: (_runs, _tick, { talk }) => changedAnswer(talk) },
    ],
    goals: [
      (_runs, _tick, { talk }) => tellsKnowingFromSaying(talk),
      (_runs, _tick, { talk }) => repeatsWhatItWasTaught(talk),
      (_runs, _tick, { talk }) => changedAnswer(talk),
    ],
  },
  {
    id: "unlearn",
    begin: () => ["article", "adaptive"].map((profile) => runOf({ seed: 13, environments: 2, memory: LEARNED, profile })),
    names: ["article", "adaptive"],
    steps: [
      { seen: hasBegun },
      { tools: ["swap"], seen: (runs, tick) => runs.every(({ lane }) => areSwapped(lane, tick)) },
      { tools: ["boxes"], seen: (runs, tick) => runs.some((run) => knowsMirrored(run, tick)) },
      { tools: ["score"], seen: haveEnded },
    ],
    goals: [
      (runs, tick) => runs.some((run) => hasLostBeads(run, tick, true)),
      (runs, tick) => runs.some((run) => knowsMirrored(run, tick)),
      (runs, tick) => runs.some((run) => neverRelearned(run, tick)),
    ],
  },
  {
    id: "chance",
    begin: () => ["article", "searcher"].map((profile) => runOf({ seed: 2, profile })),
    names: ["article", "searcher"],
    steps: [
      { seen: haveEnded },
      { tools: ["samples"], seen: (_runs, _tick, { samples }) => samples.count >= 10 },
      { tools: ["samples"], seen: (_runs, _tick, { samples }) => samples.count >= 100 },
      { tools: ["samples"], seen: (_runs, _tick, { samples }) => samples.tried.size > 1 },
    ],
    goals: [
      (runs, tick) => haveEnded(runs, tick) && runs.length > 1,
      (_runs, _tick, { samples }) => samples.wereTogether,
      (_runs, _tick, { samples }) => samples.wereApart,
    ],
  },
  {
    id: "matchboxes",
    begin: () => [runOf({ seed: 16, environments: 2, profile: "adaptive" })],
    steps: [
      {},
      {},
      {},
      { tools: ["boxes"], seen: (runs, tick) => runs.some((run) => hasThreeBeads(run, tick)) },
      { tools: ["swap", "boxes"], seen: (runs, tick) => runs.some((run) => refilled(run, tick)) },
    ],
    goals: [
      (runs, tick) => runs.some((run) => hasThreeBeads(run, tick)),
      (runs, tick) => runs.some((run) => hasLostBeads(run, tick, false)),
      (runs, tick) => runs.some((run) => refilled(run, tick)),
    ],
  },
];

function runOf(
  { seed, environments = 1, robots = 1, memory, settings = {}, profile = "article" }: { seed: number, environments?: number, robots?: number, memory?: number[], settings?: Record<string, number>, profile?: string },
): Experiment {
  const made = experimentOf({ seed, environments, robots, profile });
  return { ...made, robots: made.robots.map((setup) => ({ ...setup, memory: memory ?? null, settings })) };
}
