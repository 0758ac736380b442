/* Where the robot was and why, newest last: as many points as are drawn, and no more. */

import { REASON } from "./reasons.js";

/** So many points are kept. */
export const CAPACITY = 1600;
const WAY_MM = 12;
const SAME_PLACE_MM = 4;

/** Reasons whose trail is a line; the others turn on the spot and leave a dot. */
export const WAYS = new Set([REASON.wander, REASON.towardFood]);

/**
 * Drops what is closer to the last point than anyone could see.
 * `epoch` changes when the trail begins anew; `added` counts the points since.
 */
export class Trail {
  constructor() {
    this.x = new Float32Array(CAPACITY);
    this.y = new Float32Array(CAPACITY);
    this.reason = new Uint8Array(CAPACITY);
    this.epoch = 0;
    this.clear();
  }

  clear() {
    this.epoch += 1;
    this.added = 0;
    this.length = 0;
    this.next = 0;
  }

  /**
   * Adds the place of one tick.
   * @param {number} x - mm
   * @param {number} y - mm
   * @param {number} reason - 0..7
   */
  add(x, y, reason) {
    const last = (this.next + CAPACITY - 1) % CAPACITY;
    const near = WAYS.has(reason) ? WAY_MM : SAME_PLACE_MM;
    const moved = Math.hypot(x - this.x[last], y - this.y[last]);
    if (this.length > 0 && reason === this.reason[last] && moved < near) return;
    this.x[this.next] = x;
    this.y[this.next] = y;
    this.reason[this.next] = reason;
    this.next = (this.next + 1) % CAPACITY;
    this.added += 1;
    this.length = Math.min(this.length + 1, CAPACITY);
  }

  /** @param {number} i - 0 for the oldest point. @returns {number} Its index in x, y and reason. */
  index(i) {
    return (this.next - this.length + i + CAPACITY) % CAPACITY;
  }
}
