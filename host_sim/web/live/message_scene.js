// @ts-check
/* Fills a scene with a message of a live run. */

import { Scene } from "../draw/scene.js";

/**
 * @param {Scene} scene
 * @param {Message} message
 */
export function showMessage(scene, { measures, environment, states, trails, news }) {
  if (measures && environment) restart(scene, new Scene(measures, environment, states));
  if (environment) enter(scene, environment);
  scene.states = states;
  scene.news = news ?? scene.news;
  trails.forEach((points, i) => {
    for (let at = 0; at < points.length; at += 3) scene.trails[i].add(points[at], points[at + 1], points[at + 2]);
  });
}

/**
 * The page has connected again: nothing of before holds, but for the robot that is selected.
 * @param {Scene} scene
 * @param {Scene} anew
 */
function restart(scene, anew) {
  const { node } = scene;
  Object.assign(scene, anew);
  if (scene.states.some((state) => state.node === node)) scene.node = node;
}

/**
 * @param {Scene} scene
 * @param {EnvironmentScene} environment
 */
function enter(scene, environment) {
  if (environment.first_tick !== scene.environment.first_tick) scene.trails.forEach((trail) => trail.clear());
  scene.environment = environment;
}
