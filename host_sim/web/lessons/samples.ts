/* How long robots take to find all food in many worlds, and what that says of their mean. */

import { PARAMETERS } from "../generated.js";
import { experimentOf } from "../lab/shown_run.js";
import type { Simulator } from "../lab/simulator.js";

/** The seed of the first world; the others follow, so that everyone in a class sees the same worlds. */
const FIRST_SEED = 2;
export const LIMIT_S = 300;
/** 95 % of a normal distribution lies within this number of standard deviations. */
const NORMAL_95 = 1.96;
const ENOUGH = 10;

/** The mean of some numbers, and the interval in which the mean of all is likely to be. */
export function meanOf(numbers: number[]) {
  const mean = numbers.reduce((sum, number) => sum + number, 0) / numbers.length;
  const squares = numbers.reduce((sum, number) => sum + (number - mean) ** 2, 0);
  const half = numbers.length > 1 ? NORMAL_95 * Math.sqrt(squares / (numbers.length - 1) / numbers.length) : Infinity;
  return { mean, low: Math.max(0, mean - half), high: mean + half };
}

/** Two behaviours, and the seconds that each has taken in as many worlds. */
export class Samples {
  profiles = ["article", "searcher"];
  seconds: number[][] = [[], []];
  wanted = 0;
  /** The pairs of behaviours of which ten runs were made. */
  tried = new Set();
  wereTogether = false;
  wereApart = false;
  asked = 0;

  /** @param onNew - Called when there is another run. */
  constructor(readonly simulator: Simulator, readonly onNew: () => void) {}

  /** How many worlds both have been in. */
  get count() {
    return this.seconds[1].length;
  }

  /** Forgets everything but the two behaviours. */
  clear() {
    this.seconds = [[], []];
    this.wanted = 0;
    this.asked += 1;
    this.onNew();
  }

  forget() {
    Object.assign(this, { profiles: ["article", "searcher"], tried: new Set(), wereTogether: false, wereApart: false });
    this.clear();
  }

  /** @param count - The number of runs to reach. */
  async fill(count: number) {
    const isRunning = this.count < this.wanted;
    this.wanted = Math.max(this.wanted, count);
    if (isRunning) return;
    const { asked } = this;
    while (this.count < this.wanted) {
      const seed = FIRST_SEED + this.count;
      const taken = await Promise.all(this.profiles.map((profile) => this.secondsOf(profile, seed)));
      if (asked !== this.asked) return;
      taken.forEach((seconds, place) => this.seconds[place].push(seconds));
      this.judge();
      this.onNew();
    }
  }

  async secondsOf(profile: string, seed: number) {
    const tickS = PARAMETERS.tick_ms.default / 1000;
    const experiment = { ...experimentOf({ seed, environments: 1, robots: 1, profile }), limit_ticks: LIMIT_S / tickS };
    return (await this.simulator.ask("ticks", { experiment })) * tickS;
  }

  /** Notes whether the intervals have ever overlapped, or been apart. */
  judge() {
    if (this.count < ENOUGH) return;
    this.tried.add(this.profiles.join());
    const [one, other] = this.seconds.map(meanOf);
    const overlap = one.low <= other.high && other.low <= one.high;
    if (overlap) this.wereTogether = true;
    else if (this.count >= ENOUGH * ENOUGH) this.wereApart = true;
  }
}
