/* The map of all memories: where each lies on it, and the time of a robot that has it and learns no more. */

import { CELL_COUNT, PARAMETERS } from "../generated.js";
import { RANDOM } from "../core/world_names.js";
import { experimentOf } from "./shown_run.js";
import type { Experiment } from "../types.js";
import type { Simulator } from "./simulator.js";

/** The cells that go across and down, the outermost first. Cell 0 is never read. */
const ACROSS = [1, 3, 2, 5];
const DOWN = [4, 6, 7];
const KINDS = 3; // of what a cell holds
export const WIDTH = KINDS ** ACROSS.length;
export const HEIGHT = KINDS ** DOWN.length;
/** The cells whose contents vary in a coarse map; the others stay empty. */
const COARSE = [1, 3, 4, 6];
/** The environments that are added to a coarse map at a time: the first ones of the seeds from FIRST_SEED on. */
const SEEDS = 4;
const FIRST_SEED = 2;

/**
 * The memory in a place.
 * @param x - Its column, 0..WIDTH-1.
 * @param y - Its row, 0..HEIGHT-1.
 */
export function memoryAt(x: number, y: number) {
  const memory = Array.from({ length: CELL_COUNT }, () => 0);
  const write = (cells: number[], place: number) =>
    cells.reduceRight((rest, cell) => ((memory[cell] = rest % KINDS), Math.floor(rest / KINDS)), place);
  write(ACROSS, x);
  write(DOWN, y);
  return memory;
}

/**
 * The place of a memory: column and row.
 * @param memory - The turn for each pattern.
 */
export function placeOf(memory: number[]) {
  return [ACROSS, DOWN].map((cells) => numberOf(memory, cells));
}

function numberOf(memory: number[], cells: number[]) {
  return cells.reduce((number, cell) => KINDS * number + memory[cell], 0);
}

/** The mean times of all memories, as a study has measured them. */
export class StudiedMap {
  /** @param seconds - In the order of the memories, as numbers with a digit for each cell. */
  constructor(readonly seconds: number[]) {}

  meanOf(memory: number[]) {
    return this.seconds[numberOf(memory, [1, 2, 3, 4, 5, 6, 7])];
  }

  nearest(memory: number[]) {
    return memory;
  }
}

/** A map of the memories with cells 2, 5 and 7 empty, of any world; each call of `extend` makes it better. */
export class CoarseMap {
  /** Times of each memory, added up, s. */
  sums = new Float64Array(KINDS ** COARSE.length);
  counts = new Uint16Array(this.sums.length);
  isGrowing = false;

  constructor(readonly where: { world: Experiment["world"]; body: Experiment["body"] }) {}

  /** The number of environments in which each memory was tried. */
  get environments() {
    return Math.min(...this.counts);
  }

  meanOf(memory: number[]) {
    const place = numberOf(memory, COARSE);
    return this.counts[place] ? this.sums[place] / this.counts[place] : undefined;
  }

  /** The memory on the map that is nearest to any memory. */
  nearest(memory: number[]) {
    return memory.map((side, cell) => (COARSE.includes(cell) ? side : 0));
  }

  /**
   * Adds some environments, until `isGrowing` is set to false.
   * @param onNew - Called after each run and at the end.
   */
  async extend(simulator: Simulator, onNew: () => void) {
    this.isGrowing = true;
    const end = this.environments + SEEDS;
    const memories = places().map(([x, y]) => memoryAt(x, y)).filter((memory) => memory.every((side, cell) => side === 0 || COARSE.includes(cell)));
    try {
      for (let seed = this.environments; seed < end; seed += 1) {
        for (const memory of memories) {
          const place = numberOf(memory, COARSE);
          if (!this.isGrowing) return;
          if (this.counts[place] > seed) continue;
          const experiment = this.experimentOf(memory, FIRST_SEED + seed);
          this.sums[place] += (await simulator.ask("ticks", { experiment })) * PARAMETERS.tick_ms.default / 1000;
          this.counts[place] += 1;
          onNew();
        }
      }
    } finally {
      this.isGrowing = false;
      onNew();
    }
  }

  experimentOf(memory: number[], seed: number) {
    return frozenWith(memory, experimentOf({ seed, environments: 1, robots: 1, profile: "article", ...this.where }), 0);
  }
}

/**
 * An experiment in which a robot has a memory from the start, and learns no more.
 * @param experiment - Its own changes are left out.
 * @param robot - Counted from 0.
 */
export function frozenWith(memory: number[], experiment: Experiment, robot: number): Experiment {
  const robots = experiment.robots.map((it, i) => (i === robot ? { ...it, profile: "article", program: undefined, memory } : it));
  return { ...experiment, robots, changes: [{ tick: 0, do: "freeze", robot, on: 1 }] };
}

/** Whether the study's map is of the world and the body of an experiment. */
export function isStudied({ world = RANDOM, body }: Experiment) {
  return world === RANDOM && (body === undefined || body === "ideal");
}

/** All places, column and row. */
export function places() {
  return Array.from({ length: WIDTH * HEIGHT }, (_, i) => [i % WIDTH, Math.floor(i / WIDTH)]);
}
