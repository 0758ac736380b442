// @ts-check
/* Draws the robots of a fleet from above: side by side in small worlds of their own, or all in one. */

import { contextOf } from "../core/elements.js";
import { paletteOf } from "../core/palette.js";
import { PATTERNS } from "../generated.js";

const GAP_MM = 120;
const FOOD_MM = 50;
/** Below this scale, robots, food and obstacles are drawn enlarged. */
const SMALL_PX_PER_MM = 0.08;
const ENLARGED = 2.2;
/** A robot of a smaller radius is drawn as a square, without its heading. */
const ROUND_PX = 3;

/** Draws some worlds with all that is in them, if anything differs from what is there. */
export class FleetPicture {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import("./fleet_data.js").FleetData} data
   */
  constructor(canvas, data) {
    this.canvas = canvas;
    this.data = data;
    this.context = contextOf(canvas, { alpha: false });
    this.palette = paletteOf(canvas);
    /** The worlds that it shows, and the robot that is marked. */
    this.worlds = Array.from({ length: data.worlds }, (_, world) => world);
    this.marked = -1;
    /** Worlds in a row, and pixels per mm. */
    this.columns = this.scale = 1;
    this.margin = { x: 0, y: 0 };
    this.isNew = true;
    /** The time that is drawn. */
    this.at = NaN;
    /** What stays from frame to frame: the worlds, each in this state, and how much each robot knows, all at this sample. */
    this.ground = contextOf(document.createElement("canvas"), { alpha: false });
    /** @type {string[]} */
    this.shown = [];
    /** @type {number[]} */
    this.levels = [];
    this.sample = NaN;
    new ResizeObserver(() => (this.isNew = true)).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => (this.isNew = true));
  }

  /**
   * @param {number[]} worlds
   * @param {number} marked - A robot, or -1.
   */
  choose(worlds, marked) {
    this.worlds = worlds;
    this.marked = marked;
    this.isNew = true;
  }

  /** @param {number} at - Number of a sample. */
  draw(at) {
    if (at === this.at && !this.isNew) return;
    if (this.isNew) this.fit();
    this.isNew = false;
    this.at = at;
    const { context, margin, scale } = this;
    context.setTransform(scale, 0, 0, scale, margin.x + (GAP_MM / 2) * scale, margin.y + (GAP_MM / 2) * scale);
    this.drawWorlds(at);
    this.drawRobots(at);
  }

  /** Gives the canvas a pixel for each of the screen's, and all worlds room on it. */
  fit() {
    const { canvas, worlds, data: { fleet } } = this;
    this.palette = paletteOf(canvas);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((px) => Math.max(1, Math.round(px * devicePixelRatio)));
    for (const each of [canvas, this.ground.canvas]) [each.width, each.height] = [width, height];
    this.ground.fillStyle = this.palette.of.paper;
    this.ground.fillRect(0, 0, width, height);
    this.shown = [];
    this.sample = NaN;
    const [across, down] = [fleet.width + GAP_MM, fleet.height + GAP_MM];
    const fits = (/** @type {number} */ columns) => Math.min(width / (columns * across), height / (Math.ceil(worlds.length / columns) * down));
    const all = worlds.map((_, i) => i + 1);
    this.columns = all.reduce((best, columns) => (fits(columns) > fits(best) ? columns : best), 1);
    this.scale = fits(this.columns);
    this.margin = {
      x: (width - this.columns * across * this.scale) / 2,
      y: (height - Math.ceil(worlds.length / this.columns) * down * this.scale) / 2,
    };
  }

  /** How much larger than it is everything is drawn. */
  get enlarged() {
    return this.scale / devicePixelRatio < SMALL_PX_PER_MM ? ENLARGED : 1;
  }

  /**
   * Draws what has changed in the worlds since the last sample on the ground, and copies that.
   * @param {number} at
   */
  drawWorlds(at) {
    const { context, data, ground, worlds } = this;
    if (this.sample !== Math.floor(at)) {
      this.sample = Math.floor(at);
      this.levels = data.levelsAt(at);
      ground.setTransform(context.getTransform());
      worlds.forEach((world, place) => {
        const scene = data.sceneAt(world, at);
        const eaten = scene.food.map((_, piece) => data.isEaten(world, piece, at));
        const state = `${scene.first} ${eaten}`;
        if (this.shown[place] !== state) this.drawWorld(place, scene, eaten);
        this.shown[place] = state;
      });
    }
    context.save();
    context.resetTransform();
    context.drawImage(ground.canvas, 0, 0);
    context.restore();
  }

  /**
   * @param {number} place - Number of the world in the picture.
   * @param {import("./fleet_data.js").FleetScene} scene
   * @param {boolean[]} eaten - Of each piece of food.
   */
  drawWorld(place, scene, eaten) {
    const { ground, palette, data: { fleet: { width, height, bar } } } = this;
    const [x, y] = this.cornerOf(place);
    const rectangle = (/** @type {string} */ colour, /** @type {number} */ edge) => {
      ground.fillStyle = colour;
      ground.fillRect(x - edge, y - edge, width + 2 * edge, height + 2 * edge);
    };
    const isFinished = eaten.every(Boolean);
    rectangle(palette.of.paper, GAP_MM / 2);
    rectangle(palette.of[isFinished ? "food" : "bar"], isFinished ? GAP_MM / 2.5 : GAP_MM / 6);
    rectangle(palette.of.floor, 0);
    ground.strokeStyle = palette.of.bar;
    ground.lineWidth = bar * Math.sqrt(this.enlarged);
    ground.lineCap = "round";
    lines(ground, scene.bars.map(([ax, ay, bx, by]) => [x + ax, y + ay, x + bx, y + by]));
    const food = scene.food.map(([fx, fy]) => [x + fx, y + fy]);
    const radius = FOOD_MM * this.enlarged;
    ground.fillStyle = ground.strokeStyle = palette.of.food;
    discs(ground, food.filter((_, piece) => !eaten[piece]), radius, () => ground.fill());
    ground.lineWidth = radius / 4;
    discs(ground, food.filter((_, piece) => eaten[piece]), radius, () => ground.stroke());
  }

  /** @param {number} at */
  drawRobots(at) {
    const { context, palette, data } = this;
    const radius = data.fleet.body * this.enlarged;
    const { levels } = this;
    const robots = this.placesOf(at);
    const isRound = radius * this.scale >= ROUND_PX;
    const marks = isRound ? discs : squares;
    context.fillStyle = palette.of.ink;
    marks(context, robots.map(({ place }) => place), radius * 1.2, () => context.fill());
    for (let level = 0; level < PATTERNS.length; level += 1) {
      const places = robots.filter(({ robot }) => levels[robot] === level).map(({ place }) => place);
      context.fillStyle = palette.of.paper;
      marks(context, places, radius, () => context.fill());
      context.globalAlpha = level / (PATTERNS.length - 1);
      context.fillStyle = palette.of.level;
      marks(context, places, radius, () => context.fill());
      context.globalAlpha = 1;
    }
    context.strokeStyle = palette.of.ink;
    context.lineWidth = radius / 3;
    if (isRound) lines(context, robots.map(({ place: [x, y, heading] }) => [x, y, x + radius * Math.cos(heading), y + radius * Math.sin(heading)]));
    context.strokeStyle = palette.of.select;
    context.lineWidth = Math.max(radius / 2, 2 / this.scale);
    discs(context, robots.filter(({ robot }) => robot === this.marked).map(({ place }) => place), 2 * radius, () => context.stroke());
  }

  /**
   * The robots in the worlds that are shown, and where each is in the picture.
   * @param {number} at
   */
  placesOf(at) {
    const { data, worlds } = this;
    const robots = data.fleet.own ? worlds : Array.from({ length: data.fleet.robots }, (_, robot) => robot);
    return robots.map((robot, i) => {
      const [left, top] = this.cornerOf(data.fleet.own ? i : 0);
      const [x, y, heading] = data.poseOf(robot, at);
      return { robot, place: [left + x, top + y, heading] };
    });
  }

  /**
   * The robot whose world is at a place of the page or, where all share one, the nearest.
   * @param {{offsetX: number, offsetY: number}} where
   */
  robotAt({ offsetX, offsetY }) {
    const { data: { fleet }, scale, columns, margin } = this;
    const [x, y] = [offsetX * devicePixelRatio - margin.x, offsetY * devicePixelRatio - margin.y].map((px) => px / scale);
    if (fleet.own) {
      const [column, row] = [Math.floor(x / (fleet.width + GAP_MM)), Math.floor(y / (fleet.height + GAP_MM))];
      return column >= 0 && column < columns ? this.worlds[row * columns + column] : undefined;
    }
    const [px, py] = [x - GAP_MM / 2, y - GAP_MM / 2];
    const distance = (/** @type {number[]} */ [rx, ry]) => Math.hypot(rx - px, ry - py);
    return this.placesOf(this.at).sort((a, b) => distance(a.place) - distance(b.place))[0].robot;
  }

  /** @param {number} place - Number of a world in the picture. */
  cornerOf(place) {
    const { width, height } = this.data.fleet;
    return [(place % this.columns) * (width + GAP_MM), Math.floor(place / this.columns) * (height + GAP_MM)];
  }
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number[][]} places
 * @param {number} radius
 * @param {() => void} paint
 */
function discs(context, places, radius, paint) {
  context.beginPath();
  for (const [x, y] of places) {
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  }
  paint();
}

/**
 * What takes the place of discs too small to tell from squares, and is drawn sooner.
 * @param {CanvasRenderingContext2D} context
 * @param {number[][]} places
 * @param {number} radius
 * @param {() => void} paint
 */
function squares(context, places, radius, paint) {
  context.beginPath();
  for (const [x, y] of places) context.rect(x - radius, y - radius, 2 * radius, 2 * radius);
  paint();
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
