// @ts-check
/* Where two runs part, and why. */

import { byId, setText } from "../core/elements.js";
import { CELL_COUNT, PATTERNS } from "../generated.js";
import { sentence } from "../core/phrases.js";

/**
 * @typedef {import("../lab/shown_run.js").ShownRun} ShownRun
 * @typedef {import("../core/run_data.js").RunData} RunData
 * @typedef {import("../types.js").State} State
 */

const DRIVE = ["left", "right", "reason", "repeat_count", "action"];

/** Fills the element parting. */
export class DivergenceView {
  constructor() {
    /**
     * What the words are of.
     * @type {(RunData | undefined)[]}
     */
    this.compared = [];
  }

  /**
   * Compares the first run with the one that is selected, or with the second.
   * @param {ShownRun[]} lanes
   * @param {ShownRun} selected
   */
  show([first, ...others], selected) {
    const other = selected === first ? others[0] : selected;
    const compared = other ? [first.data, other.data] : [];
    if (compared.length === this.compared.length && compared.every((data, i) => data === this.compared[i])) return;
    this.compared = compared;
    setText(byId("parting"), other ? partingWords(first, other) : "");
  }
}

/**
 * The first tick in which a robot of one run does something else than that of another; undefined if none does.
 * @param {RunData} one
 * @param {RunData} other
 * @param {string[]} [columns] - What is compared.
 * @returns {{tick: number, robot: number} | undefined}
 */
export function partingOf(one, other, columns = DRIVE) {
  const robots = Math.min(one.robots.length, other.robots.length);
  const ticks = Math.min(one.last, other.last) + 1;
  let first = { tick: ticks, robot: 0 };
  for (let robot = 0; robot < robots; robot += 1) {
    const tick = firstDifference(one.robots[robot].columns, other.robots[robot].columns, first.tick, columns);
    if (tick < first.tick) first = { tick, robot };
  }
  return first.tick < ticks || one.last !== other.last ? first : undefined;
}

/**
 * @param {import("../core/packed_columns.js").Columns} one
 * @param {import("../core/packed_columns.js").Columns} other
 * @param {number} ticks
 * @param {string[]} names
 */
function firstDifference(one, other, ticks, names) {
  for (const name of names) {
    const [a, b] = [one[name], other[name]];
    for (let tick = 0; tick < ticks; tick += 1) if (a[tick] !== b[tick]) ticks = tick;
  }
  return ticks;
}

/**
 * When two runs part, and what each does then.
 * @param {ShownRun} one
 * @param {ShownRun} other
 */
export function partingWords(one, other) {
  if (!one.data || !other.data || !one.scene) return "";
  const parting = partingOf(one.data, other.data);
  if (!parting) return `${one.name} and ${other.name} do the same to the end.`;
  const { tick, robot } = parting;
  const [a, b] = [one, other].map(({ data }) => data?.statesAt(Math.min(tick, data.last))[robot]);
  if (!a || !b) return "";
  const when = `${one.name} and ${other.name} part at ${one.scene.clock(tick)} (tick ${tick}):`;
  return `${when} ${one.name}: ${sentence(a, true)} ${other.name}: ${sentence(b, true)} ${reasonOf(a, b)}`.trim();
}

/**
 * What of what they know or feel differs.
 * @param {State} a
 * @param {State} b
 */
function reasonOf(a, b) {
  const cells = Array.from({ length: CELL_COUNT }, (_, cell) => cell).filter((cell) => a.memory[cell] !== b.memory[cell]);
  if (cells.length) return `Their memories differ: ${cells.map((cell) => PATTERNS[cell]).join(", ")}.`;
  if (a.pattern !== b.pattern) return `Their front sensors differ: ${PATTERNS[a.pattern]} and ${PATTERNS[b.pattern]}.`;
  if (a.feel !== b.feel || a.beacon !== b.beacon) return "They sense something else.";
  return "They know and feel the same: the behaviour, a parameter or chance decides.";
}
