// @ts-check
/* What a robot does and why, in its own words; those of host_sim/view/phrases.py. */

import { PATTERNS, REASON, SIDE, SIDES } from "../generated.js";

/**
 * @typedef {import("../types.js").Ended} Ended
 * @typedef {import("../types.js").EnvironmentScene} EnvironmentScene
 * @typedef {import("../types.js").Lesson} Lesson
 * @typedef {import("../types.js").Measures} Measures
 * @typedef {import("../types.js").State} State
 */

const WANDERING = "Nothing in my way: I drive on and look about for food.";

/**
 * What each reason is called, and its sentence. `exact` tells a step from the look around that follows: too quick to
 * read in motion.
 * @type {[number, string, (state: State, exact: boolean) => string][]}
 */
const REASONS = [
  [REASON.STOP, "stands still", () => "I am standing still."],
  [REASON.WANDER, "wanders", (_, exact) => (exact ? "Nothing in my way: I take a step forward." : WANDERING)],
  [REASON.TOWARD_FOOD, "goes toward food", towardFood],
  [REASON.LOOK_AROUND, "looks around",
    (state, exact) => (exact ? `No food straight ahead: I look a little to the ${turnOf(state)}.` : WANDERING)],
  [REASON.REMEMBERED, "remembers", (state) => `${blocked(state)}: I remember that turning ${turnOf(state)} helped.`],
  [REASON.TRIAL, "tries",
    (state) => `${blocked(state)}: I do not know what helps yet, so I try turning ${trialSide(state)}.`],
  [REASON.BOREDOM, "is bored",
    (state) => `${state.repeat_count || "Many"} turns in a row, and still blocked. I am bored: about face!`],
  [REASON.EAT, "eats", () => "Food! I eat it."],
  [REASON.SILENCE, "hears nothing", () => "I hear nothing from my body: my wheels rest."],
  [REASON.AVOID, "avoids", ({ left, right }) => (left === right ? "I have touched something: I back off."
    : "I do not believe my front sensor: I look aside.")],
];

const SENTENCES = new Map(REASONS.map(([reason, , words]) => [reason, words]));

/** What each reason is called, in the order of the reasons. */
export const REASON_NAMES = REASONS.sort(([a], [b]) => a - b).map(([, name]) => name);

/**
 * One sentence for what a state shows.
 * @param {State} state
 * @param {boolean} exact - Whether to tell every move.
 * @returns {string}
 */
export function sentence(state, exact) {
  if (state.lifted) return "Someone has picked me up: my wheels turn in the air.";
  return SENTENCES.get(state.reason)?.(state, exact) ?? "";
}

/**
 * One sentence for how the last trial went; empty if there was none, or it still goes on.
 * @param {State} state
 * @returns {string}
 */
export function verdict({ trial }) {
  if (!trial || trial.helped === null) return "";
  const what = `Last try: ${PATTERNS[trial.cell]} blocked, I turned ${SIDES[trial.side]}.`;
  if (!trial.helped) return `${what} It did not help, so I forgot it.`;
  return `${what} It helped${trial.frozen ? ", but my learning was frozen." : ", so I remembered it!"}`;
}

/**
 * A sentence for a lesson.
 * @param {Lesson} lesson
 * @returns {string}
 */
export function lessonSentence(lesson) {
  const name = PATTERNS[lesson.cell];
  if (!lesson.side) return `${lesson.by_hand ? "Erased by hand" : "Forgotten"}: ${name}.`;
  if (!lesson.by_hand) return `Learned: ${name} blocked, turn ${SIDES[lesson.side]}.`;
  return `Told: ${name} blocked, turn ${SIDES[lesson.side]}.`;
}

/**
 * What has happened to a body, in one sentence.
 * @param {string} what - As docs/worlds.md has it.
 * @returns {string}
 */
export function bodySentence(what) {
  const [name, ...parts] = what.split(":");
  const details = parts.join(":");
  /** @type {Record<string, string>} */
  const sentences = {
    "weak-motor": `The ${parts[0]} motor turns at ${parts[1]} of its speed.`,
    odometer: `The ${parts[0]} odometer counts ${parts[1]} of its wheel's way.`,
    "swap-odometers": "The plugs of the odometers were swapped.",
    "false-beacon": `The beacon shows food ${details} mm ahead where there is none.`,
    "swap-motors": "The plugs of the motors were swapped.",
    mirror: "The ring of sensors was mounted the other way round.",
    "stuck-on": `The ${details} sensor is stuck: it always sees something.`,
    "stuck-off": `The ${details} sensor is dead: it never sees anything.`,
    noise: `Each sensor is wrong in ${details.replace("/", " of ")} ticks.`,
    repair: "The body was repaired.",
  };
  return sentences[name];
}

/**
 * How an environment ended, and after the last one how all did: a heading and a sentence.
 * @param {Ended} ended
 * @param {boolean} done - Whether it was the last one.
 * @returns {[string, string]}
 */
export function ending(ended, done) {
  const food = ended.finished ? "All food found" : `${ended.eaten} of ${ended.food} food found`;
  if (!done) return [food, `environment ${ended.number}, ${minutes(ended.robot_s)}`];
  const { environments, environments_finished, environments_robot_s } = ended;
  const all = `${environments_finished} of ${environments} environments finished`;
  return ["ALL DONE", `${all}, ${minutes(environments_robot_s)}`];
}

/**
 * What "start over" has done.
 * @param {EnvironmentScene} environment
 * @param {State[]} states
 */
export function restarted({ seed }, states) {
  const empty = states.every(({ memory }) => memory.every((side) => side === SIDE.NOTHING));
  return `Started over with seed ${seed}: ${empty ? "empty memory" : "the memory was kept"}, learning is on.`;
}

/**
 * Robot time of a tick, such as 1:05.2.
 * @param {number} tick - Counted from where the clock begins.
 * @param {Measures} measures
 * @returns {string}
 */
export function clock(tick, measures) {
  return minutes((tick * measures.tick_ms) / 1000);
}

/**
 * Seconds, such as 1:05.2.
 * @param {number} seconds
 */
export function minutes(seconds) {
  return `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(1).padStart(4, "0")}`;
}

/**
 * The three front sensors of a pattern as the article writes them, left to right: 010 is the front one.
 * @param {number} pattern
 * @returns {string}
 */
export function binary(pattern) {
  return pattern.toString(2).padStart(3, "0");
}

/** @param {State} state */
function towardFood({ beacon }) {
  return beacon ? `I see food ${(beacon / 1000).toFixed(2)} m ahead: I drive toward it.` : WANDERING;
}

/** @param {State} state */
function blocked(state) {
  const name = PATTERNS[state.pattern];
  return `${name[0].toUpperCase()}${name.slice(1)} blocked`;
}

/** @param {State} state */
function turnOf(state) {
  return SIDES[state.left < state.right ? SIDE.LEFT : SIDE.RIGHT];
}

/** @param {State} state */
function trialSide(state) {
  return state.trial ? SIDES[state.trial.side] : turnOf(state);
}
