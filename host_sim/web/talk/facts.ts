/* What a robot on a page knows of its run up to a tick. host_sim/talk/facts.py explains each fact. */

import { AVOIDING, REASON, SIDE } from "../generated.js";
import { decimal, filled, lessonSentence, sentence, verdict } from "../core/phrases.js";
import type { Words } from "../core/phrases.js";
import type { RunData } from "../core/run_data.js";
import type { Lesson } from "../generated_types.js";
import type { Known } from "./eliza.js";

type Spoken = { right: string[]; left: string[]; front: string[]; all: string[]; turns: string[] };

/** The words of a language, as in host_sim/talk/texts.py. */
export type Texts = { words: Words; facts: Record<string, string>; spoken: Spoken; joined: string[] | null };

/**
 * What a log has of a robot besides its ticks: the ticks from which it had a behaviour, and its reports on the bus.
 */
type Told = { starts: [number, string][]; health: [number, Record<string, number>][] };

export const POINT = "\u00b7";
const BITS = { turns: 0, all: 7, right: 1, left: 4, front: 2 };
const SECONDS = new RegExp(`[0-9]{1,9}(?:${POINT}[0-9]{1,3})?`);
const MOVES = Object.values(REASON).filter((reason) => reason !== REASON.STOP);
const LAST = 3;

/** The facts of one robot up to a tick: each public method is one. */
export class RobotFacts {
  /** @param about - The robots are counted from 0. */
  constructor(about: { data: RunData; robot: number; tick: number; told: Told }, texts: Texts) {
    this.#about = about;
    this.#texts = texts;
    this.#now = this.#stateAt(about.tick);
  }

  #about;
  #texts;
  #now;

  learned() {
    return this.#eachCell("learned");
  }

  sure() {
    return this.#eachCell("sure");
  }

  cell(words: string[]) {
    const cell = cellIn(words, this.#texts.spoken);
    if (!cell) return null;
    const { learned, by_hand, memory } = this.#now;
    const how = learned[cell] < 0 ? "start" : by_hand[cell] ? "told" : "learned";
    const since = this.#say(`since_${how}`, { at: this.#seconds(learned[cell]) });
    return this.#known(this.#ofCell(memory[cell] ? "cell" : "cell_none", cell, { since }), [learned[cell]], [cell]);
  }

  why(words: string[]) {
    return this.#reason(words, this.#begun(MOVES));
  }

  turn(words: string[]) {
    const { left, right } = this.#texts.spoken;
    const spoken = (names: string[]) => words.some((word) => names.includes(word));
    const wanted = spoken(left) ? SIDE.LEFT : spoken(right) ? SIDE.RIGHT : SIDE.NOTHING;
    const { left: one, right: other } = this.#track.columns;
    const sideAt = (place: number) => (one[place] < other[place] ? SIDE.LEFT : SIDE.RIGHT);
    const { first } = this.#about.data;
    return this.#reason(words, this.#begun(AVOIDING).filter((tick) => !wanted || sideAt(tick - first) === wanted));
  }

  bored() {
    const { repeat_count: count } = this.#now;
    return this.#counted("bored", this.#begun([REASON.BOREDOM]), { count, limit: this.#about.data.measures.boredom });
  }

  food() {
    const { eaten } = this.#now;
    const all = eaten.map((_, piece) => piece);
    const gone = all.filter((piece) => eaten[piece]);
    const meals = this.#track.run.events.flatMap(([tick, kind]) => (kind === "eat" && tick <= this.#about.tick ? [tick] : []));
    const known = this.#counted("food", meals, { eaten: gone.length, pieces: eaten.length });
    return { ...known, food: gone.length ? gone : all };
  }

  where() {
    const { x, y } = this.#track.columns;
    const { body } = this.#about.data.measures;
    let way = 0;
    for (let i = 1; i <= this.#about.tick - this.#about.data.first; i += 1) {
      const [dx, dy] = [(x[i] - x[i - 1]) / 10, (y[i] - y[i - 1]) / 10];
      const step = Math.sqrt(dx * dx + dy * dy);
      if (step < body) way += step;
    }
    const now = this.#now;
    return this.#known(this.#say("where", { x: this.#metres(now.x, 2), y: this.#metres(now.y, 2), way: this.#metres(way, 1) }));
  }

  touched() {
    const { bump } = this.#track.columns;
    return this.#counted("touched", this.#ticks((i) => bump[i] > (i ? bump[i - 1] : 0)));
  }

  forgotten() {
    return this.#noted("forgotten", ({ side, by_hand }) => !side && !by_hand);
  }

  told() {
    return this.#noted("told", ({ by_hand }) => Boolean(by_hand));
  }

  tried() {
    return this.#counted("tried", this.#begun([REASON.TRIAL]), { verdict: verdict(this.#now, this.#texts.words) });
  }

  sees() {
    const { feel, beacon } = this.#now;
    const cell = (feel >> 1) & 7;
    const food = beacon ? this.#say("sees_food", { beacon: this.#metres(beacon, 2) }) : this.#say("sees_none");
    const text = this.#ofCell(cell ? "sees" : "sees_clear", cell, { food });
    return { ...this.#known(text, [], cell ? [cell] : []), food: beacon ? this.#ahead() : [] };
  }

  changed() {
    const news = (this.#about.data.run.news ?? []).filter(([tick, said]) => tick <= this.#about.tick && !said.includes("could not happen:"));
    const told = news.slice(-LAST).map(([tick, said]) => this.#say("changed_item", { at: this.#seconds(tick), news: said }));
    return this.#counted("changed", news.map(([tick]) => tick), { last: told.join(" ") });
  }

  behaviour() {
    const start = this.#about.told.starts.filter(([tick]) => tick <= this.#about.tick).at(-1);
    return start ? this.#known(this.#say("behaviour", { name: start[1] }), [start[0]]) : null;
  }

  bus() {
    const report = this.#about.told.health.filter(([tick]) => tick <= this.#about.tick).at(-1);
    return report ? this.#known(this.#say("bus", { at: this.#seconds(report[0]), ...report[1] }), [report[0]]) : null;
  }

  get #track() {
    return this.#about.data.robots[this.#about.robot];
  }

  #stateAt(tick: number) {
    return this.#about.data.statesAt(tick)[this.#about.robot];
  }

  #say(name: string, values: Record<string, string | number> = {}) {
    return filled(this.#texts.facts[name], values);
  }

  /** A fact that rests on ticks, or on the tick that is asked about if there are none. */
  #known(text: string, ticks: number[] = [], cells: number[] = []): Known {
    const rests = inOrder(ticks.filter((tick) => tick >= 0));
    return { text: text.toUpperCase(), ticks: rests.length ? rests : [this.#about.tick], cells: inOrder(cells), food: [] };
  }

  /** How often something has happened, and when last. */
  #counted(name: string, ticks: number[], values: Record<string, string | number> = {}, cells: number[] = []) {
    if (!ticks.length) return this.#known(this.#say(`${name}_none`, values));
    const times = { times: this.#times(ticks.length), at: this.#seconds(ticks[ticks.length - 1]) };
    return this.#known(this.#say(name, { ...times, ...values }), ticks, cells);
  }

  #noted(name: string, isWanted: (lesson: Lesson) => boolean) {
    const lessons = this.#track.lessonsUpTo(this.#about.tick, this.#about.data.sceneAt(this.#about.tick).start_tick).filter(isWanted);
    const said = lessons.slice(-LAST).map((lesson) =>
      this.#say("why", { at: this.#seconds(lesson.tick), sentence: lessonSentence(lesson, this.#texts.words) }));
    return this.#counted(name, lessons.map(({ tick }) => tick), { last: said.join(" ") }, lessons.map(({ cell }) => cell));
  }

  #eachCell(name: string) {
    const { memory, learned } = this.#now;
    const held = memory.flatMap((side, cell) => (cell && side ? [cell] : []));
    const said = held.map((cell) => this.#ofCell(name, cell)).join("; ");
    return this.#known(said || this.#say(`${name}_none`), learned, held);
  }

  #ofCell(name: string, cell: number, values: Record<string, string> = {}) {
    const { words } = this.#texts;
    const { memory, uses } = this.#now;
    return this.#say(name, { pattern: words.patterns[cell], side: words.sides[memory[cell]], times: this.#times(uses[cell]), ...values });
  }

  /** Why it did what it did at the time in a question or, if it names none, in the last of some ticks. */
  #reason(words: string[], begun: number[]) {
    const asked = SECONDS.exec(words.join(" "))?.[0].replace(POINT, ".");
    const { tick_ms } = this.#about.data.measures;
    const tick = asked ? Math.floor((Number(asked) * 1000) / tick_ms + 0.5) : (begun.at(-1) ?? -1);
    if (tick < this.#about.data.first || tick > this.#about.tick) return null;
    const state = this.#stateAt(tick);
    const said = this.#say("why", { at: this.#seconds(tick), sentence: sentence(state, false, this.#texts.words) });
    return this.#known(said, [tick], AVOIDING.includes(state.reason) && state.pattern ? [state.pattern] : []);
  }

  #times(count: number) {
    return this.#say(count === 1 ? "once" : "times", { count });
  }

  #seconds(tick: number) {
    return `${decimal((tick * this.#about.data.measures.tick_ms) / 1000, 2, this.#texts.words)} s`;
  }

