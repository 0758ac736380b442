/* The names of worlds. */

import type { WrittenWorld } from "../types.js";

export const RANDOM = "random";

export function nameOf(world: string | WrittenWorld) {
  return typeof world === "string" ? world : world.name;
}
