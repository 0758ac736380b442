// @ts-check
/* The texts for the end of an environment and for a run that was started over. */

import { SIDE } from "../generated.js";
import { robotWords, say } from "./language.js";
import { minutes } from "./phrases.js";

/**
 * A heading and a sentence for how an environment ended, and after the last one for all of them.
 * @param {import("../types.js").Ended} ended
 * @param {boolean} done - Whether it was the last one.
 * @returns {[string, string]}
 */
export function ending(ended, done) {
  const { number, eaten, food, environments, environments_finished, environments_robot_s } = ended;
  const { point } = robotWords();
  if (done) return [say("allDoneBig"), say("endedAll", { finished: environments_finished, all: environments, time: minutes(environments_robot_s, point) })];
  const found = ended.finished ? say("allFood") : say("someFood", { eaten, food });
  return [found, say("endedAt", { number, time: minutes(ended.robot_s, point) })];
}

/**
 * What "start over" has done.
 * @param {EnvironmentScene} environment
 * @param {State[]} states
 */
export function restarted({ seed }, states) {
  const isEmpty = states.every(({ memory }) => memory.every((side) => side === SIDE.NOTHING));
  return say(isEmpty ? "restartedEmpty" : "restartedKept", { seed });
}
