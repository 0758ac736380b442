// @ts-check
/* The curves of the runs, growing with time, and the table of what they have come to. */

import { byId, contextOf, setText, typedById } from "../core/elements.js";
import { paletteOf } from "../core/palette.js";
import { NAMES, growthOf, rowsOf } from "./results.js";

/**
 * @typedef {import("./shown_run.js").ShownRun} ShownRun
 * @typedef {import("./results.js").Curve} Curve
 * @typedef {import("./results.js").Growth} Growth
 */

const LEFT_PX = 40;
const BOTTOM_PX = 20;
const TOP_PX = 8;
const RIGHT_PX = 22;
const DASHES = [[], [8, 4], [2, 3], [8, 3, 2, 3]];
const COLOURS = /** @type {const} */ ([4, 5, 6, 2]);

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
    const { canvas } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(height * devicePixelRatio);
    const context = contextOf(canvas);
    context.scale(devicePixelRatio, devicePixelRatio);
    const palette = paletteOf(canvas);
    const lines = lanes.flatMap((lane, i) => this.linesOf(lane, i));
    const last = Math.max(1, ...lanes.map((lane) => lane.last));
    const most = Math.max(1, ...lines.map(({ growth }) => growth.counts.at(-1) ?? 0));
    const x = (/** @type {number} */ at) => LEFT_PX + (at / last) * (width - LEFT_PX - RIGHT_PX);
    const y = (/** @type {number} */ count) => height - BOTTOM_PX - (count / most) * (height - BOTTOM_PX - TOP_PX);
    this.drawAxes(context, palette.of.ink, { x, y, last, most }, lanes[0]);
    for (const line of lines) drawLine(context, { ...line, colour: palette.reasons[COLOURS[line.lane % COLOURS.length]] }, { x, y, tick });
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {string} ink
   * @param {{x: (tick: number) => number, y: (count: number) => number, last: number, most: number}} scale
   * @param {ShownRun | undefined} lane
   */
  drawAxes(context, ink, { x, y, last, most }, lane) {
    context.fillStyle = context.strokeStyle = ink;
    context.font = "12px sans-serif";
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x(0), y(most));
    context.lineTo(x(0), y(0));
    context.lineTo(x(last), y(0));
    context.stroke();
    context.textAlign = "right";
    context.fillText(`${Math.round(most)}`, x(0) - 4, y(most) + 10);
    context.fillText("0", x(0) - 4, y(0));
    context.fillText(lane?.scene?.clock(last) ?? "", x(last), y(0) + 15);
  }

  /**
   * @param {ShownRun} lane
   * @param {number} index
   */
  linesOf(lane, index) {
    return (lane.data?.robots ?? []).map((robot, r) => ({
      lane: index, dash: DASHES[r % DASHES.length], name: lane.name, growth: this.growth(robot, lane),
      last: lane.last,
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

/**
 * @param {CanvasRenderingContext2D} context
 * @param {{colour: string, dash: readonly number[], name: string, growth: Growth, last: number}} line
 * @param {{x: (tick: number) => number, y: (count: number) => number, tick: number}} scale
 */
function drawLine(context, { colour, dash, name, growth, last }, { x, y, tick }) {
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 2.5;
  context.setLineDash([...dash]);
  context.beginPath();
  context.moveTo(x(0), y(0));
  let count = 0;
  for (let i = 0; i < growth.ticks.length && growth.ticks[i] <= tick; i += 1) {
    context.lineTo(x(growth.ticks[i]), y(count));
    count = growth.counts[i];
    context.lineTo(x(growth.ticks[i]), y(count));
  }
  const end = Math.min(tick, last);
  context.lineTo(x(end), y(count));
  context.stroke();
  context.setLineDash([]);
  context.textAlign = "left";
  context.fillText(name, x(end) + 4, y(count) + 4);
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
