// @ts-check
/* fleet.html: the robots of a fleet on the move, each in a world of its own or all in one. */

import { byId, setText, typedById } from "../core/elements.js";
import { FleetPicture } from "./fleet_picture.js";
import { unpackColumns } from "../core/packed_columns.js";
import { minutes } from "../core/phrases.js";

/** Plays what was sampled. */
class FleetPage {
  /**
   * @param {import("./fleet_picture.js").Fleet} fleet
   * @param {import("../core/packed_columns.js").Columns} columns
   */
  constructor(fleet, columns) {
    this.fleet = fleet;
    this.picture = new FleetPicture(typedById("robots", HTMLCanvasElement), fleet, columns);
    this.scrub = typedById("scrub", HTMLInputElement);
    this.scrub.max = `${this.last}`;
    this.at = 0;
    this.playing = false;
    /** @type {number | undefined} */
    this.frameAt = undefined;
    setText(byId("status"), fleet.title);
    this.scrub.addEventListener("input", () => (this.at = Number(this.scrub.value)));
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    requestAnimationFrame((now) => this.frame(now));
  }

  /** The last sample. */
  get last() {
    return this.fleet.samples - 1;
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing && this.at >= this.last) this.at = 0;
    this.playing = playing;
    this.frameAt = undefined;
    setText(byId("play"), playing ? "Pause" : "Play");
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
    if (document.activeElement !== scrub || this.playing) scrub.value = `${at}`;
    const time = minutes(at * fleet.sample_s);
    if (byId("clock").textContent === time) return;
    scrub.setAttribute("aria-valuetext", time);
    setText(byId("clock"), time);
  }
}

async function open() {
  const fleet = /** @type {import("./fleet_picture.js").Fleet} */ (JSON.parse(byId("fleet").textContent ?? ""));
  const columns = await unpackColumns(fleet.data, fleet.columns, fleet.samples);
  Object.assign(window, { octet: new FleetPage(fleet, columns) });
}

open().catch((error) => setText(byId("status"), error instanceof Error ? error.message : `${error}`));
