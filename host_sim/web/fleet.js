// @ts-check
/* fleet.html: the robots of a fleet on the move, each in a world of its own or all in one. */

import { byId, contextOf, setText, typedById } from "./elements.js";
import { unpackColumns } from "./packed_columns.js";
import { paletteOf } from "./palette.js";
import { minutes } from "./phrases.js";

/**
 * What host_sim/report/fleet_page.py has written.
 * @typedef {Object} Fleet
 * @property {string} title
 * @property {number} robots
 * @property {boolean} own
 * @property {number} width
 * @property {number} height
 * @property {number} body
 * @property {number} bar
 * @property {number} sample_s
 * @property {number} samples
 * @property {number[][]} bars
 * @property {number[][]} food
 * @property {string[]} columns
 * @property {string} data
 */

const GAP_MM = 80;
const FOOD_MM = 50;
/** A robot that is farther away in the next sample was carried into another environment. */
const JUMP_MM = 600;
/** Robots of their own small worlds are drawn larger than they are. */
const OWN_SCALE = 3;
/** From this radius on one can see that a robot is round, and where it looks. */
const ROUND_PX = 3;

/** Plays what was sampled; between two samples, robots go straight ahead. */
class FleetPage {
  /**
   * @param {Fleet} fleet
   * @param {import("./packed_columns.js").Columns} columns
   */
  constructor(fleet, columns) {
    this.fleet = fleet;
    this.tracks = Array.from({ length: fleet.robots }, (_, i) => [columns[`x${i}`], columns[`y${i}`], columns[`heading${i}`]]);
    this.canvas = typedById("robots", HTMLCanvasElement);
    this.context = contextOf(this.canvas, { alpha: false });
    this.palette = paletteOf(this.canvas);
    this.background = document.createElement("canvas");
    /**
     * The colours of the background.
     * @type {import("./palette.js").Palette | undefined}
     */
    this.drawn = undefined;
    this.scrub = typedById("scrub", HTMLInputElement);
    this.scrub.max = `${fleet.samples - 1}`;
    this.at = 0;
    this.playing = false;
    /** @type {number | undefined} */
    this.frameAt = undefined;
    setText(byId("status"), fleet.title);
    this.bind();
    requestAnimationFrame((now) => this.frame(now));
  }

  bind() {
    this.scrub.addEventListener("input", () => (this.at = Number(this.scrub.value)));
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    const look = () => {
      this.palette = paletteOf(this.canvas);
    };
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", look);
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
    const columns = this.fit();
    this.drawBackground(columns);
    this.drawRobots(columns);
    if (document.activeElement !== scrub || this.playing) scrub.value = `${at}`;
    const time = minutes(at * fleet.sample_s);
    scrub.setAttribute("aria-valuetext", time);
    setText(byId("clock"), time);
  }

  /** Gives the canvas a pixel for each of the screen's, and mm as its unit. Returns how many worlds a row has. */
  fit() {
    const { canvas, fleet, context } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((px) => Math.max(1, Math.round(px * devicePixelRatio)));
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const worlds = fleet.own ? fleet.robots : 1;
    const [across, down] = [fleet.width + GAP_MM, fleet.height + GAP_MM];
    const columns = fleet.own ? Math.max(1, Math.ceil(Math.sqrt((worlds * down * width) / (across * height)))) : 1;
    const scale = Math.min(width / (columns * across), height / (Math.ceil(worlds / columns) * down));
    context.setTransform(scale, 0, 0, scale, (GAP_MM / 2) * scale, (GAP_MM / 2) * scale);
    return columns;
  }

  /**
   * Draws what does not move, from a picture of it.
   * @param {number} columns
   */
  drawBackground(columns) {
    const { context, background, palette } = this;
    const { width, height } = this.canvas;
    if (background.width !== width || background.height !== height || this.drawn !== palette) {
      [background.width, background.height] = [width, height];
      this.drawn = palette;
      const layer = contextOf(background, { alpha: false });
      layer.setTransform(context.getTransform());
      this.drawWorlds(columns, layer);
    }
    context.save();
    context.resetTransform();
    context.drawImage(background, 0, 0);
    context.restore();
  }

  /**
   * @param {number} columns
   * @param {CanvasRenderingContext2D} context
   */
  drawWorlds(columns, context) {
    const { fleet, palette } = this;
    context.fillStyle = palette.of.paper;
    context.fillRect(-GAP_MM, -GAP_MM, 1e6, 1e6);
    context.fillStyle = palette.of[fleet.own ? "grid" : "floor"];
    for (let world = 0; world < (fleet.own ? fleet.robots : 1); world += 1) {
      const [x, y] = this.cornerOf(world, columns);
      context.fillRect(x, y, fleet.width, fleet.height);
    }
    context.fillStyle = palette.of.food;
    discs(context, fleet.food, FOOD_MM);
    context.strokeStyle = palette.of.bar;
    context.lineWidth = fleet.bar;
    context.lineCap = "round";
    lines(context, fleet.bars);
  }

  /** @param {number} columns */
  drawRobots(columns) {
    const { context, fleet, palette } = this;
    const radius = fleet.body * (fleet.own ? OWN_SCALE : 1);
    const poses = this.tracks.map((track, robot) => this.poseOf(track, this.cornerOf(fleet.own ? robot : 0, columns)));
    context.fillStyle = palette.reasons[1];
    if (radius * context.getTransform().a < ROUND_PX) {
      squares(context, poses, radius);
      return;
    }
    discs(context, poses, radius);
    context.strokeStyle = palette.of.ink;
    context.lineWidth = radius / 3;
    lines(context, poses.map(([x, y, heading]) => [x, y, x + radius * Math.cos(heading), y + radius * Math.sin(heading)]));
  }

  /**
   * @param {number} world
   * @param {number} columns
   */
  cornerOf(world, columns) {
    const { width, height } = this.fleet;
    return [(world % columns) * (width + GAP_MM), Math.floor(world / columns) * (height + GAP_MM)];
  }

  /**
   * @param {Int32Array[]} track
   * @param {number[]} corner
   */
  poseOf([x, y, heading], [left, top]) {
    const before = Math.floor(this.at);
    const after = Math.min(this.last, before + 1);
    const [dx, dy] = [x[after] - x[before], y[after] - y[before]];
    const part = Math.hypot(dx, dy) > JUMP_MM ? 0 : this.at - before;
    return [left + x[before] + part * dx, top + y[before] + part * dy, heading[before] / 1000];
  }
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number[][]} places
 * @param {number} radius
 */
function discs(context, places, radius) {
  context.beginPath();
  for (const [x, y] of places) {
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  }
  context.fill();
}

/**
 * What takes the place of discs too small to tell from squares, and is drawn sooner.
 * @param {CanvasRenderingContext2D} context
 * @param {number[][]} places
 * @param {number} radius
 */
function squares(context, places, radius) {
  context.beginPath();
  for (const [x, y] of places) context.rect(x - radius, y - radius, 2 * radius, 2 * radius);
  context.fill();
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number[][]} ends
 */
function lines(context, ends) {
  context.beginPath();
  for (const [ax, ay, bx, by] of ends) {
    context.moveTo(ax, ay);
    context.lineTo(bx, by);
  }
  context.stroke();
}

async function open() {
  const fleet = /** @type {Fleet} */ (JSON.parse(byId("fleet").textContent ?? ""));
  const columns = await unpackColumns(fleet.data, fleet.columns, fleet.samples);
  Object.assign(window, { octet: new FleetPage(fleet, columns) });
}

open().catch((error) => setText(byId("status"), error instanceof Error ? error.message : `${error}`));
