/* The ten lessons: how each begins, what each step needs, when it is done, and when goals are reached. Their texts are in texts/. */

import { PARAMETERS } from "../generated.js";
import { experimentOf } from "../lab/shown_run.js";
import * as goals from "./goals.js";
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

/** A goal that one of the runs reaches. */
function some(check: (run: Shown, tick: number) => boolean): Goal {
  return (runs, tick) => runs.some((run) => check(run, tick));
}

/** A goal that a conversation reaches. */
function talk(check: (talk: TalkBox) => boolean): Goal {
  return (_runs, _tick, told) => check(told.talk);
}

/** A goal that runs reach which no arena shows. */
function samples(check: (samples: Samples) => boolean): Goal {
  return (_runs, _tick, told) => check(told.samples);
}

export const PLANS: Plan[] = [
  {
    id: "watch",
    begin: () => [runOf({ seed: 12, environments: 3 })],
    steps: [
      { seen: hasBegun },
      { seen: some(goals.hasTried) },
      { tools: ["boxes"], seen: some(goals.knowsSomething) },
      { tools: ["boxes"], seen: some(goals.hasLearnedBothSides) },
    ],
    goals: [some(goals.hasFailed), some(goals.hasSucceeded), some(goals.hasLearnedBothSides)],
  },
  {
    id: "program",
    begin: () => [runOf({ seed: 48, environments: 2 }), runOf({ seed: 48, environments: 2 })],
    names: ["learner", "yours"],
    steps: [
      { seen: areTwo },
      { tools: ["boxes"], seen: some(goals.isProgrammed) },
      { tools: ["score"], seen: goals.haveEnded },
      { tools: ["score"], seen: goals.isLearnerBeaten },
    ],
    goals: [some(goals.isProgrammed), goals.isLearnerBeaten],
  },
  {
    id: "boredom",
    begin: () => [runOf({ seed: 111, memory: LEARNED, settings: { boredom_limit: PARAMETERS.boredom_limit.max } })],
    steps: [
      { seen: some(goals.hasBeenStuck) },
      { tools: ["whatIf"], seen: areTwo },
      { tools: ["patience"], seen: some(goals.hasFreedItself) },
      { tools: ["patience"], seen: some(goals.hasEatenFast) },
    ],
    goals: [some(goals.wasStuck), some(goals.hasFreedItself), some(goals.hasEatenFast)],
  },
  {
    id: "plant",
    begin: () => [runOf({ seed: 3, environments: 2, memory: LEARNED })],
    steps: [
      { tools: ["addPlant"], seen: some(goals.hasPlant) },
      { tools: ["addPlant"], seen: some(goals.hasPlants) },
      { tools: ["addPlant"], seen: some(goals.hasPassedElsewhere) },
      { tools: ["erase", "addPlant"], seen: some(goals.hadToTry) },
    ],
    goals: [some(goals.hasPassed), some(goals.hasPassedElsewhere), some(goals.hadToTry)],
  },
  {
    id: "sensor",
    begin: () => [runOf({ seed: 5, memory: LEARNED })],
    steps: [
      { tools: ["sensors"], seen: some(goals.isBroken) },
      { seen: some(goals.isStuckBySensor) },
      { tools: ["distrust"], seen: some(goals.eatsWithoutBelieving) },
      { tools: ["sensors"], seen: some(goals.bumpsBlindly) },
    ],
    goals: [some(goals.isStuckBySensor), some(goals.eatsWithoutBelieving), some(goals.bumpsBlindly)],
  },
  {
    id: "share",
    begin: () => [runOf({ seed: 1, robots: 3 })],
    steps: [
      { seen: () => true },
      { tools: ["whatIf"], seen: areTwo },
      { tools: ["share"], seen: some(goals.isSharing) },
      { seen: goals.knowSooner },
    ],
    goals: [some(goals.isSharing), some(goals.hasHeard), goals.knowSooner],
  },
  {
    id: "talk",
    begin: () => [runOf({ seed: 12 })],
    steps: [
      { seen: (_runs, tick) => tick >= TALK_TICKS },
      { tools: ["talk"], seen: talk(goals.askedEliza) },
      { tools: ["talk"], seen: talk(goals.tellsKnowingFromSaying) },
      { tools: ["teach", "talk"], seen: talk(goals.repeatsWhatItWasTaught) },
      { tools: ["talk", "boxes"], seen: talk(goals.changedAnswer) },
    ],
    goals: [talk(goals.tellsKnowingFromSaying), talk(goals.repeatsWhatItWasTaught), talk(goals.changedAnswer)],
  },
  {
    id: "unlearn",
    begin: () => ["article", "adaptive"].map((profile) => runOf({ seed: 13, environments: 2, memory: LEARNED, profile })),
    names: ["article", "adaptive"],
    steps: [
      { seen: hasBegun },
      { tools: ["swap"], seen: (runs, tick) => runs.every((run) => goals.areSwapped(run, tick)) },
      { tools: ["boxes"], seen: some(goals.knowsMirrored) },
      { tools: ["score"], seen: goals.haveEnded },
    ],
    goals: [some(goals.doubts), some(goals.knowsMirrored), some(goals.neverRelearned)],
  },
  {
    id: "chance",
    begin: () => ["article", "searcher"].map((profile) => runOf({ seed: 2, profile })),
    names: ["article", "searcher"],
    steps: [
      { seen: goals.haveEnded },
      { tools: ["samples"], seen: samples(({ count }) => count >= 10) },
      { tools: ["samples"], seen: samples(({ count }) => count >= 100) },
      { tools: ["samples"], seen: samples(({ tried }) => tried.size > 1) },
    ],
    goals: [goals.haveBothEnded, samples(({ wereTogether }) => wereTogether), samples(({ wereApart }) => wereApart)],
  },
  {
    id: "matchboxes",
    begin: () => [runOf({ seed: 16, environments: 2, profile: "adaptive" })],
    steps: [
      {},
      {},
      {},
      { tools: ["boxes"], seen: some(goals.hasThreeBeads) },
      { tools: ["swap", "boxes"], seen: some(goals.refilled) },
    ],
    goals: [some(goals.hasThreeBeads), some(goals.hasLostBeads), some(goals.refilled)],
  },
];

function runOf(
  { seed, environments = 1, robots = 1, memory, settings = {}, profile = "article" }: { seed: number, environments?: number, robots?: number, memory?: number[], settings?: Record<string, number>, profile?: string },
): Experiment {
  const made = experimentOf({ seed, environments, robots, profile });
  return { ...made, robots: made.robots.map((setup) => ({ ...setup, memory: memory ?? null, settings })) };
}
