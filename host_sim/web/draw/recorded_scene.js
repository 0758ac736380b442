// @ts-check
/* Fills a scene with a tick of a recorded run. */

/**
 * @param {Scene} scene
 * @param {RunData} data
 * @param {number} tick - One beyond the end shows the end.
 * @param {boolean} anew - Whether the run is another than before, and the trails begin anew.
 */
export function showTick(scene, data, tick, anew) {
  const [before, now] = [scene.state.tick, Math.min(tick, data.last)];
  const environment = data.sceneAt(now);
  const goesOn = !anew && now >= before && environment.first_tick === scene.environment.first_tick;
  if (goesOn) data.addTrails(scene.trails, before + 1, now);
  else data.trailsAt(now, scene.trails);
  scene.environment = environment;
  scene.states = data.statesAt(now);
}
