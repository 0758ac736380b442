/* Checks of the lessons' goals on a run, up to the tick shown, or on all runs; and on the conversation. */

import { CELL_COUNT, PARAMETERS, PATTERNS, SIDE, REASON } from "../generated.js";
import { hasEatenAll, hasEnded, isByHand, longestStretch, settingAt, stretchesOf, ticksPerObstacle } from "./evidence.js";
import { besideBar } from "../edit/items.js";
import type { RunData } from "../core/run_data.js";
import type { ShownRun } from "../lab/shown_run.js";
import type { Exchange, TalkBox } from "../talk/talk_box.js";
import type { Stretch } from "./evidence.js";
import type { Place } from "../types.js";

/** A run of which at least the first environment is simulated. */
export type Shown = { lane: ShownRun; data: RunData };

const FRONT_RIGHT = PATTERNS.indexOf("front-right");
const FRONT_LEFT = PATTERNS.indexOf("front-left");
const STUCK_S = 10;
const SOON_STUCK_S = 3;
const SOON_CLEAR_S = 4;
const FAST_S = 40;
const MOVED_MM = 300;
const SOON_ASKED_TICKS = 50;

function seconds(data: RunData, ticks: number) {
  return (ticks * data.measures.tick_ms) / 1000;
}

/** Whether a trial has ended, with one of these results. */
export function hasTried({ data }: Shown, tick: number, results = [0, 1]) {
  return data.robots[0].run.trials.some(([at, it]) => at <= tick && it && !it.frozen && results.includes(it.helped ?? NaN));
}

export function hasFailed(run: Shown, tick: number) {
  return hasTried(run, tick, [0]);
}

export function hasSucceeded(run: Shown, tick: number) {
  return hasTried(run, tick, [1]);
}

export function knowsSomething({ data }: Shown, tick: number) {
  return data.robots[0].memoryAt(tick).some(Boolean);
}

export function hasLearnedBothSides({ data }: Shown, tick: number) {
  const last = data.robots[0].lastLessons(tick);
  const learned = (pattern: number, side: number) =>
    last[pattern]?.side === side && !last[pattern]?.by_hand;
  return learned(FRONT_RIGHT, SIDE.LEFT) && learned(FRONT_LEFT, SIDE.RIGHT);
}

export function haveBothEnded(runs: Shown[], tick: number) {
  return runs.length > 1 && haveEnded(runs, tick);
}

/** Whether a person has written all that the robot knows. */
export function isProgrammed({ data }: Shown, tick: number) {
  return isByHand(data.robots[0], tick);
}

/** Whether all runs have ended. */
export function haveEnded(runs: Shown[], tick: number) {
  return runs.every(({ lane }) => hasEnded(lane, tick));
}

/** Whether a robot with a person's program has got clear sooner than one that learns, when all runs have ended. */
export function isLearnerBeaten(runs: Shown[], tick: number) {
  if (!haveEnded(runs, tick)) return false;
  const robots = runs.map(({ data }) => data.robots[0]);
  const learners = robots.filter((robot) => robot.lastLessons(tick).every((lesson) => !lesson?.by_hand));
  const programmed = robots.filter((robot) => isByHand(robot, tick));
  const best = Math.min(...programmed.map((robot) => ticksPerObstacle(robot, tick)));
  return learners.some((learner) => best < ticksPerObstacle(learner, tick));
}

/** Whether a robot that is less patient was bored, and never stuck for long, in a run that has ended. */
export function hasFreedItself({ lane, data }: Shown, tick: number) {
  const limit = settingAt(lane, { robot: 0, name: "boredom_limit" }, tick);
  const wasBored = data.robots[0].run.events.some(([at, what]) => what === "boredom" && at <= tick);
  const longest = seconds(data, longestStretch(data.robots[0], tick));
  return limit < PARAMETERS.boredom_limit.max && wasBored && longest <= SOON_CLEAR_S && hasEnded(lane, tick);
}

export function wasStuck({ data }: Shown, tick: number) {
  return seconds(data, longestStretch(data.robots[0], tick)) >= STUCK_S;
}

export function hasBeenStuck({ data }: Shown, tick: number) {
  return seconds(data, longestStretch(data.robots[0], tick)) >= SOON_STUCK_S;
}

export function hasPlant(run: Shown, tick: number) {
  return plantsPut(run, tick) > 0;
}

export function hasPlants(run: Shown, tick: number) {
  return plantsPut(run, tick) > 1;
}