  #metres(length_mm: number, digits: number) {
    return decimal(length_mm / 1000, digits, this.#texts.words);
  }

  /** The ticks up to now in which actions with one of the reasons began. */
  #begun(reasons: number[]) {
    const { action, reason } = this.#track.columns;
    return this.#ticks((i) => action[i] !== (i ? action[i - 1] : -1) && reasons.includes(reason[i]));
  }

  /** The ticks up to now of which something is true, by their places in the columns. */
  #ticks(isTrue: (place: number) => boolean) {
    const { first } = this.#about.data;
    const ticks = [];
    for (let i = 0; i <= this.#about.tick - first; i += 1) if (isTrue(i)) ticks.push(first + i);
    return ticks;
  }

  /** The piece of food nearest to where the robot sees one. */
  #ahead() {
    const { x, y, beacon, heading } = this.#now;
    const [ax, ay] = [x + beacon * Math.cos(heading / 1000), y + beacon * Math.sin(heading / 1000)];
    const far = this.#about.data.sceneAt(this.#about.tick).food.map(([fx, fy]) => (fx - ax) ** 2 + (fy - ay) ** 2);
    return far.length ? [far.indexOf(Math.min(...far))] : [];
  }
}

export function inOrder(numbers: number[]) {
  return [...new Set(numbers)].sort((a, b) => a - b);
}

/** The number of the pattern of front sensors that words name; 0 if they name none. */
function cellIn(words: string[], spoken: Spoken) {
  let said = ` ${words.join(" ")} `.replaceAll("-", " ");
  let cell = 0;
  for (const [where, names] of Object.entries(spoken)) {
    for (const name of names.filter((it) => said.includes(` ${it} `))) {
      cell |= BITS[where as keyof Spoken];
      said = said.replaceAll(` ${name} `, " ");
    }
  }
  return cell;
}
