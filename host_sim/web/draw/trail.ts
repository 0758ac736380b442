/* Trails: where robots were and why, newest last, as many points as are drawn; paths are drawn as lines, turns as dots, coloured
   by reason, the older the fainter. */

import { contextOf } from "../core/dom.js";
import { REASON } from "../generated.js";

/** Points that one trail keeps, and that all trails of a page keep together. */
const CAPACITY = 1600;
const CAPACITY_OF_ALL = 12800;
const CAPACITY_MIN = 200;
const PATH_MM = 12;
const SAME_PLACE_MM = 4;

let epochs = 0;

/** Reasons whose trail is a line; the others turn on the spot and leave a dot. */
const PATHS = new Set([REASON.WANDER, REASON.TOWARD_FOOD]);

/** Trails for the robots of a page. */
export function trailsFor(robots: number): Trail[] {
  const capacity = Math.max(CAPACITY_MIN, Math.min(CAPACITY, Math.floor(CAPACITY_OF_ALL / robots)));
  return Array.from({ length: robots }, () => new Trail(capacity));
}

/**
 * Drops what is closer to the last point than anyone could see.
 * No two trails have the same `epoch`, and it changes when a trail begins anew; `added` counts the points since.
 */
export class Trail {
  x = new Float32Array(this.capacity);
  y = new Float32Array(this.capacity);
  reason = new Uint8Array(this.capacity);
  added = 0;
  length = 0;
  next = 0;
  epoch = (epochs += 1);

  /** @param capacity - Points that it keeps at most. */
  constructor(readonly capacity: number) {}

  clear() {
    this.epoch = epochs += 1;
    this.added = this.length = this.next = 0;
  }

  /**
   * Adds the place of one tick.
   * @param x - mm
   * @param y - mm
   * @param reason - One of REASON.
   */
  add(x: number, y: number, reason: number) {
    const last = (this.next + this.capacity - 1) % this.capacity;
    const near = PATHS.has(reason) ? PATH_MM : SAME_PLACE_MM;
    const moved = Math.hypot(x - this.x[last], y - this.y[last]);
    if (this.length > 0 && reason === this.reason[last] && moved < near) return;
    this.x[this.next] = x;
    this.y[this.next] = y;
    this.reason[this.next] = reason;
    this.next = (this.next + 1) % this.capacity;
    this.added += 1;
    this.length = Math.min(this.length + 1, this.capacity);
  }

  /**
   * The index of a point in x, y and reason.
   * @param i - 0 for the oldest point.
   */
  index(i: number) {
    return (this.next - this.length + i + this.capacity) % this.capacity;
  }
}

const AGES = 6;
const FAINTEST = 0.16;
/** The trails of the robots that are not selected are this much fainter. */
const OTHERS = 0.45;
const TAIL_POINTS = 24;
const REDRAW_MS = 100;
const JUMP_MM = 150;
/** Width of the mark of each reason, mm, in drawing order: what matters more lies on top. */
export const WIDTH_MM = new Map([
  [REASON.LOOK_AROUND, 30], [REASON.STOP, 30], [REASON.WANDER, 14], [REASON.TOWARD_FOOD, 20],
  [REASON.REMEMBERED, 36], [REASON.BOREDOM, 60], [REASON.TRIAL, 60], [REASON.EAT, 44],
  [REASON.SILENCE, 44], [REASON.AVOID, 44], [REASON.PROGRAM, 44],
]);

/** Keeps a picture of trails that grow slowly, so that most frames draw their newest points only. */
export class TrailLayer {
  canvas = document.createElement("canvas");
  context = contextOf(this.canvas);
  /** The trails and the part of the arena in the last frame, and the number of points of each trail. */
  before = { key: "", added: [0] };
  drawn = { at: 0, key: "", added: [0], colours: [""] };

