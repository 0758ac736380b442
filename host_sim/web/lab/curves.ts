/* The curves of the runs over time, and the table of their results, which is saved as a file, too. */

import { byId, made, typedById } from "../core/dom.js";
import { heard, inEachLanguage, say, robotWords } from "../core/language.js";
import { currentPalette } from "../core/palette.js";
import { AVOIDING, PARAMETERS } from "../generated.js";
import { drawChart, strokeOf } from "../draw/chart.js";
import type { RobotData } from "../core/run_data.js";
import type { ShownRun } from "./shown_run.js";

type Curve = "trials" | "blocked" | "meals";

/** A count that grows: the ticks in which it does, and what it is from then on. */
type Growth = { ticks: number[]; counts: number[] };

/** The columns of the table and of the file. */
const NAMES = ["run", "robot", "behaviour", "seed", "environment", "finished", "time (s)", "shortest tour (s)", "trials", "lessons", "bored", "blocked (s)", "meals"];

/** Fills the elements chart and results. */
export class Curves {
  canvas = typedById("chart", HTMLCanvasElement);
  select = typedById("curve", HTMLSelectElement);
  grown: WeakMap<RobotData, Map<Curve, Growth>> = new WeakMap();
  key = "";

  constructor() {
    inEachLanguage(() => {
      this.key = "";
      byId("result-names").replaceChildren(...NAMES.map((name) => made("th", [heard(name)])));
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

/** How something grows in a run. */
function growthOf(robot: RobotData, curve: Curve, tickMs: number): Growth {
  if (curve === "blocked") return blockedGrowth(robot, tickMs / 1000);
  const kind = curve === "trials" ? "trial" : "eat";
  const ticks = robot.run.events.filter(([, what]) => what === kind).map(([tick]) => tick);
  return { ticks, counts: ticks.map((_, i) => i + 1) };
}

/** One row for each robot and environment that has begun by a tick. */
function rowsOf(lane: ShownRun, upTo: number): (string | number)[][] {
  const { data, experiment } = lane;
  if (!data) return [];
  const begun = data.robots[0].run.events.filter(([tick, kind]) => kind === "environment" && tick <= upTo);
  return begun.flatMap(([first], i) => {
    const last = Math.min(upTo, data.last, (begun[i + 1]?.[0] ?? Infinity) - 1);
    const eaten = data.statesAt(last)[0].eaten;
    return data.robots.map((robot, r) => {
      const { profile, settings } = lane.setupAt(last, r);
      return [
        lane.name, robot.run.node, profile, experiment.seed, data.sceneAt(first).number,
        eaten.every(Boolean) ? "yes" : "no", seconds(last + 1 - first, data.measures.tick_ms),
        tourOf(lane, i, settings), ...numbersOf(robot, first, last, data.measures.tick_ms),
      ];
    });
  });
}

function numbersOf(robot: RobotData, first: number, last: number, tickMs: number) {
  const inside = (tick: number) => tick >= first && tick <= last;
  const count = (kind: string) => robot.run.events.filter(([tick, what]) => what === kind && inside(tick)).length;
  const blocked = robot.columns.reason.subarray(first - robot.first, last + 1 - robot.first).filter((reason) => AVOIDING.includes(reason)).length;
  return [count("trial"), count("lesson"), count("boredom"), seconds(blocked, tickMs), count("eat")];
}

function seconds(ticks: number, tickMs: number) {
  return Number(((ticks * tickMs) / 1000).toFixed(2));
}

/**
 * How long the shortest tour through all food of an environment takes at the robot's speed, s, without turning.
 * @param environment - Counted from 0.
 * @param settings - Of the robot.
 */
function tourOf(
  { tours, experiment }: ShownRun,
  environment: number,
  { speed_mm_s: speed = PARAMETERS.speed_mm_s.default }: Record<string, number>,
) {
  const isKnown = Number.isFinite(tours[environment]) && experiment.robots.length === 1;
  return isKnown ? Number((tours[environment] / speed).toFixed(2)) : "";
}

function blockedGrowth({ first, columns }: RobotData, tickS: number): Growth {
  const growth: Growth = { ticks: [], counts: [] };
  let blocked = 0;
  columns.reason.forEach((reason, i) => {
    if (!AVOIDING.includes(reason)) return;
    blocked += 1;
    growth.ticks.push(first + i);
    growth.counts.push(blocked * tickS);
  });
  return growth;
}
