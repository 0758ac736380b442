/* Records a run as it is simulated, in the form in which a recorded run is shown. */

import { CELL_COUNT, COLUMNS, REASON, ROW, SENTENCES } from "../generated.js";
import { AXES } from "./native_run.js";
import { bodySentence } from "../core/phrases.js";
import type { Columns } from "../core/packed_columns.js";
import type { EnvironmentScene, Lesson, Measures, Trial } from "../generated_types.js";
import type { EventKind, RobotRun, Run, News, WorldEdit } from "../types.js";
import type { NativeRun } from "./native_run.js";

/** A block of one robot's ticks, in the order of native/page.h. */
type Block = { ticks: number; rows: Int16Array; poses: Float64Array };

/** A tick, and how sure a robot is of each cell from then on. */
export type Beads = [number, number[]][];

/** A run, with the columns and the beads of each robot. */
type Recorded = { run: Run; columns: Columns[]; beads: Beads[] };

/** The scales of x, y and heading in a column. */
const SCALES = [["x", 10], ["y", 10], ["heading", 1000]] as const;
const NAMES = ["x", "y", "heading", ...Object.keys(COLUMNS)];
const EAT = ROW.indexOf("eat");
const FIRST_ROOM = 1 << 13;
const SIDE_BITS = 2;

/** Its `tracks` record the blocks of one robot each. */
export class RunRecorder {
  tracks = this.robots.map((robot) => new Track(this.native, robot));
  scenes: [number, EnvironmentScene][] = [];
  eaten: [number, number[]][] = [];
  edits: Edited[] = [];

  constructor(readonly measures: Measures, readonly native: NativeRun, readonly robots: number[]) {}

  /** Number of ticks so far. */
  get ticks() {
    return this.tracks[0].ticks;
  }

  /** The next tick begins an environment, or is the first one after a change of it. */
  enter(scene: EnvironmentScene) {
    const before = this.scenes.at(-1)?.[1];
    if (before?.first_tick !== scene.first_tick || before.number !== scene.number) {
      note(this.eaten, this.ticks, scene.food.map(() => 0));
    }
    if (this.scenes.at(-1)?.[0] === this.ticks) this.scenes.pop();
    this.scenes.push([this.ticks, scene]);
  }

  /** @param eaten - After the last tick: for each piece, 1 if it is gone. */
  eat(eaten: number[]) {
    if (eaten.join() === this.eaten.at(-1)?.[1].join()) return;
    note(this.eaten, this.ticks - 1, eaten);
    for (const track of this.tracks) if (track.eats) track.meals.push(this.ticks - 1);
  }

  /** All that was recorded, as it is now. */
  result(title: string): Recorded {
    const { measures, ticks, scenes, eaten } = this;
    const begun = scenes.filter(([, { number }], i) => number !== (scenes[i - 1]?.[1].number ?? 0));
    const news = newsOf(this.edits, this.tracks.length);
    const changes = [...new Set(news.map(([tick]) => tick))];
    const robots = this.tracks.map((track) => track.result(begun.map(([tick]) => tick), changes));
    const run = { version: 3, title, measures, first_tick: 0, ticks, scenes, news, eaten, robots };
    return { run, columns: this.tracks.map((track) => track.trimmed()), beads: this.tracks.map((track) => track.beads) };
  }
}

/** One robot's part of it. */
class Track {
  node = this.robot + 1;
  history = new LearningHistory(this.native, this.robot);
  ticks = 0;
  eats = false;
  columns: Columns = Object.fromEntries(NAMES.map((name) => [name, new Int32Array(FIRST_ROOM)]));
  memory: RobotRun["memory"] = [[0, this.native.sides(this.robot)]];
  beads: Beads = [[0, this.sureness]];
  trials: RobotRun["trials"] = [[0, null]];
  begun: Note[] = [];
  meals: number[] = [];

  constructor(readonly native: NativeRun, readonly robot: number) {}

