/* How long robots take to find all food in many worlds, and what that says of their mean; and a picture of it. */

import { buttonOf, choiceOf, made } from "../core/dom.js";
import { heard, say } from "../core/language.js";
import { filled } from "../core/phrases.js";
import { PARAMETERS, PROFILES } from "../generated.js";
import { experimentOf } from "../lab/shown_run.js";
import { SVG, addShape } from "../panel/cells_view.js";
import type { Texts } from "../core/language.js";
import type { Simulator } from "../lab/simulator.js";

/** The seed of the first world; the others follow, so that everyone in a class sees the same worlds. */
const FIRST_SEED = 2;
const LIMIT_S = 300;
/** 95 % of a normal distribution lies within this number of standard deviations. */
const NORMAL_95 = 1.96;
const ENOUGH = 10;

/** The mean of some numbers, and the interval in which the mean of all is likely to be. */
function meanOf(numbers: number[]) {
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

const COUNTS = [1, 10, 100];
const WIDTH = 300;
const ROW = 44;
const DOT = 4;
/** The part of a row that dots may fill, above the line of its interval. */
const ROOM = 32;

/**
 * A dot for each run: how long it took, for two behaviours one above the other, with the interval of each mean. A tool of a
 * lesson.
 */
export class DotPlot {
  written = "";
  choices = this.samples.profiles.map((_, place) => this.makeChoice(place));
  plot = document.createElementNS(SVG, "svg");
  told = made("p", [], { role: "status" });
  element: HTMLDivElement;

  constructor(readonly samples: Samples, readonly words: Texts["lessons"]["words"]) {
    const more = COUNTS.map((count) => buttonOf(`${count}`, () => void samples.fill(count)));
    this.plot.setAttribute("viewBox", `-4 0 ${WIDTH + 8} ${2 * ROW}`);
    this.plot.setAttribute("aria-hidden", "true");
    const fields = made("div", this.choices, { class: "controls" });
    const buttons = made("div", [`${words.runsOfEach} `, ...more], { class: "controls counts", role: "group", "aria-label": words.runsOfEach });
    this.element = made("div", [fields, buttons, this.plot, this.told], { class: "samples" });
  }

  /** @param place - The place of the behaviour, 0 or 1. */
  makeChoice(place: number) {
    const { samples } = this;
    const names: [string, string][] = PROFILES.map((name) => [name, heard(name)]);
    const { select } = choiceOf("", names, (profile) => {
      samples.profiles[place] = profile;
      samples.clear();
    });
    select.setAttribute("aria-label", `${say("behaviour")} ${place + 1}`);
    return select;
  }

  show() {
    const { profiles, count, seconds } = this.samples;
    this.choices.forEach((select, place) => (select.value = profiles[place]));
    const key = `${profiles.join()} ${count}`;
    if (key === this.written) return;
    this.written = key;
    this.plot.replaceChildren();
    seconds.forEach((taken, row) => this.drawRow(taken, row));
    this.told.textContent = count ? seconds.map((taken, row) => this.sentence(taken, profiles[row])).join("\n") : this.words.noRuns;
  }

  sentence(taken: number[], profile: string) {
    const { mean, low, high } = meanOf(taken);
    const [m, l, h] = [mean, low, high].map((number) => Math.round(number));
    const name = heard(profile);
    return taken.length > 1 ? filled(this.words.meanOf, { name, runs: taken.length, mean: m, low: l, high: h }) : filled(this.words.oneRun, { name, mean: m });
  }

  drawRow(taken: number[], row: number) {
    const line = (row + 1) * ROW - 8;
    addShape(this.plot, "path", { d: `M0 ${line}H${WIDTH}`, class: "axis" });
    if (!taken.length) return;
    const at = (seconds: number) => (Math.min(seconds, LIMIT_S) / LIMIT_S) * WIDTH;
    const stacks: Record<number, number> = {};
    const columns = taken.map((seconds) => Math.round(at(seconds) / DOT));
    const places = columns.map((column) => ({ column, level: (stacks[column] = (stacks[column] ?? -1) + 1) }));
    const rise = Math.min(DOT, ROOM / Math.max(...Object.values(stacks).map((level) => level + 1)));
    for (const { column, level } of places) {
      addShape(this.plot, "circle", { cx: `${column * DOT}`, cy: `${line - 4 - level * rise}`, r: `${DOT / 2}`, class: `run-${row}` });
    }
    const { mean, low, high } = meanOf(taken);
    if (taken.length > 1) addShape(this.plot, "path", { d: `M${at(low)} ${line + 3}H${at(high)}`, class: `interval run-${row}` });
    addShape(this.plot, "circle", { cx: `${at(mean)}`, cy: `${line + 3}`, r: "4", class: `mean run-${row}` });
  }
}
