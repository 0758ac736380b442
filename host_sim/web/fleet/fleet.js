// @ts-check
/* fleet.html: shows the robots of a fleet moving, what they have learned, and one of them in detail. */

import { made } from "../core/building.js";
import { byId, setText, typedById } from "../core/elements.js";
import { fleetData } from "./fleet_data.js";
import { FleetPicture } from "./fleet_picture.js";
import { heard, inEachLanguage, robotWords, say } from "../core/language.js";
import { minutes } from "../core/phrases.js";
import { drawChart } from "../draw/chart.js";
import { PATTERNS, SIDES } from "../generated.js";
import { pictureOf } from "../panel/cells_view.js";

const ALL = PATTERNS.length - 1;
const ARROWS = ["·", "↰", "↱"];
const SEED_SPAN = 2 ** 32;

/** Plays the samples. */
class FleetPage {
  /** @param {import("./fleet_data.js").FleetData} data */
  constructor(data) {
    this.data = data;
    this.fleet = data.fleet;
    this.picture = new FleetPicture(typedById("robots", HTMLCanvasElement), data);
    this.one = new FleetPicture(typedById("one", HTMLCanvasElement), data);
    this.chart = typedById("chart", HTMLCanvasElement);
    this.scrub = typedById("scrub", HTMLInputElement);
    this.scrub.max = `${this.last}`;
    this.bars = PATTERNS.map((_, level) => barFor(level));
    this.at = 0;
    this.opened = -1;
    this.playing = false;
    /** @type {number | undefined} */
    this.frameAt = undefined;
    this.shown = "";
    inEachLanguage(() => this.write());
    byId("frame-legend").hidden = !this.fleet.own;
    typedById("open", HTMLInputElement).max = `${this.fleet.robots}`;
    this.bind();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Writes what depends on the language. */
  write() {
    const { robots, profile, seed } = this.fleet;
    setText(byId("status"), say("fleetTitle", { robots, profile: heard(profile), seed }));
    setText(byId("play"), say(this.playing ? "pause" : "play"));
    setText(byId("opened-name"), say("robotNumber", { node: this.opened + 1 }));
    this.shown = "";
  }

  bind() {
    this.scrub.addEventListener("input", () => (this.at = Number(this.scrub.value)));
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    byId("close").addEventListener("click", () => this.open(-1));
    this.picture.canvas.addEventListener("click", (event) => this.open(this.picture.robotAt(event) ?? -1));
    byId("open-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.open(Number(typedById("open", HTMLInputElement).value) - 1);
    });
  }

  /** The last sample. */
  get last() {
    return this.fleet.samples - 1;
  }

  /** @param {number} robot - Counted from 0; -1 closes the one that is open. */
  open(robot) {
    const { fleet } = this;
    this.opened = robot;
    byId("opened").hidden = robot < 0;
    document.body.classList.toggle("is-open", robot >= 0);
    this.picture.choose(this.picture.worlds, robot);
    if (robot < 0) return;
    this.one.choose([fleet.own ? robot : 0], -1);
    this.one.canvas.hidden = !fleet.own;
    const seed = (fleet.seed + robot) % SEED_SPAN;
    setText(byId("opened-run"), `tools/run --seed ${seed} ${fleet.alone}`);
    byId("opened-run").parentElement?.toggleAttribute("hidden", !fleet.own);
    this.write();
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing && this.at >= this.last) this.at = 0;
    this.playing = playing;
    this.frameAt = undefined;
    this.write();
  }

  /** @param {number} now */
  frame(now) {
    if (this.playing) this.advance(now);
    this.draw();
    requestAnimationFrame((next) => this.frame(next));
  }

  /** @param {number} now */
  advance(now) {
    const speed = Number(typedById("speed", HTMLSelectElement).value);
    this.at = Math.min(this.last, this.at + ((now - (this.frameAt ?? now)) / 1000 / this.fleet.sample_s) * speed);
    this.frameAt = now;
    if (this.at >= this.last) this.setPlaying(false);
  }

  draw() {
    const { fleet, at, scrub } = this;
    this.picture.draw(at);
    if (this.opened >= 0) this.one.draw(at);
    if (document.activeElement !== scrub || this.playing) scrub.value = `${at}`;
    const time = minutes(at * fleet.sample_s, robotWords().point);
    if (byId("clock").textContent !== time) {
      scrub.setAttribute("aria-valuetext", time);
      setText(byId("clock"), time);
    }
    this.show();
  }

  /** The numbers and curves: they change from sample to sample. */
  show() {
    const { at, data, chart, opened } = this;
    const sample = Math.floor(at);
    const key = [sample, opened, chart.clientWidth, chart.clientHeight, matchMedia("(prefers-color-scheme: dark)").matches].join();
    if (key === this.shown) return;
    this.shown = key;
    const levels = data.levelsAt(sample);
    const { eaten, finished } = data.countsAt(sample);
    setText(byId("fact-finished"), say("ofCount", { count: finished, all: this.fleet.environments * data.worlds }));
    setText(byId("fact-eaten"), `${eaten}`);
    setText(byId("fact-learned"), say("ofCount", { count: levels.filter((level) => level === ALL).length, all: this.fleet.robots }));
    const counts = this.bars.map((_, level) => levels.filter((other) => other === level).length);
    counts.forEach((count, level) => {
      setText(this.bars[level].count, `${count}`);
      this.bars[level].bar.style.setProperty("--share", `${count / Math.max(...counts) * 0.75}`);
    });
    this.drawCurves(sample);
    if (opened >= 0) byId("opened-cells").replaceChildren(...cellsOf(data.sidesAt(opened, sample)));
  }

  /** @param {number} sample */
  drawCurves(sample) {
    const { data, last, fleet } = this;
    const { robots } = this.picture.palette;
    const ticks = Array.from({ length: fleet.samples }, (_, i) => i);
    const lines = [
      { name: say("known"), counts: data.known, colour: robots[0] },
      { name: say("eaten"), counts: data.meals, colour: robots[2] },
    ].map((line) => ({ ...line, ticks, dash: [], end: sample }));
    const most = Math.ceil(Math.max(1, ...data.known, ...data.meals));
    drawChart(this.chart, lines, { last, most, time: minutes(last * fleet.sample_s, robotWords().point) });
  }
}

/** @param {number} level - Of the patterns known. */
function barFor(level) {
  const [count, bar] = [made("b", []), made("i", [])];
  byId("histogram").append(made("li", [count, bar, made("span", [`${level}`])]));
  return { count, bar };
}

/** @param {number[]} sides */
function cellsOf(sides) {
  return sides.slice(1).map((side, i) =>
    made("li", [pictureOf(i + 1), ARROWS[side]], { "data-side": SIDES[side], title: `${robotWords().patterns[i + 1]}: ${robotWords().sides[side]}` }));
}

async function open() {
  const fleet = /** @type {import("./fleet_data.js").Fleet} */ (JSON.parse(byId("fleet").textContent ?? ""));
  Object.assign(window, { octet: new FleetPage(await fleetData(fleet)) });
}

open().catch((error) => setText(byId("status"), error instanceof Error ? error.message : `${error}`));
