// @ts-check
/* An experiment as the fields of a link, and back. */

import { RANDOM } from "../core/world_names.js";
import { IDEAL } from "../sim/arena.js";
import { experimentOf } from "./shown_run.js";

/** @typedef {import("../program/link.js").Linked} Linked */

/**
 * The fields for a link; a world or a body from a file is left out.
 * @param {Experiment} experiment
 * @returns {Partial<Linked>}
 */
export function fieldsOf({ seed, environments, robots, changes, world = RANDOM, body = IDEAL }) {
  const [{ profile, settings, memory, program }] = robots;
  const setups = robots.map((it) => ({ ...it, program: undefined }));
  const differ = setups.some((it) => it.seed !== undefined || JSON.stringify(it) !== JSON.stringify(setups[0]));
  return {
    seed, environments, behaviour: profile,
    ...(robots.length > 1 && { robots: robots.length }),
    ...(typeof world === "string" && { world }),
    ...(typeof body === "string" && body !== IDEAL && { body }),
    ...(memory && { memory }),
    settings,
    ...(differ && { setups }),
    ...(changes.length && { changes }),
    ...(program !== undefined && { program }),
  };
}

/**
 * The experiment that a link has, without its program.
 * @param {Partial<Linked>} linked
 * @returns {Experiment}
 */
export function experimentFrom({ seed = 1, environments = 5, robots = 1, world, body, behaviour = "article", memory, settings, setups, changes = [] }) {
  const made = experimentOf({ seed, environments, robots, profile: behaviour, world, body });
  const alike = made.robots.map((it) => ({ ...it, settings: { ...it.settings, ...settings }, memory: memory ?? it.memory }));
  return { ...made, robots: setups ?? alike, changes };
}