  /** How sure the robot is of each cell, where its behaviour keeps that: in the bits above those of the side. */
  get sureness() {
    return this.native.memory(this.robot).map((cell) => cell >> SIDE_BITS);
  }

  /** @param tick - Of what its memory holds now. */
  remember(tick: number) {
    note(this.memory, tick, this.native.sides(this.robot));
    note(this.beads, tick, this.sureness);
  }

  add(block: Block) {
    const notes = this.history.take(this.ticks, block.ticks);
    for (const { tick, trial } of notes) note(this.trials, tick, trial);
    this.begun.push(...notes);
    this.eats = block.rows[(block.ticks - 1) * ROW.length + EAT] !== 0;
    this.append(block);
    this.remember(this.ticks - 1);
  }

  /** Notes that the robot was given a command before the next tick. */
  relearn() {
    this.history.relearn(this.ticks);
    this.remember(this.ticks);
  }

  /** Prepares for a restart of the robot: its lessons stay. */
  restart() {
    this.native.c.page_history_restart(this.robot);
    this.history.forgetCells(this.ticks);
    note(this.trials, this.ticks, null);
  }

  append({ ticks, rows, poses }: Block) {
    this.makeRoom(this.ticks + ticks);
    const { columns } = this;
    for (const [axis, [name, scale]] of SCALES.entries()) {
      for (let i = 0; i < ticks; i += 1) columns[name][this.ticks + i] = Math.round(poses[AXES * i + axis] * scale);
    }
    for (const [name, place] of Object.entries(COLUMNS)) {
      const column = columns[name];
      for (let i = 0; i < ticks; i += 1) column[this.ticks + i] = rows[ROW.length * i + place];
    }
    this.ticks += ticks;
  }

  makeRoom(ticks: number) {
    for (const name of NAMES) {
      const old = this.columns[name];
      if (old.length >= ticks) return;
      this.columns[name] = new Int32Array(2 * ticks);
      this.columns[name].set(old);
    }
  }

  /** The columns, no longer than the run. */
  trimmed() {
    return Object.fromEntries(NAMES.map((name) => [name, this.columns[name].slice(0, this.ticks)]));
  }

  /**
   * @param environments - The ticks in which they begin.
   * @param changes - The ticks in which something has changed.
   */
  result(environments: number[], changes: number[]): RobotRun {
    const { node, memory, trials, history } = this;
    const lessons = history.lessons.filter(({ tick }) => tick < this.ticks);
    const events = this.events(environments, changes);
    return { node, memory, trials, lessons, cells: history.cells, events, columns: NAMES, data: "" };
  }

  events(environments: number[], changes: number[]): [number, EventKind][] {
    const learned = this.history.lessons.filter(({ by_hand, tick }) => !by_hand && tick < this.ticks);
    const kinds: [EventKind, number[]][] = [
      ["environment", environments], ["change", changes], ["eat", this.meals],
      ["trial", this.begunFor(REASON.TRIAL)], ["boredom", this.begunFor(REASON.BOREDOM)],
      ["lesson", learned.map(({ tick }) => tick)],
    ];
    const events = kinds.flatMap(([kind, ticks]) => ticks.map((tick) => ([tick, kind] as [number, EventKind])));
    return events.sort(([a, one], [b, other]) => a - b || (one < other ? -1 : 1));
  }

  begunFor(wanted: number) {
    return this.begun.filter(({ reason }) => reason === wanted).map(({ tick }) => tick);
  }
}

/** Adds a value if it has changed; it replaces one of the same tick. */
function note<T>(changes: [number, T][], tick: number, value: T) {
  const last = changes.at(-1);
  if (last && JSON.stringify(last[1]) === JSON.stringify(value)) return;
  if (last?.[0] === tick) changes.pop();
  changes.push([tick, value]);
}

type Edited = WorldEdit & { tick: number };

const SAID: Record<string, string> = SENTENCES;
const SHOWN = ["plant", "move_plant", "grow_plant", "remove_plant", "body"];

