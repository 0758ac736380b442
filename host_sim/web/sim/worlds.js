// @ts-check
/* The worlds that a run can take place in, those with a name and written ones, and the dimensions that a drawing needs. */

import { PARAMETERS } from "../generated.js";

/**
 * @typedef {import("../types.js").SimParams} SimParams
 * @typedef {import("../types.js").WrittenWorld} WrittenWorld
 *
 * The dimensions of each world with a name.
 * @typedef {Record<string, SimParams>} Worlds
 */

/**
 * What a run's world is drawn from.
 * @param {string | WrittenWorld} world
 * @param {Worlds} worlds
 * @returns {{params: SimParams, written?: WrittenWorld}}
 */
export function worldOf(world, worlds) {
  if (typeof world === "string") return { params: worlds[world] };
  const [width_mm, height_mm] = world.size ?? [worlds.random.width_mm, worlds.random.height_mm];
  return { params: { ...worlds.random, width_mm, height_mm }, written: world };
}

/**
 * The dimensions that a drawing needs.
 * @param {import("../types.js").SimParams} params
 * @param {import("../types.js").Experiment} experiment
 * @returns {import("../types.js").Measures}
 */
export function measuresOf(params, { robots }) {
  return {
    width: params.width_mm,
    height: params.height_mm,
    body: params.body_radius_mm,
    track: params.wheel_track_mm,
    reach: params.sensor_reach_mm,
    beam: params.beam_width_mm,
    eat: params.eat_reach_mm,
    bar: params.bar_thickness_mm,
    tick_ms: params.tick_s * 1000,
    boredom: robots[0].settings.boredom_limit ?? PARAMETERS.boredom_limit.default,
  };
}
