/* A recorded run: unpacks what host_sim/report/replay_page.py packed, and gives the state of any tick. */

import { Trail } from "./trail.js";

const VERSION = 1;
const TRAIL_TICKS = 6000;
const PER_MM = { x: 10, y: 10 };

/** A run in memory. Ticks are counted from the start of the run. */
export class RunData {
  /**
   * Unpacks a run.
   * @param {Object} run - As host_sim/report/replay_page.py describes it.
   * @returns {Promise<RunData>}
   */
  static async from(run) {
    if (run.version !== VERSION) throw new Error(`This page shows runs of version ${VERSION}, not ${run.version}.`);
    const columns = unpack(await inflate(run.data), run.columns, run.ticks);
    return new RunData(run, columns);
  }

  constructor(run, columns) {
    this.run = run;
    this.columns = columns;
    this.first = run.first_tick;
    this.last = run.first_tick + run.ticks - 1;
    this.measures = run.measures;
  }

  /** The state of a tick, as in host_sim/view/state.py. */
  stateAt(tick) {
    const state = { tick };
    for (const [name, column] of Object.entries(this.columns)) {
      state[name] = column[tick - this.first] / (PER_MM[name] ?? 1);
    }
    state.eaten = latest(this.run.eaten, tick);
    state.memory = this.memoryAt(tick);
    state.trial = latest(this.run.trials, tick) ?? null;
    state.uses = this.usesAt(tick);
    state.learned = this.learnedAt(tick);
    return state;
  }

  memoryAt(tick) {
    return latest(this.run.memory, tick);
  }

  sceneAt(tick) {
    return latest(this.run.scenes, tick);
  }

  /** How often each cell was used, up to a tick. */
  usesAt(tick) {
    const uses = new Array(8).fill(0);
    const count = countUpTo(this.run.turns, tick, ([at]) => at);
    for (let i = 0; i < count; i += 1) uses[this.run.turns[i][1]] += 1;
    return uses;
  }

  /** When each cell last changed, up to a tick; -1 if it did not. */
  learnedAt(tick) {
    const learned = new Array(8).fill(-1);
    for (const lesson of this.lessonsUpTo(tick)) learned[lesson.cell] = lesson.tick;
    return learned;
  }

  lessonsUpTo(tick) {
    return this.run.lessons.slice(0, countUpTo(this.run.lessons, tick, (lesson) => lesson.tick));
  }

  /**
   * The tick of the next event of a kind after a tick, or the one before it; undefined if there is none.
   * @param {string} kind
   * @param {number} tick
   * @param {number} step - 1 or -1.
   */
  eventFrom(kind, tick, step) {
    const ticks = this.run.events.filter(([at, what]) => what === kind && (at - tick) * step > 0).map(([at]) => at);
    return step > 0 ? ticks[0] : ticks.at(-1);
  }

  /** The trail up to a tick, in its environment. */
  trailAt(tick, trail = new Trail()) {
    const begin = this.sceneAt(tick).first_tick;
    trail.clear();
    this.addTrail(trail, Math.max(this.first, begin, tick - TRAIL_TICKS), tick);
    return trail;
  }

  /** Adds ticks to a trail, both ends included. */
  addTrail(trail, from, to) {
    const { x, y, reason } = this.columns;
    for (let tick = from; tick <= to; tick += 1) {
      const i = tick - this.first;
      trail.add(x[i] / PER_MM.x, y[i] / PER_MM.y, reason[i]);
    }
  }
}

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function unpack(bytes, names, ticks) {
  return Object.fromEntries(names.map((name, column) => [name, unpackColumn(bytes, 4 * column * ticks, ticks)]));
}

/** Planes of bytes to differences, differences to values. */
function unpackColumn(bytes, low, ticks) {
  const values = new Int32Array(ticks);
  let value = 0;
  for (let i = 0; i < ticks; i += 1) {
    const at = low + i;
    const z = bytes[at] | (bytes[at + ticks] << 8) | (bytes[at + 2 * ticks] << 16) | (bytes[at + 3 * ticks] << 24);
    value += (z >>> 1) ^ -(z & 1);
    values[i] = value;
  }
  return values;
}

/** What holds at a tick, of pairs [from which tick on, what] in their order. */
function latest(pairs, tick) {
  return pairs[countUpTo(pairs, tick, ([at]) => at) - 1]?.[1];
}

/** How many entries, in the order of their ticks, are at a tick or before. */
function countUpTo(entries, tick, tickOf) {
  let [low, high] = [0, entries.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (tickOf(entries[middle]) <= tick) low = middle + 1;
    else high = middle;
  }
  return low;
}
