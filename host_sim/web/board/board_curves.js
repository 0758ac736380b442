// @ts-check
/* The curves of all robots on the board: what came so far, and how it is drawn. */

/**
 * @typedef {"trials" | "blocked" | "cells" | "meals"} CurveName
 *
 * The samples of one robot.
 * @typedef {Record<CurveName, number[]>} Samples
 *
 * New samples from host_sim/live/board_feed.py.
 * @typedef {{anew: boolean, ticks: number[], robots: Samples[]}} NewSamples
 */

/** Size of a drawing: any, for it is stretched. */
const WIDTH = 100;
const HEIGHT = 30;
const MARGIN = 1.5;

/** Collects samples. */
export class BoardCurves {
  constructor() {
    /** @type {number[]} */
    this.ticks = [];
    /** @type {Samples[]} */
    this.robots = [];
  }

  /** @param {NewSamples} samples */
  add({ anew, ticks, robots }) {
    if (anew) [this.ticks, this.robots] = [[], robots.map(() => ({ trials: [], blocked: [], cells: [], meals: [] }))];
    this.ticks.push(...ticks);
    robots.forEach((samples, i) => {
      for (const name of /** @type {CurveName[]} */ (Object.keys(samples))) this.robots[i][name].push(...samples[name]);
    });
  }

  /**
   * A robot's last sample.
   * @param {number} robot
   * @param {CurveName} name
   */
  last(robot, name) {
    return this.robots[robot]?.[name].at(-1) ?? 0;
  }

  /**
   * The highest value of all robots, at least 1.
   * @param {CurveName} name
   */
  most(name) {
    return this.robots.reduce((most, samples) => samples[name].reduce((high, value) => Math.max(high, value), most), 1);
  }

  /**
   * A robot's curve as an SVG path.
   * @param {number} robot
   * @param {CurveName} name
   * @param {number} most - The value at the top.
   */
  path(robot, name, most) {
    const end = Math.max(1, this.ticks.at(-1) ?? 1);
    const y = (/** @type {number} */ value) => HEIGHT - MARGIN - (value / most) * (HEIGHT - 2 * MARGIN);
    const points = this.ticks.map((tick, i) => `${((tick / end) * WIDTH).toFixed(1)} ${y(this.robots[robot][name][i]).toFixed(1)}`);
    return points.length ? `M${points.join("L")}` : "";
  }
}

export const VIEW_BOX = `0 0 ${WIDTH} ${HEIGHT}`;
