// @ts-check
/* The names of worlds. */

export const RANDOM = "random";

/** @param {string | WrittenWorld} world */
export function nameOf(world) {
  return typeof world === "string" ? world : world.name;
}
