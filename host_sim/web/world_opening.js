// @ts-check
/* The experiment that a world file is of: a world that a person wrote, or that of a run with what changed in it. */

import { worldIn } from "./log_opening.js";
import { ROBOTS_MAX } from "./native_run.js";
import { writtenWorld } from "./written_world.js";

/**
 * @typedef {import("./types.js").Experiment} Experiment
 * @typedef {import("./worlds.js").Worlds} Worlds
 */

/**
 * @param {Worlds} worlds
 * @param {{name: string, text: string}} file
 * @param {Experiment} base - Says what the file does not.
 * @returns {Experiment}
 */
export function openWorld(worlds, { name, text }, base) {
  if (name.endsWith(".toml")) return { ...base, world: writtenWorld(name, text, worlds.random) };
  const { seed, of, limit_ticks, robots = 1, edits, world } = worldIn(text, worlds);
  if (!(robots >= 1 && robots <= ROBOTS_MAX)) throw new Error(`${name} is of ${robots} robots; this page has room for ${ROBOTS_MAX}`);
  const setups = Array.from({ length: robots }, () => ({ ...base.robots[0] }));
  return { ...base, seed, environments: of, limit_ticks, robots: setups, changes: edits, world: world ?? base.world };
}