/** How often a plant was put somewhere, up to a tick. */
function plantsPut({ lane: { experiment } }: Shown, tick: number) {
  return experiment.changes.filter((change) => (change.do === "plant" || change.do === "move_plant") && change.tick <= tick + 1).length;
}

export function hasEatenFast({ lane, data }: Shown, tick: number) {
  return hasEnded(lane, tick) && hasEatenAll(data, lane.last) && seconds(data, lane.last + 1) < FAST_S;
}

/** Whether a robot that knew nothing had to try at the plant. */
export function hadToTry({ data }: Shown, tick: number) {
  return meetingsOf(data).some((it) => it.last < tick && it.tried && it.knewNothing);
}

/** The meetings, up to a tick, after which the robot got past the plant by what it knew. */
function passes({ data }: Shown, tick: number) {
  return meetingsOf(data).filter(({ last, tried, knewNothing }) => last < tick && !tried && !knewNothing);
}

export function hasPassed(run: Shown, tick: number) {
  return passes(run, tick).length > 0;
}

/** Whether it got past the plant in places that are far apart. */
export function hasPassedElsewhere(run: Shown, tick: number) {
  const [first, ...others] = passes(run, tick);
  return others.some(({ at }) => Math.hypot(at.x - first.at.x, at.y - first.at.y) >= MOVED_MM);
}

