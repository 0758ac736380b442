// @ts-check
/* The curves of the runs, growing with time, and the table of what they have come to. */

import { byId, setText, typedById } from "../core/elements.js";
import { paletteOf } from "../core/palette.js";
import { drawChart, strokeOf } from "../draw/chart.js";
import { NAMES, growthOf, rowsOf } from "./results.js";

/**
 * @typedef {import("./shown_run.js").ShownRun} ShownRun
 * @typedef {import("./results.js").Curve} Curve
 * @typedef {import("./results.js").Growth} Growth
 */

/** Fills the elements chart and results. */
export class Curves {
  constructor() {
    this.canvas = typedById("chart", HTMLCanvasElement);
    this.select = typedById("curve", HTMLSelectElement);
    byId("result-names").append(...NAMES.map((name) => cellFor("th", name)));
    /** @type {WeakMap<import("../core/run_data.js").RobotData, Map<Curve, Growth>>} */
    this.grown = new WeakMap();
    this.key = "";
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
    byId("results").replaceChildren(...rows.map(rowFor));
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
    const nameOf = (/** @type {number} */ node) => (robots.length > 1 ? `${lane.name}${node}` : lane.name);
    return robots.map((robot) => ({
      ...this.growth(robot, lane), name: nameOf(robot.run.node), end: Math.min(tick, lane.last),
    }));
  }

  /**
   * @param {import("../core/run_data.js").RobotData} robot
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

/**
 * A table as the text of a file.
 * @param {ShownRun[]} lanes
 */
export function csvOf(lanes) {
  const rows = [NAMES, ...lanes.flatMap((lane) => rowsOf(lane, lane.last))];
  return rows.map((row) => `${row.join(",")}\n`).join("");
}

/** @param {(string | number)[]} row */
function rowFor(row) {
  const element = document.createElement("tr");
  element.append(...row.map((value) => cellFor("td", `${value}`)));
  return element;
}

/**
 * @param {"td" | "th"} kind
 * @param {string} text
 */
function cellFor(kind, text) {
  const cell = document.createElement(kind);
  setText(cell, text);
  return cell;
}