/**
 * All that changed, in order, except what a person moved by hand.
 * @param edits - The edits that were made.
 */
function newsOf(edits: Edited[], robots: number): News[] {
  const shown = edits.filter((edit) => SHOWN.includes(edit.do));
  const news = shown.map((edit) => ([edit.tick, sentenceOf(edit, shown, robots)] as News));
  return news.filter(([tick, sentence], i) => tick !== news[i - 1]?.[0] || sentence !== news[i - 1][1]);
}

function sentenceOf(edit: Edited, edits: Edited[], robots: number) {
  if (edit.do !== "body") return SAID[edit.do];
  const { tick, what, robot = 0 } = edit;
  const alike = edits.filter((it) => it.do === "body" && it.tick === tick && it.what === what).length;
  return `${alike === robots ? "" : `Robot ${robot + 1}: `}${bodySentence(what)}`;
}

/** What is known of a cell from a tick on: tick, cell, uses, learned, by_hand. */
type Cell = RobotRun["cells"][number];

/** A turn or a trial that began, or a trial that ended; `trial` is the last one, after it. */
type Note = { tick: number; reason: number; cell: Cell; trial: Trial | null };

/** In `struct history_note` and `struct history_lesson`, as 32-bit numbers; the ticks are doubles. */
const NOTE_NUMBERS = 14;
const LESSON_NUMBERS = 4;

/** What a robot has learned, told by C: its turns and trials, and its lessons. Built from the blocks of a run, in order. */
class LearningHistory {
  lessons: Lesson[] = [];
  cells: Cell[] = [];

  constructor(readonly native: NativeRun, readonly robot: number) {
    this.forgetCells(0);
    native.c.page_history_begin(robot);
  }

  /**
   * Adds the last block.
   * @param tick - Its first one, from the start of the run.
   */
  take(tick: number, ticks: number) {
    const count = this.native.c.page_history_take(this.robot, tick);
    const notes = Array.from({ length: count }, (_, i) => this.noteAt(this.native.c.page_notes() + 4 * NOTE_NUMBERS * i));
    this.cells.push(...notes.filter(({ reason }) => reason === REASON.REMEMBERED).map(({ cell }) => cell));
    this.addLessons(tick + ticks - 1);
    return notes;
  }

  /** Makes all cells unused from a tick on, and when they were learned unknown. */
  forgetCells(tick: number) {
    for (let cell = 0; cell < CELL_COUNT; cell += 1) this.cells.push([tick, cell, 0, -1, 0]);
  }

  /**
   * Adds a lesson for each pattern whose turn has changed: it was told.
   * @param tick - The next one.
   */
  relearn(tick: number) {
    this.native.c.page_history_relearn(this.robot, tick);
    this.addLessons(tick);
  }

  /** @param tick - The tick of new lessons. */
  addLessons(tick: number) {
    const { c } = this.native;
    const numbers = this.native.numbersAt(c.page_lessons(this.robot), LESSON_NUMBERS * c.page_lesson_count(this.robot));
    for (let at = 0; at < numbers.length; at += LESSON_NUMBERS) {
      const [cell, side, uses, by_hand] = numbers.slice(at, at + LESSON_NUMBERS);
      this.lessons.push({ node: this.robot + 1, tick, cell, side, by_hand });
      this.cells.push([tick, cell, uses, tick, by_hand]);
    }
  }

  noteAt(at: number): Note {
    const [tick, , , learned, begun] = this.native.doublesAt(at, NOTE_NUMBERS / 2);
    const [, , reason, pattern, uses, by_hand, , , , , cell, side, helped, frozen] = this.native.numbersAt(at, NOTE_NUMBERS);
    const trial = begun < 0 ? null : { tick: begun, cell, side, helped: helped < 0 ? null : helped, frozen };
    return { tick, reason, cell: [tick, pattern, uses, learned, by_hand], trial };
  }
}
