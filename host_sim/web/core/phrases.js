// @ts-check
/* Puts what a robot does and why into its own words, those of robot.toml. */

import { BODY_SENTENCES, PATTERNS, REASON, SENTENCES, SIDE, SIDES } from "../generated.js";
import { REASON_KEYS } from "./palette.js";

/**
 * The words of a language: see Words in host_sim/recording/phrases.py.
 * @typedef {{sentences: Record<string, string>, patterns: string[], sides: string[], point: string, many: string}} Words
 */

/** @type {Words} */
export const ENGLISH = { sentences: SENTENCES, patterns: PATTERNS, sides: SIDES, point: ".", many: "Many" };

/**
 * One sentence for what a state shows.
 * @param {State} state
 * @param {boolean} exact - Whether to tell a step from the look around that follows: too quick to read in motion.
 * @param {Words} [words]
 * @returns {string}
 */
export function sentence(state, exact, words = ENGLISH) {
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

/**
 * A number that is not negative, rounded half up.
 * @param {number} value
 * @param {number} digits
 * @param {Words} [words]
 */
export function decimal(value, digits, words = ENGLISH) {
  const unit = 10 ** digits;
  return (Math.floor(value * unit + 0.5 + 1e-9) / unit).toFixed(digits).replace(".", words.point);
}

/** @param {State} state */
function nameOf({ lifted, reason, beacon, left, right, by_hand, pattern }) {
  if (lifted) return "lifted";
  if (reason === REASON.AVOID && left !== right) return "look_aside";
  if (reason === REASON.TOWARD_FOOD && !beacon) return "wander";
  if (reason === REASON.REMEMBERED && by_hand[pattern]) return "remembered_told";
  return REASON_KEYS[reason].replaceAll("-", "_");
}

/**
 * How the last trial went; empty if there was none or it is still going on.
 * @param {State} state
 * @param {Words} [words]
 * @returns {string}
 */
export function verdict({ trial }, words = ENGLISH) {
  if (!trial || trial.helped === null) return "";
  const helped = trial.frozen ? "helped_frozen" : "helped";
  return ofCell(trial.helped ? helped : "useless", trial, words);
}

/**
 * A sentence for a lesson.
 * @param {Lesson} lesson
 * @param {Words} [words]
 * @returns {string}
 */
export function lessonSentence(lesson, words = ENGLISH) {
  return ofCell(["forgotten", "erased", "learned", "told"][2 * Number(lesson.side > 0) + lesson.by_hand], lesson, words);
}

/**
 * What has happened to a body, in one sentence.
 * @param {string} what - As docs/worlds.md has it.
 * @returns {string}
 */
export function bodySentence(what) {
  const [name, ...details] = what.replace("/", " of ").split(":");
  return filled(/** @type {Record<string, string>} */ (BODY_SENTENCES)[name], details);
}

/**
 * @param {string} name - Of a sentence.
 * @param {{cell: number, side: number}} which
 * @param {Words} words
 */
function ofCell(name, { cell, side }, { sentences, patterns, sides }) {
  return filled(sentences[name], { pattern: patterns[cell], side: sides[side] });
}

/**
 * @param {string} text - With words in braces,
 * @param {Record<string, string | number> | string[]} words - and what they stand for.
 */
export function filled(text, words) {
  return text.replace(/\{(\w+)\}/g, (gap, word) => `${/** @type {Record<string, string | number>} */ (words)[word] ?? gap}`);
}

/**
 * Robot time of a tick, such as 1:05.2.
 * @param {number} tick - Counted from where the clock begins.
 * @param {Measures} measures
 * @param {string} [point] - The decimal point.
 * @returns {string}
 */
export function clock(tick, measures, point) {
  return minutes((Math.max(0, tick) * measures.tick_ms) / 1000, point);
}

/**
 * Seconds, such as 1:05.2.
 * @param {number} seconds
 * @param {string} [point] - The decimal point.
 */
export function minutes(seconds, point = ".") {
  const tenths = Math.round(seconds * 10);
  return `${Math.floor(tenths / 600)}:${((tenths % 600) / 10).toFixed(1).padStart(4, "0").replace(".", point)}`;
}

/**
 * The three front sensors of a pattern as the article writes them, left to right: 010 is the front one.
 * @param {number} pattern
 * @returns {string}
 */
export function binary(pattern) {
  return pattern.toString(2).padStart(3, "0");
}
