// @ts-check
/* How far away the things are that the proximity cones see, for robots that ask for it: as host_sim/world/ranges.py. */

import { FEEL } from "./generated.js";
import { CONES } from "./sensors.js";

/**
 * @typedef {import("./types.js").Pose} Pose
 * @typedef {import("./types.js").SimParams} SimParams
 *
 * A straight thing with round ends: ax, ay, bx, by and its radius, mm.
 * @typedef {[number, number, number, number, number]} Capsule
 */

const HALF = Math.PI / 8;
const WALL_MM = 100;
/** Nothing is there. */
const FAR = Infinity;

/**
 * The walls of an arena.
 * @param {SimParams} params
 * @returns {Capsule[]}
 */
export function wallsOf({ width_mm, height_mm }) {
  const [left, top, right, bottom] = [-WALL_MM, -WALL_MM, width_mm + WALL_MM, height_mm + WALL_MM];
  return [
    [left, top, right, top, WALL_MM], [right, top, right, bottom, WALL_MM],
    [right, bottom, left, bottom, WALL_MM], [left, bottom, left, top, WALL_MM],
  ];
}

/**
 * What a body measures, sensor by sensor from bit 0 of feel on: whole mm beyond its rim, or `none`.
 * @param {Pose} pose
 * @param {Capsule[]} things
 * @param {SimParams} params
 * @param {number} none
 */
export function rangesOf(pose, things, params, none) {
  const reach = params.body_radius_mm + params.sensor_reach_mm;
  const close = things.filter((thing) => nearest(pose, thing)[0] <= reach + params.front_extra_mm);
  return CONES.map(({ bit, bearing }) => {
    const found = Math.min(FAR, ...close.map((thing) => inCone(pose, thing, (bearing * Math.PI) / 180)));
    const inReach = found <= reach + (bit === FEEL.FRONT ? params.front_extra_mm : 0);
    return inReach ? Math.max(0, Math.round(found - params.body_radius_mm)) : none;
  });
}

/**
 * @param {Pose} pose
 * @param {Capsule} thing
 * @param {number} bearing
 */
function inCone(pose, thing, bearing) {
  const [distance, direction] = nearest(pose, thing);
  const axis = pose[2] + bearing;
  const off = direction - axis;
  if (Math.abs(off - 2 * Math.PI * Math.round(off / (2 * Math.PI))) <= HALF) return distance;
  return Math.min(along(pose, thing, axis - HALF), along(pose, thing, axis + HALF));
}

/**
 * Distance to the nearest of a thing, and the direction to it.
 * @param {Pose} pose
 * @param {Capsule} thing
 */
function nearest([px, py], [ax, ay, bx, by, radius]) {
  const [alongX, alongY, toX, toY] = [bx - ax, by - ay, px - ax, py - ay];
  const square = alongX * alongX + alongY * alongY;
  const part = square ? Math.max(0, Math.min(1, (toX * alongX + toY * alongY) / square)) : 0;
  const [x, y] = [part * alongX - toX, part * alongY - toY];
  return [Math.hypot(x, y) - radius, Math.atan2(y, x)];
}

/**
 * Distance to a thing in one direction.
 * @param {Pose} pose
 * @param {Capsule} thing
 * @param {number} direction
 */
function along([px, py], [ax, ay, bx, by, radius], direction) {
  const [rx, ry] = [Math.cos(direction), Math.sin(direction)];
  const circles = [[ax, ay], [bx, by]].map(([x, y]) => toCircle(rx, ry, [x - px, y - py, radius]));
  return Math.min(...circles, toSide(rx, ry, [ax - px, ay - py, bx - px, by - py, radius]));
}

/**
 * @param {number} rx - Of the ray's direction.
 * @param {number} ry
 * @param {number[]} circle - Its middle, seen from where the ray begins, and its radius.
 */
function toCircle(rx, ry, [x, y, radius]) {
  const ahead = x * rx + y * ry;
  const aside = y * rx - x * ry;
  if (ahead < 0 || Math.abs(aside) > radius) return FAR;
  return ahead - Math.sqrt(radius * radius - aside * aside);
}

/**
 * Distance to the nearer side of a capsule, without its round ends.
 * @param {number} rx - Of the ray's direction.
 * @param {number} ry
 * @param {Capsule} capsule - Seen from where the ray begins.
 */
function toSide(rx, ry, [ax, ay, bx, by, radius]) {
  const length = Math.hypot(bx - ax, by - ay);
  if (!length) return FAR;
  const [wx, wy] = [(bx - ax) / length, (by - ay) / length];
  const line = ax * -wy + ay * wx;
  const toward = rx * -wy + ry * wx;
  const side = line - Math.sign(line) * radius;
  if (line * side <= 0 || toward * side <= 0) return FAR;
  const distance = side / toward;
  const fromA = (distance * rx - ax) * wx + (distance * ry - ay) * wy;
  return fromA >= 0 && fromA <= length ? distance : FAR;
}
