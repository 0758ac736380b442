// @ts-check
/* The dimensions that a drawing needs, as host_sim/view/state.py has them. */

import { PARAMETERS } from "../generated.js";

/**
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
