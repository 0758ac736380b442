// @ts-check
/* Checks of the last lesson's goals on the conversation. */

/** @typedef {import("../talk/talk_box.js").Exchange} Exchange */

const SOON_TICKS = 50;

/**
 * Pairs of an exchange and a later one, of the same question.
 * @param {Exchange[]} history
 */
function repeated(history) {
  return history.flatMap((one, i) => history.slice(i + 1).filter((other) => isSame(one, other)).map((other) => ({ one, other })));
}

/**
 * @param {Exchange} one
 * @param {Exchange} other
 */
function isSame(one, other) {
  const [a, b] = [one, other].map(({ sentence }) => sentence.toUpperCase().match(/[\p{L}\p{N}]+/gu)?.join(" "));
  return a !== undefined && a === b;
}

/**
 * Whether ELIZA and a robot were asked the same, and only the robot knew.
 * @param {TalkBox} talk
 */
export function tellsKnowingFromSaying({ history }) {
  const isEliza = (/** @type {Exchange} */ { who }) => who.startsWith("eliza");
  return repeated(history).some(({ one, other }) =>
    isEliza(one) !== isEliza(other) && [one, other].every((it) => (it.said.mark === "words") === isEliza(it)));
}

/**
 * @param {TalkBox} talk
 * @param {string} who - The first letters of a speaker.
 */
export function wasAsked({ history }, who) {
  return history.some((exchange) => exchange.who.startsWith(who));
}

/** @param {TalkBox} talk */
export function repeatsWhatItWasTaught({ history, taught }) {
  return history.some(({ said }) => said.mark === "words" && taught.has(said.text));
}

/**
 * Whether the robot told from its log what it had told otherwise at the same time, before the run was changed.
 * @param {TalkBox} talk
 */
export function changedAnswer({ history }) {
  return repeated(history).some(({ one, other }) =>
    one.who === other.who && one.said.mark === "log" && other.said.mark === "log" && one.said.text !== other.said.text
    && (other.changes ?? 0) > (one.changes ?? 0) && Math.abs((other.tick ?? 0) - (one.tick ?? 0)) <= SOON_TICKS);
}
