// @ts-check
/* The times at which a robot had to get past something that a person put into its arena. */

import { REASON } from "../generated.js";
import { stretchesOf } from "./evidence.js";

/**
 * What was put there: a thick line, or a point.
 * @typedef {{a: Place, b: Place, radius: number}} Thing
 *
 * A meeting: where the thing stood, when the robot was clear again, whether it had to try, and whether it knew nothing.
 * @typedef {{at: Place, last: number, tried: boolean, knewNothing: boolean}} Meeting
 */

/** How far beyond its sensors' range a thing may be that a robot has just noticed, mm. */
const SLACK_MM = 15;

/** @type {WeakMap<RunData, Meeting[]>} */
const known = new WeakMap();

/**
 * All meetings of the first robot.
 * @param {RunData} data
 */
export function meetingsOf(data) {
  const [robot] = data.robots;
  const found = known.get(data) ?? stretchesOf(robot).flatMap(({ first, last }) => meetingIn(data, first, last));
  known.set(data, found);
  return found;
}

/**
 * @param {RunData} data
 * @param {number} first
 * @param {number} last
 * @returns {Meeting[]}
 */
function meetingIn(data, first, last) {
  const [robot] = data.robots;
  const { measures } = data;
  const near = measures.body + measures.reach + SLACK_MM;
  const from = robot.stateAt(first, []);
  const thing = addedThings(data, first).find((it) => distance(from, it) <= near);
  if (!thing) return [];
  const tried = robot.columns.reason.subarray(first, last + 1).includes(REASON.TRIAL);
  const knewNothing = !robot.memoryAt(first).some(Boolean);
  return [{ at: middle(thing), last, tried, knewNothing }];
}

/**
 * What is in the arena at a tick that was not there when the environment began.
 * @param {RunData} data
 * @param {number} tick
 * @returns {Thing[]}
 */
function addedThings(data, tick) {
  const scene = data.sceneAt(tick);
  const begun = data.run.scenes.find(([, it]) => it.number === scene.number)?.[1] ?? scene;
  const ids = begun.bars.map(([id]) => id);
  const bars = scene.bars.filter(([id]) => !ids.includes(id)).map(([, ax, ay, bx, by]) => (
    { a: { x: ax, y: ay }, b: { x: bx, y: by }, radius: data.measures.bar / 2 }));
  const plants = (scene.plants ?? []).map(([, x, y, radius]) => ({ a: { x, y }, b: { x, y }, radius }));
  return [...bars, ...plants];
}

/** @param {Thing} thing */
function middle({ a, b }) {
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
}

/**
 * From a place to the rim of a thing.
 * @param {Place} from
 * @param {Thing} thing
 */
function distance(from, { a, b, radius }) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const square = dx * dx + dy * dy;
  const part = square ? Math.max(0, Math.min(1, ((from.x - a.x) * dx + (from.y - a.y) * dy) / square)) : 0;
  return Math.hypot(a.x + part * dx - from.x, a.y + part * dy - from.y) - radius;
}
