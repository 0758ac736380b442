/* Where a robot was and why, newest last: as many points as are drawn, and no more. */

import { REASON } from "../generated.js";

/** Points that one trail keeps, and that all trails of a page keep together. */
const CAPACITY = 1600;
const CAPACITY_OF_ALL = 12800;
const CAPACITY_MIN = 200;
const PATH_MM = 12;
const SAME_PLACE_MM = 4;

let epochs = 0;

/** Reasons whose trail is a line; the others turn on the spot and leave a dot. */
export const PATHS = new Set([REASON.WANDER, REASON.TOWARD_FOOD]);

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
  capacity: number;
  x: Float32Array;
  y: Float32Array;
  reason: Uint8Array;
  added: number;
  length: number;
  next: number;
  epoch: number;

  /** @param capacity - Points that it keeps at most. */
  constructor(capacity: number = CAPACITY) {
    this.capacity = capacity;
    this.x = new Float32Array(capacity);
    this.y = new Float32Array(capacity);
    this.reason = new Uint8Array(capacity);
    this.epoch = this.added = this.length = this.next = 0;
    this.clear();
  }

  clear() {
    epochs += 1;
    this.epoch = epochs;
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
