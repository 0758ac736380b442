/* Makes an experiment from a world file: a person's own world, or that of a run with its changes. */

import { PAGE_ROBOTS_MAX } from "../generated.js";
import { settingsOf } from "./arena.js";
import { worldIn } from "./log_opening.js";
import { WrittenError, checkedWorld } from "./native_layouts.js";
import { LineError, parseToml } from "./toml.js";
import type { Experiment, SimParams, WrittenWorld } from "../types.js";
import type { Worlds } from "./simulation.js";
import type { Toml } from "./toml.js";

/**
 * @param parts - The module is page.wasm, compiled.
 * @param base - Says what the file does not.
 */
export function openWorld(
  { module, worlds }: { module: WebAssembly.Module, worlds: Worlds },
  { name, text }: { name: string, text: string },
  base: Experiment,
): Experiment {
  if (name.endsWith(".toml")) return { ...base, world: writtenWorld(module, worlds.random, { name, text }) };
  const { seed, of, limit_ticks, robots = 1, edits, world, body } = worldIn(module, worlds, text);
  if (!(robots >= 1 && robots <= PAGE_ROBOTS_MAX)) throw new Error(`${name} is for ${robots} robots; this page has room for ${PAGE_ROBOTS_MAX}`);
  const setups = Array.from({ length: robots }, () => ({ ...base.robots[0], settings: settingsOf(body) }));
  return { ...base, seed, environments: of, limit_ticks, robots: setups, changes: edits, world: world ?? base.world, body };
}

/**
 * The world in a file.
 * @param params - Of the random world.
 */
function writtenWorld(
  module: WebAssembly.Module,
  params: SimParams,
  { name, text }: { name: string, text: string },
): WrittenWorld {
  let lines: Toml["lines"] = new Map();
  try {
    const toml = parseToml(text);
    lines = toml.lines;
    return { name, ...checkedWorld(module, params, Object.fromEntries(toml.content)) };
  } catch (error) {
    if (error instanceof LineError) throw new Error(`${name}:${error.line}: this is not TOML: ${error.message}`);
    if (!(error instanceof WrittenError)) throw error;
    const [line, entries] = lines.get(error.key) ?? [1, []];
    throw new Error(`${name}:${entries[error.entry] ?? line}: ${error.message}`);
  }
}
