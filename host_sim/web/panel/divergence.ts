/* Where two runs diverge, and why. */

import { byId, setText } from "../core/dom.js";
import { CELL_COUNT } from "../generated.js";
import { languageCode, robotWords, say } from "../core/language.js";
import { sentence } from "../core/phrases.js";
import type { Columns } from "../core/packed_columns.js";
import type { RunData } from "../core/run_data.js";
import type { State } from "../generated_types.js";
import type { ShownRun } from "../lab/shown_run.js";

const DRIVE = ["left", "right", "reason", "repeat_count", "action"];

/** Fills the element parting. */
export class DivergenceView {
  /** What was compared last: both runs, and the language of the words. */
  compared: unknown[] = [];

  /** Compares the first run with the one that is selected, or with the second. */
  show([first, ...others]: ShownRun[], selected: ShownRun) {
    const other = selected === first ? others[0] : selected;
    const compared = other ? [first.data, other.data, languageCode()] : [];
    if (compared.length === this.compared.length && compared.every((data, i) => data === this.compared[i])) return;
    this.compared = compared;
    setText(byId("parting"), other ? partingWords(first, other) : "");
  }
}

/**
 * The first tick in which a robot of one run does something else than that of another; undefined if none does.
 * @param columns - What is compared.
 */
export function partingOf(one: RunData, other: RunData, columns: string[] = DRIVE): { tick: number, robot: number } | undefined {
  const robots = Math.min(one.robots.length, other.robots.length);
  const ticks = Math.min(one.last, other.last) + 1;
  let first = { tick: ticks, robot: 0 };
  for (let robot = 0; robot < robots; robot += 1) {
    const tick = firstDifference(one.robots[robot].columns, other.robots[robot].columns, first.tick, columns);
    if (tick < first.tick) first = { tick, robot };
  }
  return first.tick < ticks || one.last !== other.last ? first : undefined;
}

function firstDifference(one: Columns, other: Columns, ticks: number, names: string[]) {
  for (const name of names) {
    const [a, b] = [one[name], other[name]];
    for (let tick = 0; tick < ticks; tick += 1) if (a[tick] !== b[tick]) ticks = tick;
  }
  return ticks;
}

/** When two runs part, and what each does then. */
function partingWords(one: ShownRun, other: ShownRun) {
  if (!one.data || !other.data || !one.scene) return "";
  const parting = partingOf(one.data, other.data);
  if (!parting) return say("sameToEnd");
  const { tick, robot } = parting;
  const ended = [one, other].find(({ data }) => data && data.last < tick);
  if (ended) return say("sameUntil", { time: one.scene.clock(tick) });
  if (one.isRecorded && tick < changedFrom(one, other)) return say("notRecorded", { time: one.scene.clock(tick) });
  const [a, b] = [one, other].map(({ data }) => data?.statesAt(Math.min(tick, data.last))[robot]);
  if (!a || !b) return "";
  const [said, otherSaid] = [a, b].map((state) => sentence(state, true, robotWords()));
  return say("partAt", { a: one.name, b: other.name, time: one.scene.clock(tick), tick, said, otherSaid, why: reasonOf(a, b) });
}

/** The first tick in which a copy of a recorded run may do something else, because a person changed it. */
function changedFrom({ experiment: { robots, changes } }: ShownRun, { experiment: copy }: ShownRun) {
  const own = copy.changes.find((change) => !changes.includes(change));
  return copy.robots === robots ? (own?.tick ?? Infinity) : 0;
}

/** What differs in their memories or senses. */
function reasonOf(a: State, b: State) {
  const { patterns } = robotWords();
  const cells = Array.from({ length: CELL_COUNT }, (_, cell) => cell).filter((cell) => a.memory[cell] !== b.memory[cell]);
  if (cells.length) return say("memoriesDiffer", { cells: cells.map((cell) => patterns[cell]).join(", ") });
  if (a.pattern !== b.pattern) return say("sensorsDiffer", { one: patterns[a.pattern], other: patterns[b.pattern] });
  if (a.feel !== b.feel || a.beacon !== b.beacon) return say("senseElse");
  return say("chanceDecides");
}
