/* Draws a trail: ways as lines, turns as dots, coloured by reason, the older the fainter. */

import { CAPACITY, WAYS } from "./trail.js";

const AGES = 6;
const FAINTEST = 0.16;
const TAIL_POINTS = 24;
const REDRAW_MS = 100;
const JUMP_MM = 150;
const WIDTH_MM = [30, 14, 20, 30, 36, 60, 60, 44];
/** Drawing order: what matters more lies on top. */
const ORDER = [3, 0, 1, 2, 4, 6, 5, 7];

/** Keeps a picture of the trail, so that most frames draw its newest points only. */
export class TrailLayer {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.context = this.canvas.getContext("2d");
    this.drawn = { at: 0, added: 0 };
  }

  /**
   * @param {CanvasRenderingContext2D} context - In mm.
   * @param {import("./trail.js").Trail} trail
   * @param {string[]} colours - By reason.
   */
  draw(context, trail, colours) {
    if (this.isStale(context.canvas, trail, colours)) this.redraw(context, trail, colours);
    context.save();
    context.resetTransform();
    context.drawImage(this.canvas, 0, 0);
    context.restore();
    drawPoints(context, trail, trail.length - (trail.added - this.drawn.added), colours);
  }

  isStale({ width, height }, trail, colours) {
    const { drawn } = this;
    if (drawn.epoch !== trail.epoch || drawn.colours !== colours) return true;
    if (this.canvas.width !== width || this.canvas.height !== height) return true;
    return trail.added - drawn.added > TAIL_POINTS && performance.now() - drawn.at > REDRAW_MS;
  }

  redraw(context, trail, colours) {
    const { canvas } = this;
    [canvas.width, canvas.height] = [context.canvas.width, context.canvas.height];
    this.context.setTransform(context.getTransform());
    drawPoints(this.context, trail, 0, colours);
    this.drawn = { at: performance.now(), added: trail.added, epoch: trail.epoch, colours };
  }
}

/** Draws the points from the first-oldest on. */
function drawPoints(context, trail, first, colours) {
  const paths = pathsOf(trail, Math.max(0, first));
  context.lineCap = "round";
  for (const reason of ORDER) {
    context.strokeStyle = colours[reason];
    context.lineWidth = WIDTH_MM[reason];
    for (let age = 0; age < AGES; age += 1) {
      const path = paths[age * ORDER.length + reason];
      if (path === undefined) continue;
      context.globalAlpha = FAINTEST + (1 - FAINTEST) * (age / (AGES - 1)) ** 2;
      context.stroke(path);
    }
  }
  context.globalAlpha = 1;
}

/** One path for each age and reason, so that the number of strokes does not grow with the trail. */
function pathsOf(trail, first) {
  const paths = [];
  for (let i = first; i < trail.length; i += 1) {
    const age = ageOf(trail.length - i) * ORDER.length;
    const at = trail.index(i);
    const before = i > 0 ? trail.index(i - 1) : at;
    const reason = trail.reason[at];
    const way = WAYS.has(reason) ? reason : trail.reason[before];
    if (WAYS.has(way) && !isJump(trail, before, at)) addLine((paths[age + way] ??= new Path2D()), trail, before, at);
    if (!WAYS.has(reason)) addLine((paths[age + reason] ??= new Path2D()), trail, at, at);
  }
  return paths;
}

/** 0 for the oldest that a full trail holds. */
function ageOf(fromNewest) {
  return Math.floor((1 - fromNewest / CAPACITY) * AGES);
}

/** Whether someone carried the robot from one point to the next. */
function isJump(trail, from, to) {
  return Math.hypot(trail.x[to] - trail.x[from], trail.y[to] - trail.y[from]) > JUMP_MM;
}

/** A line, or with round ends a dot. */
function addLine(path, trail, from, to) {
  path.moveTo(trail.x[from] - 0.1, trail.y[from]);
  path.lineTo(trail.x[to], trail.y[to]);
}
