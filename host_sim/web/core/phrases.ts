/* Puts what a robot does and why into its own words, those of robot.toml. */

import { BODY_SENTENCES, PATTERNS, REASON, SENTENCES, SIDE, SIDES } from "../generated.js";
import { REASON_KEYS } from "./palette.js";
import type { Lesson, State } from "../generated_types.js";

/** The words of a language: see Words in host_sim/recording/phrases.py. */
export type Words = { sentences: Record<string, string>; patterns: string[]; sides: string[]; point: string; many: string };

export const ENGLISH: Words = { sentences: SENTENCES, patterns: PATTERNS, sides: SIDES, point: ".", many: "Many" };

/**
 * One sentence for what a state shows.
 * @param exact - Whether to tell a step from the look around after it; in motion, both are too short to read.
 */
export function sentence(state: State, exact: boolean, words: Words = ENGLISH): string {
  const name = nameOf(state);
  const pattern = words.patterns[state.pattern];
  const turned = state.left < state.right ? SIDE.LEFT : SIDE.RIGHT;
  return filled((exact && words.sentences[`${name}_exact`]) || words.sentences[name], {
    Pattern: pattern[0].toUpperCase() + pattern.slice(1),
    side: words.sides[state.reason === REASON.TRIAL ? (state.trial?.side ?? turned) : turned], // it also stands still while it tries
    turns: state.repeat_count || words.many,
    beacon: decimal(state.beacon / 1000, 2, words),
  });
}

/** A number that is not negative, rounded half up. */
export function decimal(value: number, digits: number, words: Words = ENGLISH) {
  const unit = 10 ** digits;
  return (Math.floor(value * unit + 0.5 + 1e-9) / unit).toFixed(digits).replace(".", words.point);
}

function nameOf({ lifted, reason, beacon, left, right, by_hand, pattern }: State) {
  if (lifted) return "lifted";
  if (reason === REASON.AVOID && left !== right) return "look_aside";
  if (reason === REASON.TOWARD_FOOD && !beacon) return "wander";
  if (reason === REASON.REMEMBERED && by_hand[pattern]) return "remembered_told";
  return REASON_KEYS[reason].replaceAll("-", "_");
}

/** How the last trial went; empty if there was none or it is still going on. */
export function verdict({ trial }: State, words: Words = ENGLISH): string {
  if (!trial || trial.helped === null) return "";
  const helped = trial.frozen ? "helped_frozen" : "helped";
  return ofCell(trial.helped ? helped : "useless", trial, words);
}

/** A sentence for a lesson. */
export function lessonSentence(lesson: Lesson, words: Words = ENGLISH): string {
  return ofCell(["forgotten", "erased", "learned", "told"][2 * Number(lesson.side > 0) + lesson.by_hand], lesson, words);
}

/**
 * What has happened to a body, in one sentence.
 * @param what - The change, as in docs/worlds.md.
 */
export function bodySentence(what: string): string {
  const [name, ...details] = what.replace("/", " of ").split(":");
  return filled((BODY_SENTENCES as Record<string, string>)[name], details);
}

/** @param name - The name of a sentence, which is about a cell. */
function ofCell(name: string, { cell, side }: { cell: number; side: number }, { sentences, patterns, sides }: Words) {
  return filled(sentences[name], { pattern: patterns[cell], side: sides[side] });
}

/**
 * @param text - Has names in braces.
 * @param words - What to put in their places.
 */
export function filled(text: string, words: Record<string, string | number> | string[]) {
  return text.replace(/\{(\w+)\}/g, (gap, word) => `${(words as Record<string, string | number>)[word] ?? gap}`);
}

/**
 * Seconds, such as 1:05.2.
 * @param point - The decimal point.
 */
export function minutes(seconds: number, point: string) {
  const tenths = Math.round(seconds * 10);
  return `${Math.floor(tenths / 600)}:${((tenths % 600) / 10).toFixed(1).padStart(4, "0").replace(".", point)}`;
}

/** The three front sensors of a pattern as the article writes them, left to right: 010 is the front one. */
export function binary(pattern: number): string {
  return pattern.toString(2).padStart(3, "0");
}
