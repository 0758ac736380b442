/* The curves of the runs over time, and the table of their results. */

import { byId, made, typedById } from "../core/dom.js";
import { heard, inEachLanguage, nameIn, say, robotWords } from "../core/language.js";
import { currentPalette } from "../core/palette.js";
import { drawChart, strokeOf } from "../draw/chart.js";
import { NAMES, growthOf, rowsOf } from "./results.js";
import type { RobotData } from "../core/run_data.js";
import type { Curve, Growth } from "./results.js";
import type { ShownRun } from "./shown_run.js";

/** Fills the elements chart and results. */
export class Curves {
  canvas = typedById("chart", HTMLCanvasElement);
  select = typedById("curve", HTMLSelectElement);
  grown: WeakMap<RobotData, Map<Curve, Growth>> = new WeakMap();
  key = "";

  constructor() {
    inEachLanguage(() => {
      this.key = "";
      byId("result-names").replaceChildren(...NAMES.map((name) => made("th", [nameIn("columns", name)])));
    });
  }

  show(lanes: ShownRun[], tick: number) {
    this.draw(lanes, tick);
    const rows = lanes.flatMap((lane) => rowsOf(lane, tick));
    const key = JSON.stringify(rows);
    if (key === this.key) return;
    this.key = key;
    byId("results").replaceChildren(...rows.map((row) => made("tr", row.map((value) => made("td", [said(value)])))));
  }

  draw(lanes: ShownRun[], tick: number) {
    const { robots } = currentPalette();
    const lines = lanes.flatMap((lane) => this.linesOf(lane, tick)).map((line, i) => ({ ...line, ...strokeOf(i, robots) }));
    const last = Math.max(1, ...lanes.map((lane) => lane.last));
    const most = Math.max(1, ...lines.map(({ counts }) => counts.at(-1) ?? 0));
    drawChart(this.canvas, lines, { last, most, time: lanes[0]?.scene?.clock(last) ?? "" });
  }

  linesOf(lane: ShownRun, tick: number) {
    const robots = lane.data?.robots ?? [];
    const nameOf = (node: number) => (robots.length > 1 ? `${lane.name} ${node}` : lane.name);
    return robots.map((robot) => ({
      ...this.growth(robot, lane), name: nameOf(robot.run.node), end: Math.min(tick, lane.last),
    }));
  }

  growth(robot: RobotData, { data }: ShownRun) {
    const curve = this.select.value as Curve;
    const known = this.grown.get(robot) ?? new Map();
    this.grown.set(robot, known);
    const growth = known.get(curve) ?? growthOf(robot, curve, data?.measures.tick_ms ?? 0);
    known.set(curve, growth);
    return growth;
  }
}

export function csvOf(lanes: ShownRun[]) {
  const rows = [NAMES, ...lanes.flatMap((lane) => rowsOf(lane, lane.last))];
  return rows.map((row) => `${row.join(",")}\n`).join("");
}

/** A value in the language of the page; a file has it in English. */
function said(value: string | number) {
  if (typeof value === "number") return `${value}`.replace(".", robotWords().point);
  return value === "yes" || value === "no" ? say(value) : heard(value);
}