/** The times up to a tick during which a sensor was broken in this way. */
function brokenTimes({ experiment }: ShownRun, how: string, tick: number) {
  const times: Stretch[] = [];
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

/** Whether a sensor has ever reported what was not there. */
export function isBroken({ lane }: Shown, tick: number) {
  return brokenTimes(lane, "stuck-on", tick + 1).length > 0;
}

export function isStuckBySensor({ lane, data }: Shown, tick: number) {
  const blocked = stretchesOf(data.robots[0]);
  return brokenTimes(lane, "stuck-on", tick).some((time) => blocked.some(({ first, last }) =>
    seconds(data, Math.min(last, time.last) - Math.max(first, time.first)) >= STUCK_S));
}

export function eatsWithoutBelieving({ lane, data }: Shown, tick: number) {
  const disbelieves = settingAt(lane, { robot: 0, name: "distrust" }, tick) > 0;
  return disbelieves && brokenTimes(lane, "stuck-on", tick).some(({ first, last }) =>
    data.robots[0].run.events.some(([at, what]) => what === "eat" && at > first && at <= last));
}

export function bumpsBlindly({ lane, data }: Shown, tick: number) {
  return brokenTimes(lane, "stuck-off", tick).some(({ first, last }) =>
    data.robots[0].columns.bump.subarray(first, last + 1).some(Boolean));
}

export function isSharing({ lane }: Shown, tick: number) {
  const { robots } = lane.experiment;
  return robots.length > 1 && robots.every((_, robot) => settingAt(lane, { robot, name: "share" }, tick) > 0);
}

/** Whether robots share what they know, and one knows a turn that came neither from itself nor from a person. */
export function hasHeard(run: Shown, tick: number) {
  const { lane, data } = run;
  if (!isSharing(run, tick) || lane.experiment.changes.some((change) => change.do === "write")) return false;
  const heard = data.robots.flatMap(({ run }) => run.lessons).filter(({ by_hand, side }) => by_hand && side);
  return heard.some((lesson) => lesson.tick > 0 && lesson.tick <= tick);
}

/**
 * Whether all robots of a run with sharing know the turns for both sides at this tick, but not all of a run without.
 */
export function knowSooner(runs: Shown[], tick: number) {
  const know = ({ data }: Shown) => data.robots.every((robot) => {
    const memory = robot.memoryAt(Math.min(tick, data.last));
    return memory[FRONT_RIGHT] && memory[FRONT_LEFT];
  });
  const sharing = runs.filter((run) => hasHeard(run, tick));
  const silent = runs.filter((run) => !isSharing(run, tick) && run.data.robots.length > 1);
  return sharing.some(know) && silent.some((run) => !know(run));
}

/** Pairs of an exchange and a later one with the same question. */
function repeated(history: Exchange[]) {
  return history.flatMap((one, i) => history.slice(i + 1).filter((other) => isSame(one, other)).map((other) => ({ one, other })));
}

function isSame(one: Exchange, other: Exchange) {
  const [a, b] = [one, other].map(({ sentence }) => sentence.toUpperCase().match(/[\p{L}\p{N}]+/gu)?.join(" "));
  return a !== undefined && a === b;
}

/** Whether ELIZA and a robot were asked the same, and only the robot knew. */
export function tellsKnowingFromSaying({ history }: TalkBox) {
  const isEliza = ({ who }: Exchange) => who.startsWith("eliza");
  return repeated(history).some(({ one, other }) =>
    isEliza(one) !== isEliza(other) && [one, other].every((it) => (it.said.mark === "words") === isEliza(it)));
}

export function askedEliza({ history }: TalkBox) {
  return history.some(({ who }) => who.startsWith("eliza"));
}

export function repeatsWhatItWasTaught({ history, taught }: TalkBox) {
  return history.some(({ said }) => said.mark === "words" && taught.has(said.text));
}

/** Whether an answer from the log differs from that to the same question before the run was changed. */
export function changedAnswer({ history }: TalkBox) {
  return repeated(history).some(({ one, other }) =>
    one.who === other.who && one.said.mark === "log" && other.said.mark === "log" && one.said.text !== other.said.text
    && (other.changes ?? 0) > (one.changes ?? 0) && Math.abs((other.tick ?? 0) - (one.tick ?? 0)) <= SOON_ASKED_TICKS);
}

/** What a person added: a bar as in a scene, or a plant as a bar whose ends are its middle; and its radius. */
type Thing = { bar: number[]; radius: number };

/**
 * A meeting: where the thing stood, when the robot was clear again, whether it had to try, and whether it knew nothing.
 */
type Meeting = { at: Place; last: number; tried: boolean; knewNothing: boolean };

/** How far beyond its sensors' range a thing may be that a robot has just noticed, mm. */
const SLACK_MM = 15;

const known: WeakMap<RunData, Meeting[]> = new WeakMap();

/** @param data - Of its first robot. */
function meetingsOf(data: RunData) {
  const [robot] = data.robots;
  const found = known.get(data) ?? stretchesOf(robot).flatMap(({ first, last }) => meetingIn(data, first, last));
  known.set(data, found);
  return found;
}

function meetingIn(data: RunData, first: number, last: number): Meeting[] {
  const [robot] = data.robots;
  const { measures } = data;
  const near = measures.body + measures.reach + SLACK_MM;
  const from = robot.stateAt(first, []);
  const thing = addedThings(data, first).find(({ bar, radius }) => besideBar(bar, from).away - radius <= near);
  if (!thing) return [];
  const tried = robot.columns.reason.subarray(first, last + 1).includes(REASON.TRIAL);
  const knewNothing = !robot.memoryAt(first).some(Boolean);
  return [{ at: middleOf(thing), last, tried, knewNothing }];
}

/** What is in the arena at a tick that was not there when the environment began. */
function addedThings(data: RunData, tick: number): Thing[] {
  const scene = data.sceneAt(tick);
  const begun = data.run.scenes.find(([, it]) => it.number === scene.number)?.[1] ?? scene;
  const ids = begun.bars.map(([id]) => id);
  const bars = scene.bars.filter(([id]) => !ids.includes(id)).map((bar) => ({ bar, radius: data.measures.bar / 2 }));
  const plants = (scene.plants ?? []).map(([id, x, y, radius]) => ({ bar: [id, x, y, x, y], radius }));
  return [...bars, ...plants];
}

function middleOf({ bar: [, ax, ay, bx, by] }: Thing) {
  return { x: (ax + bx) / 2, y: (ay + by) / 2 };
}

/* What robots unlearn: how sure they are of each cell, and what they know after their motors were swapped. */

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

export function areSwapped({ lane }: Shown, tick: number) {
  return (swappedAt(lane) ?? Infinity) <= tick + 1;
}

export function hasThreeBeads({ lane }: Shown, tick: number) {
  return (lane.beads[0] ?? []).some(([at, beads]) => at <= tick && beads.includes(BEADS_MAX));
}

/** Whether a robot has become less sure of a cell, or has forgotten it, since its motors were swapped. */
export function doubts(run: Shown, tick: number) {
  return hasLostBeads(run, tick, swappedAt(run.lane) ?? Infinity);
}

/** The same since a tick; since the beginning by default. */
export function hasLostBeads({ lane }: Shown, tick: number, from = 0) {
  const [known = []] = lane.beads;
  return known.some(([at, beads], i) => i > 0 && at >= from && at <= tick && CELLS.some((cell) => beads[cell] < known[i - 1][1][cell]));
}

/** Whether a robot has learned to turn the other way round since its motors were swapped. */
export function knowsMirrored(run: Shown, tick: number) {
  const memory = run.data.robots[0].memoryAt(tick);
  return areSwapped(run, tick) && memory[FRONT_RIGHT] === SIDE.RIGHT && memory[FRONT_LEFT] === SIDE.LEFT;
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
