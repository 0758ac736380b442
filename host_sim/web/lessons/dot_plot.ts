/* A dot for each run: how long it took, for two behaviours one above the other, with the interval of each mean. */

import { buttonOf, choiceOf, made } from "../core/dom.js";
import { heard, say } from "../core/language.js";
import { filled } from "../core/phrases.js";
import { PROFILES } from "../generated.js";
import { SVG, addShape } from "../panel/cells_view.js";
import { LIMIT_S, meanOf } from "./samples.js";
import type { Texts } from "../core/language.js";
import type { Samples } from "./samples.js";

const COUNTS = [1, 10, 100];
const WIDTH = 300;
const ROW = 44;
const DOT = 4;
/** The part of a row that dots may fill, above the line of its interval. */
const ROOM = 32;

/** A tool of a lesson. */
export class DotPlot {
  written = "";
  choices: HTMLSelectElement[];
  plot: SVGSVGElement;
  told: HTMLParagraphElement;
  element: HTMLDivElement;

  constructor(readonly samples: Samples, readonly words: Texts["lessons"]["words"]) {
    this.choices = samples.profiles.map((_, place) => this.makeChoice(place));
    const more = COUNTS.map((count) => buttonOf(`${count}`, () => void samples.fill(count)));
    this.plot = document.createElementNS(SVG, "svg");
    this.plot.setAttribute("viewBox", `-4 0 ${WIDTH + 8} ${2 * ROW}`);
    this.plot.setAttribute("aria-hidden", "true");
    this.told = made("p", [], { role: "status" });
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
