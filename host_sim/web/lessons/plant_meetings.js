// @ts-check
/* The times at which a robot had to get past something that a person put into its arena. */

import { REASON } from "../generated.js";
import { besideBar } from "../edit/hit_testing.js";
import { stretchesOf } from "./evidence.js";

/**
 * What was put there: a bar as in a scene, or a plant as a bar whose ends are its middle; and its radius.
 * @typedef {{bar: number[], radius: number}} Thing
 *
 * A meeting: where the thing stood, when the robot was clear again, whether it had to try, and whether it knew nothing.
 * @typedef {{at: Place, last: number, tried: boolean, knewNothing: boolean}} Meeting
 */

/** How far beyond its sensors' range a thing may be that a robot has just noticed, mm. */
const SLACK_MM = 15;

/** @type {WeakMap<RunData, Meeting[]>} */
const known = new WeakMap();

/** @param {RunData} data - Of its first robot. */
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
  const thing = addedThings(data, first).find(({ bar, radius }) => besideBar(bar, from).away - radius <= near);
  if (!thing) return [];
  const tried = robot.columns.reason.subarray(first, last + 1).includes(REASON.TRIAL);
  const knewNothing = !robot.memoryAt(first).some(Boolean);
  return [{ at: middleOf(thing), last, tried, knewNothing }];
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
  const bars = scene.bars.filter(([id]) => !ids.includes(id)).map((bar) => ({ bar, radius: data.measures.bar / 2 }));
  const plants = (scene.plants ?? []).map(([id, x, y, radius]) => ({ bar: [id, x, y, x, y], radius }));
  return [...bars, ...plants];
}

/** @param {Thing} thing */
function middleOf({ bar: [, ax, ay, bx, by] }) {
  return { x: (ax + bx) / 2, y: (ay + by) / 2 };
}