  /**
   * @param context - In mm.
   * @param colours - By reason.
   * @param selected - The trail of the selected robot.
   */
  draw(context: CanvasRenderingContext2D, trails: Trail[], colours: string[], selected: Trail) {
    const order = [...trails.filter((trail) => trail !== selected), selected];
    const { a, e, f } = context.getTransform();
    const key = [order.map(({ epoch }) => epoch), trails.indexOf(selected), a, e, f].join();
    const { before } = this;
    this.before = { key, added: order.map(({ added }) => added) };
    if (before.key !== key || haveGrown(order, before.added)) {
      drawTrails(context, order, colours);
      return;
    }
    if (this.isStale(context.canvas, key, order, colours)) this.redraw(context, key, order, colours);
    context.save();
    context.resetTransform();
    context.drawImage(this.canvas, 0, 0);
    context.restore();
    order.forEach((trail, i) => {
      const first = trail.length - (trail.added - this.drawn.added[i]);
      drawPoints(context, trail, { first, colours, strength: trail === selected ? 1 : OTHERS });
    });
  }

  /** @param key - Identifies the trails in the picture. */
  isStale({ width, height }: HTMLCanvasElement, key: string, order: Trail[], colours: string[]) {
    const { drawn } = this;
    if (drawn.key !== key || drawn.colours !== colours) return true;
    if (this.canvas.width !== width || this.canvas.height !== height) return true;
    return haveGrown(order, drawn.added) && performance.now() - drawn.at > REDRAW_MS;
  }

  /** @param order - The last one is that of the selected robot. */
  redraw(context: CanvasRenderingContext2D, key: string, order: Trail[], colours: string[]) {
    const { canvas } = this;
    [canvas.width, canvas.height] = [context.canvas.width, context.canvas.height];
    this.context.setTransform(context.getTransform());
    drawTrails(this.context, order, colours);
    this.drawn = { at: performance.now(), key, added: order.map(({ added }) => added), colours };
  }
}

/**
 * Whether there is more to draw than a few points.
 * @param added - The number of points that each had.
 */
function haveGrown(order: Trail[], added: number[]) {
  return order.some((trail, i) => trail.added - added[i] > TAIL_POINTS);
}

/**
 * Draws whole trails.
 * @param order - The last one is that of the selected robot.
 */
function drawTrails(context: CanvasRenderingContext2D, order: Trail[], colours: string[]) {
  order.forEach((trail, i) => {
    const strength = i === order.length - 1 ? 1 : OTHERS;
    drawPoints(context, trail, { first: 0, colours, strength });
  });
}

/** Draws the points from the index `first` on, where 0 is the oldest. */
function drawPoints(
  context: CanvasRenderingContext2D,
  trail: Trail,
  { first, colours, strength }: { first: number, colours: string[], strength: number },
) {
  const paths = pathsOf(trail, Math.max(0, first));
  context.lineCap = "round";
  for (const [reason, width] of WIDTH_MM) {
    context.strokeStyle = colours[reason];
    context.lineWidth = width;
    for (let age = 0; age < AGES; age += 1) {
      const path = paths[age * WIDTH_MM.size + reason];
      if (path === undefined) continue;
      context.globalAlpha = strength * (FAINTEST + (1 - FAINTEST) * (age / (AGES - 1)) ** 2);
      context.stroke(path);
    }
  }
  context.globalAlpha = 1;
}

/** One path for each age and reason, so that the number of strokes does not grow with the trail. */
function pathsOf(trail: Trail, first: number) {
  const paths: Path2D[] = [];
  for (let i = first; i < trail.length; i += 1) {
    const age = ageOf(trail, i) * WIDTH_MM.size;
    const at = trail.index(i);
    const before = i > 0 ? trail.index(i - 1) : at;
    const reason = trail.reason[at];
    const path = PATHS.has(reason) ? reason : trail.reason[before];
    if (PATHS.has(path) && !isJump(trail, before, at)) addLine((paths[age + path] ??= new Path2D()), trail, before, at);
    if (!PATHS.has(reason)) addLine((paths[age + reason] ??= new Path2D()), trail, at, at);
  }
  return paths;
}

/** The age of a point, in steps: 0 for the oldest of a full trail. */
function ageOf(trail: Trail, i: number) {
  return Math.floor((1 - (trail.length - i) / trail.capacity) * AGES);
}

/** Whether someone carried the robot from one point to the next. */
function isJump(trail: Trail, from: number, to: number) {
  return Math.hypot(trail.x[to] - trail.x[from], trail.y[to] - trail.y[from]) > JUMP_MM;
}

/** A line, or with round ends a dot. */
function addLine(path: Path2D, trail: Trail, from: number, to: number) {
  path.moveTo(trail.x[from] - 0.1, trail.y[from]);
  path.lineTo(trail.x[to], trail.y[to]);
}
