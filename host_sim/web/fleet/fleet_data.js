// @ts-check
/* Unpacks a fleet's data, written by host_sim/report/fleet_page.py. */

import { unpackColumns } from "../core/packed_columns.js";
import { PATTERNS } from "../generated.js";

/**
 * @typedef {Object} Fleet
 * @property {string} profile
 * @property {number} robots
 * @property {boolean} own
 * @property {number} width
 * @property {number} height
 * @property {number} body
 * @property {number} bar
 * @property {number} sample_s
 * @property {number} samples
 * @property {number} seed
 * @property {number} environments
 * @property {string} alone
 * @property {string[]} columns
 * @property {string} data
 * @property {number} scene_count
 * @property {string} scenes
 *
 * An environment of a world, from a sample on: each obstacle [ax, ay, bx, by], each piece of food [x, y].
 * @typedef {{first: number, bars: number[][], food: number[][]}} FleetScene
 */

/** A robot that moves farther than this to the next sample was carried into another environment. */
const JUMP_MM = 600;
const EATEN_BITS = 30;
const SIDE_BITS = 2;
const SIDE_MASK = 3;

/**
 * @param {Fleet} fleet
 * @returns {Promise<FleetData>}
 */
export async function fleetData(fleet) {
  const columns = await unpackColumns(fleet.data, fleet.columns, fleet.samples);
  const { scenes } = await unpackColumns(fleet.scenes, ["scenes"], fleet.scene_count);
  return new FleetData(fleet, columns, scenes);
}

/** What each robot does and knows at each sample. */
export class FleetData {
  /**
   * @param {Fleet} fleet
   * @param {Columns} columns
   * @param {Int32Array} scenes
   */
  constructor(fleet, columns, scenes) {
    this.fleet = fleet;
    this.columns = columns;
    this.worlds = fleet.own ? fleet.robots : 1;
    /** @type {FleetScene[][]} */
    this.scenes = scenesOf(scenes, this.worlds);
    /** For each sample, the mean of the patterns known, and of the food eaten. */
    this.known = this.means((sample) => sum(this.levelsAt(sample)));
    this.meals = this.means((sample) => this.countsAt(sample).eaten);
  }

  /** @param {(sample: number) => number} total - Of all robots. */
  means(total) {
    return Array.from({ length: this.fleet.samples }, (_, sample) => total(sample) / this.fleet.robots);
  }

  /**
   * The environment of a world.
   * @param {number} world
   * @param {number} at
   */
  sceneAt(world, at) {
    return this.scenes[world].filter(({ first }) => first <= at).at(-1) ?? this.scenes[world][0];
  }

  /**
   * Whether a piece of food is eaten.
   * @param {number} world
   * @param {number} piece
   * @param {number} at
   */
  isEaten(world, piece, at) {
    const column = this.columns[`eaten${world}.${Math.floor(piece / EATEN_BITS)}`];
    return Boolean(column && (column[Math.floor(at)] >> piece % EATEN_BITS) & 1);
  }

  /**
   * Whether all food of a world is eaten.
   * @param {number} world
   * @param {number} at
   */
  isFinished(world, at) {
    return this.sceneAt(world, at).food.every((_, piece) => this.isEaten(world, piece, at));
  }

  /**
   * The turns that a robot knows, one for each pattern.
   * @param {number} robot
   * @param {number} at
   */
  sidesAt(robot, at) {
    const code = this.columns[`knows${robot}`][Math.floor(at)];
    return PATTERNS.map((_, pattern) => (code >> (SIDE_BITS * pattern)) & SIDE_MASK);
  }

  /**
   * How many patterns each robot knows.
   * @param {number} at
   */
  levelsAt(at) {
    return Array.from({ length: this.fleet.robots }, (_, robot) => this.sidesAt(robot, at).filter(Boolean).length);
  }

  /**
   * How many pieces of food are eaten by now, and how many environments are left with none.
   * @param {number} at
   */
  countsAt(at) {
    const counts = { eaten: 0, finished: 0 };
    for (let world = 0; world < this.worlds; world += 1) {
      this.scenes[world].filter(({ first }) => first <= at).forEach((scene, i) => {
        const end = Math.min(at, (this.scenes[world][i + 1]?.first ?? Infinity) - 1);
        const eaten = scene.food.filter((_, piece) => this.isEaten(world, piece, end)).length;
        counts.eaten += eaten;
        counts.finished += Number(eaten === scene.food.length);
      });
    }
    return counts;
  }

  /**
   * Where a robot is in its world; between two samples, it goes straight ahead.
   * @param {number} robot
   * @param {number} at
   */
  poseOf(robot, at) {
    const [x, y, heading] = ["x", "y", "heading"].map((axis) => this.columns[`${axis}${robot}`]);
    const before = Math.floor(at);
    const after = Math.min(this.fleet.samples - 1, before + 1);
    const [dx, dy] = [x[after] - x[before], y[after] - y[before]];
    const part = Math.hypot(dx, dy) > JUMP_MM ? 0 : at - before;
    return [x[before] + part * dx, y[before] + part * dy, heading[before] / 1000];
  }
}

/** @param {number[]} numbers */
function sum(numbers) {
  return numbers.reduce((total, number) => total + number, 0);
}

/**
 * @param {Int32Array} numbers
 * @param {number} worlds
 */
function scenesOf(numbers, worlds) {
  /** @type {FleetScene[][]} */
  const scenes = Array.from({ length: worlds }, () => []);
  let at = 0;
  const take = (/** @type {number} */ count) => [...numbers.subarray(at, (at += count))];
  const several = (/** @type {number} */ size) => Array.from({ length: take(1)[0] }, () => take(size));
  while (at < numbers.length) {
    const [world, first] = take(2);
    scenes[world].push({ first, bars: several(4), food: several(2) });
  }
  return scenes;
}
