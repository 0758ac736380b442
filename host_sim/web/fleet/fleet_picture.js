// @ts-check
/* Draws the robots of a fleet from above: side by side in small worlds of their own, or all in one. */

import { contextOf } from "../core/elements.js";
import { paletteOf } from "../core/palette.js";

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

/** Draws only what differs from what is there. */
export class FleetPicture {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Fleet} fleet
   * @param {import("../core/packed_columns.js").Columns} columns
   */
  constructor(canvas, fleet, columns) {
    this.canvas = canvas;
    this.fleet = fleet;
    this.tracks = Array.from({ length: fleet.robots }, (_, i) => [columns[`x${i}`], columns[`y${i}`], columns[`heading${i}`]]);
    this.context = contextOf(canvas, { alpha: false });
    this.background = document.createElement("canvas");
    this.palette = paletteOf(canvas);
    /** Worlds in a row, and pixels per mm. */
    this.columns = this.scale = 1;
    this.isNew = true;
    /** The time that is drawn. */
    this.at = NaN;
    new ResizeObserver(() => (this.isNew = true)).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => (this.isNew = true));
  }

  /** @param {number} at - Number of a sample; between two, robots go straight ahead. */
  draw(at) {
    if (at === this.at && !this.isNew) return;
    if (this.isNew) this.begin();
    this.isNew = false;
    this.at = at;
    this.context.resetTransform();
    this.context.drawImage(this.background, 0, 0);
    this.useMm(this.context);
    this.drawRobots(at);
  }

  /** The canvas has another size, or the page other colours: draws what does not move anew. */
  begin() {
    this.palette = paletteOf(this.canvas);
    this.fit();
    [this.background.width, this.background.height] = [this.canvas.width, this.canvas.height];
    const layer = contextOf(this.background, { alpha: false });
    this.useMm(layer);
    this.drawWorlds(layer);
  }

  /** Gives the canvas a pixel for each of the screen's, and all worlds room on it. */
  fit() {
    const { canvas, fleet } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((px) => Math.max(1, Math.round(px * devicePixelRatio)));
    [canvas.width, canvas.height] = [width, height];
    const worlds = fleet.own ? fleet.robots : 1;
    const [across, down] = [fleet.width + GAP_MM, fleet.height + GAP_MM];
    this.columns = fleet.own ? Math.max(1, Math.ceil(Math.sqrt((worlds * down * width) / (across * height)))) : 1;
    this.scale = Math.min(width / (this.columns * across), height / (Math.ceil(worlds / this.columns) * down));
  }

  /** @param {CanvasRenderingContext2D} context */
  useMm(context) {
    const { scale } = this;
    context.setTransform(scale, 0, 0, scale, (GAP_MM / 2) * scale, (GAP_MM / 2) * scale);
  }

  /** @param {CanvasRenderingContext2D} context */
  drawWorlds(context) {
    const { fleet, palette } = this;
    context.fillStyle = palette.of.paper;
    context.fillRect(-GAP_MM, -GAP_MM, 1e6, 1e6);
    context.fillStyle = palette.of[fleet.own ? "grid" : "floor"];
    for (let world = 0; world < (fleet.own ? fleet.robots : 1); world += 1) {
      const [x, y] = this.cornerOf(world);
      context.fillRect(x, y, fleet.width, fleet.height);
    }
    context.fillStyle = palette.of.food;
    discs(context, fleet.food, FOOD_MM);
    context.strokeStyle = palette.of.bar;
    context.lineWidth = fleet.bar;
    context.lineCap = "round";
    lines(context, fleet.bars);
  }

  /** @param {number} at */
  drawRobots(at) {
    const { context, fleet, palette } = this;
    const radius = fleet.body * (fleet.own ? OWN_SCALE : 1);
    const poses = this.tracks.map((_, robot) => this.placeOf(robot, at));
    context.fillStyle = palette.reasons[1];
    if (radius * this.scale < ROUND_PX) {
      squares(context, poses, radius);
      return;
    }
    discs(context, poses, radius);
    context.strokeStyle = palette.of.ink;
    context.lineWidth = radius / 3;
    lines(context, poses.map(([x, y, heading]) => [x, y, x + radius * Math.cos(heading), y + radius * Math.sin(heading)]));
  }

  /**
   * Where a robot is in the picture.
   * @param {number} robot
   * @param {number} at
   */
  placeOf(robot, at) {
    const [left, top] = this.cornerOf(this.fleet.own ? robot : 0);
    const [x, y, heading] = this.poseOf(robot, at);
    return [left + x, top + y, heading];
  }

  /** @param {number} world */
  cornerOf(world) {
    const { width, height } = this.fleet;
    return [(world % this.columns) * (width + GAP_MM), Math.floor(world / this.columns) * (height + GAP_MM)];
  }

  /**
   * Where a robot is in its world.
   * @param {number} robot
   * @param {number} at
   */
  poseOf(robot, at) {
    const [x, y, heading] = this.tracks[robot];
    const before = Math.floor(at);
    const after = Math.min(this.fleet.samples - 1, before + 1);
    const [dx, dy] = [x[after] - x[before], y[after] - y[before]];
    const part = Math.hypot(dx, dy) > JUMP_MM ? 0 : at - before;
    return [x[before] + part * dx, y[before] + part * dy, heading[before] / 1000];
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
 * What takes the place of discs too small to tell from squares, and is drawn sooner: most of all one by one.
 * @param {CanvasRenderingContext2D} context
 * @param {number[][]} places
 * @param {number} radius
 */
function squares(context, places, radius) {
  for (const [x, y] of places) context.fillRect(x - radius, y - radius, 2 * radius, 2 * radius);
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
