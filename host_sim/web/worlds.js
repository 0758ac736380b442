// @ts-check
/* The worlds that a run can take place in: those with a name, as host_sim/world/worlds.py has them, and written ones. */

import { drawBars } from "./layouts.js";
import { drawCorridors, drawDeadEnds, drawWritten } from "./world_draws.js";

/**
 * @typedef {import("./layouts.js").Draw} Draw
 * @typedef {import("./layouts.js").SimParams} SimParams
 * @typedef {import("./types.js").WrittenWorld} WrittenWorld
 *
 * The dimensions of each world with a name.
 * @typedef {Record<string, SimParams>} Worlds
 */

/**
 * What draws the worlds that are not bars anywhere.
 * @type {Record<string, Draw>}
 */
const DRAWS = { corridors: drawCorridors, "dead-ends": drawDeadEnds };

/**
 * @param {string | WrittenWorld} world
 * @param {Worlds} worlds
 * @returns {{params: SimParams, draw: Draw}}
 */
export function worldOf(world, worlds) {
  if (typeof world === "string") return { params: worlds[world], draw: DRAWS[world] ?? drawBars };
  const [width_mm, height_mm] = world.size ?? [worlds.random.width_mm, worlds.random.height_mm];
  return { params: { ...worlds.random, width_mm, height_mm }, draw: drawWritten(world) };
}
