// @ts-check
/* The curves of the runs over time, and the table of their results. */

import { made } from "../core/dom.js";
import { byId, typedById } from "../core/elements.js";
import { heard, inEachLanguage, nameIn, say, robotWords } from "../core/language.js";
import { paletteOf } from "../core/palette.js";
import { drawChart, strokeOf } from "../draw/chart.js";
import { NAMES, growthOf, rowsOf } from "./results.js";

/**
 * @typedef {import("./results.js").Curve} Curve
 * @typedef {import("./results.js").Growth} Growth
 */

/** Fills the elements chart and results. */
export class Curves {
  constructor() {
    this.canvas = typedById("chart", HTMLCanvasElement);
    this.select = typedById("curve", HTMLSelectElement);
    /** @type {WeakMap<RobotData, Map<Curve, Growth>>} */
    this.grown = new WeakMap();
    this.key = "";
    inEachLanguage(() => {
      this.key = "";
      byId("result-names").replaceChildren(...NAMES.map((name) => made("th", [nameIn("columns", name)])));
    });
  }

  /**
   * @param {ShownRun[]} lanes
   * @param {number} tick
   */
  show(lanes, tick) {
    this.draw(lanes, tick);
    const rows = lanes.flatMap((lane) => rowsOf(lane, tick));
    const key = JSON.stringify(rows);
    if (key === this.key) return;
    this.key = key;
    byId("results").replaceChildren(...rows.map((row) => made("tr", row.map((value) => made("td", [said(value)])))));
  }

  /**
   * @param {ShownRun[]} lanes
   * @param {number} tick
   */
  draw(lanes, tick) {
    const { robots } = paletteOf(this.canvas);
    const lines = lanes.flatMap((lane) => this.linesOf(lane, tick)).map((line, i) => ({ ...line, ...strokeOf(i, robots) }));
    const last = Math.max(1, ...lanes.map((lane) => lane.last));
    const most = Math.max(1, ...lines.map(({ counts }) => counts.at(-1) ?? 0));
    drawChart(this.canvas, lines, { last, most, time: lanes[0]?.scene?.clock(last) ?? "" });
  }

  /**
   * @param {ShownRun} lane
   * @param {number} tick
   */
  linesOf(lane, tick) {
    const robots = lane.data?.robots ?? [];
    const nameOf = (/** @type {number} */ node) => (robots.length > 1 ? `${lane.name} ${node}` : lane.name);
    return robots.map((robot) => ({
      ...this.growth(robot, lane), name: nameOf(robot.run.node), end: Math.min(tick, lane.last),
    }));
  }

  /**
   * @param {RobotData} robot
   * @param {ShownRun} lane
   */
  growth(robot, { data }) {
    const curve = /** @type {Curve} */ (this.select.value);
    const known = this.grown.get(robot) ?? new Map();
    this.grown.set(robot, known);
    const growth = known.get(curve) ?? growthOf(robot, curve, data?.measures.tick_ms ?? 0);
    known.set(curve, growth);
    return growth;
  }
}

/** @param {ShownRun[]} lanes */
export function csvOf(lanes) {
  const rows = [NAMES, ...lanes.flatMap((lane) => rowsOf(lane, lane.last))];
  return rows.map((row) => `${row.join(",")}\n`).join("");
}

/**
 * A value as the page says it; a file has it in English.
 * @param {string | number} value
 */
function said(value) {
  if (typeof value === "number") return `${value}`.replace(".", robotWords().point);
  return value === "yes" || value === "no" ? say(value) : heard(value);
}
