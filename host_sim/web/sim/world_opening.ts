/* Makes an experiment from a world file: a person's own world, or that of a run with its changes.

   Of TOML it reads what world files use: keys with numbers, and lists of lists of numbers. Errors name the line. */

import { PAGE_ROBOTS_MAX } from "../generated.js";
import { settingsOf } from "./arena.js";
import { worldIn } from "./log_opening.js";
import { WrittenError, checkedWorld } from "./native_layouts.js";
import type { Experiment, SimParams, WrittenWorld } from "../types.js";
import type { Worlds } from "./simulation.js";

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
function writtenWorld(module: WebAssembly.Module, params: SimParams, { name, text }: { name: string, text: string }): WrittenWorld {
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

type Value = number | unknown[];

/** The keys and their values, and in which line each stands: the key, and each entry of its list. */
type Toml = { content: Map<string, Value>; lines: Map<string, [number, number[]]> };

const TOKEN = /([A-Za-z_][\w-]*)|([-+]?\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][-+]?\d+)?)|([[\],=])|(\s+|#[^\n]*)|(.)/gy;

/** A line cannot be read. */
class LineError extends Error {
  constructor(readonly line: number, what: string) {
    super(what);
  }
}

function parseToml(text: string): Toml {
  const reader = new Reader(text);
  const toml: Toml = { content: new Map(), lines: new Map() };
  while (reader.token) {
    const { line } = reader;
    const key = reader.key();
    if (toml.content.has(key)) throw new LineError(line, `there is a second '${key}'`);
    toml.content.set(key, reader.value(0));
    toml.lines.set(key, [line, reader.entries.splice(0)]);
  }
  return toml;
}

/** Goes through a text, word by word. `entries` are the lines of the entries of the list that was read last. */
class Reader {
  words = this.text.matchAll(TOKEN);
  nextLine = 1;
  line = 1;
  entries: number[] = [];
  token = this.next();

  constructor(readonly text: string) {}

  /** The next word that is not a space. */
  next() {
    for (const [word, name, number, , space] of this.words) {
      this.line = this.nextLine;
      this.nextLine += word.split("\n").length - 1;
      if (space === undefined) return { word, name, number };
    }
    return undefined;
  }

  take(wanted: string) {
    if (this.token?.word !== wanted) throw this.error(`'${wanted}'`);
    this.token = this.next();
  }

  /** A key, and what follows it. */
  key() {
    const name = this.token?.name;
    if (name === undefined) throw this.error("a key");
    this.token = this.next();
    this.take("=");
    return name;
  }

  /** @param depth - In how many lists it stands. */
  value(depth: number): Value {
    if (depth === 1) this.entries.push(this.line);
    const { word = "", number } = this.token ?? {};
    if (number === undefined && word !== "[") throw this.error("a number or a list of numbers");
    this.token = this.next();
    return number === undefined ? this.list(depth + 1) : Number(number.replaceAll("_", ""));
  }

  list(depth: number) {
    const values = [];
    while (this.token?.word !== "]") {
      values.push(this.value(depth));
      if (this.token?.word !== "]") this.take(",");
    }
    this.take("]");
    return values;
  }

  error(wanted: string) {
    const found = this.token ? `'${this.token.word}'` : "the end";
    return new LineError(this.line, `expected ${wanted}, found ${found}`);
  }
}
