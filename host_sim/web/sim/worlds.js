// @ts-check
/* The worlds of runs: named ones and written ones. */

/** @typedef {Record<string, SimParams>} Worlds - The dimensions of each world with a name. */

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
