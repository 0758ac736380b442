// @ts-check
/* The curves of all robots on the board: what came so far, in one chart. */

import { typedById } from "../core/elements.js";
import { drawChart, strokeOf } from "../draw/chart.js";
import { PATTERNS } from "../generated.js";

/**
 * @typedef {"trials" | "blocked" | "cells" | "meals"} CurveName
 *
 * The samples of one robot.
 * @typedef {Record<CurveName, number[]>} Samples
 *
 * New samples from host_sim/live/board_feed.py.
 * @typedef {{anew: boolean, ticks: number[], robots: Samples[]}} NewSamples
 */

/** Collects samples, and fills the element `chart` with the curves that the element `curve` asks for. */
export class BoardCurves {
  constructor() {
    this.canvas = typedById("chart", HTMLCanvasElement);
    this.select = typedById("curve", HTMLSelectElement);
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
   * @param {Scene} scene
   * @param {string[]} colours - That tell robots apart.
   */
  draw(scene, colours) {
    const curve = /** @type {CurveName} */ (this.select.value);
    const unit = curve === "blocked" ? scene.measures.tick_ms / 1000 : 1;
    const end = this.ticks.at(-1) ?? 0;
    const lines = this.robots.map((samples, i) => ({
      ...strokeOf(i, colours), name: `${scene.states[i].node}`, ticks: this.ticks, counts: samples[curve].map((count) => count * unit), end,
    }));
    const high = Math.max(1, ...this.robots.map((_, i) => this.last(i, curve) * unit));
    const most = curve === "cells" ? PATTERNS.length - 1 : Math.ceil(high);
    drawChart(this.canvas, lines, { last: end, most, time: scene.clock(scene.environment.start_tick + end) });
  }
}
