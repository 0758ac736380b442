/* What the robot does and why, in its own words. */

/** Names of the eight patterns of the front sensors. */
export const PATTERN_NAMES = [
  "nothing", "front-right", "front", "front and front-right",
  "front-left", "front-left and front-right", "front-left and front", "all three",
];
export const SIDE_NAMES = ["nothing", "left", "right"];
export const REASON_NAMES = [
  "stands still", "wanders", "goes toward food", "looks around", "remembers", "tries", "is bored", "eats",
];

const LEFT = 1;
const RIGHT = 2;

/**
 * One sentence for what a state shows.
 * @param {Object} state - As in host_sim/view/state.py.
 * @param {boolean} exact - Whether to tell a step from the look around that follows: too quick to read in motion.
 * @returns {string}
 */
export function sentence(state, exact) {
  if (state.lifted) return "Someone has picked me up: my wheels turn in the air.";
  return SENTENCES[state.reason](state, exact);
}

const SENTENCES = [
  () => "I am standing still.",
  (state, exact) => (exact ? "Nothing in my way: I take a step forward." : WANDERING),
  (state) => `I see food${state.beacon ? ` ${metres(state.beacon)} ahead` : ""}: I drive toward it.`,
  (state, exact) => (exact ? `No food straight ahead: I look a little to the ${turnOf(state)}.` : WANDERING),
  (state) => `${blocked(state)}: I remember that turning ${turnOf(state)} helped.`,
  (state) => `${blocked(state)}: I do not know what helps yet, so I try turning ${trialSide(state)}.`,
  (state) => `${state.repeat_count} turns in a row, and still blocked. I am bored: about face!`,
  () => "Food! I eat it.",
];

const WANDERING = "Nothing in my way: I drive on and look about for food.";

/**
 * One sentence for how the last trial went; empty if there was none, or it still goes on.
 * @param {Object} state
 * @returns {string}
 */
export function verdict(state) {
  const trial = state.trial;
  if (!trial || trial.helped === null) return "";
  const what = `Last try: ${PATTERN_NAMES[trial.cell]} blocked, I turned ${SIDE_NAMES[trial.side]}.`;
  if (!trial.helped) return `${what} It did not help, so I forget it.`;
  return `${what} It helped${state.frozen ? ", but I may not learn now." : ", so I remember it!"}`;
}

/**
 * A sentence for a lesson.
 * @param {Object} lesson - As in host_sim/view/history.py.
 * @returns {string}
 */
export function lessonWords(lesson) {
  const name = PATTERN_NAMES[lesson.cell];
  if (!lesson.by_hand) return `Learned: ${name} blocked, turn ${SIDE_NAMES[lesson.side]}.`;
  if (!lesson.side) return `Erased by hand: ${name}.`;
  return `Written by hand: ${name} blocked, turn ${SIDE_NAMES[lesson.side]}.`;
}

/** Robot time of a tick, such as 1:05.2. */
export function clock(tick, measures) {
  const seconds = (tick * measures.tick_ms) / 1000;
  return `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(1).padStart(4, "0")}`;
}

function blocked(state) {
  const name = PATTERN_NAMES[state.pattern];
  return `${name[0].toUpperCase()}${name.slice(1)} blocked`;
}

function turnOf(state) {
  return SIDE_NAMES[state.left < state.right ? LEFT : RIGHT];
}

function trialSide(state) {
  return state.trial ? SIDE_NAMES[state.trial.side] : turnOf(state);
}

function metres(mm) {
  return `${(mm / 1000).toFixed(2)} m`;
}
