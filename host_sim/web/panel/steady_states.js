// @ts-check
/* Holds a robot's state long enough for texts and colours to be read: people read more slowly than robots decide. */

import { REASON } from "../generated.js";

/** How long a state stays before a less important one replaces it, so that nothing flickers. */
const HOLD_MS = 700;
const LIFTED_WEIGHT = 9;
/** The importance of each reason. */
const WEIGHT = new Map([
  [REASON.STOP, 0], [REASON.WANDER, 1], [REASON.TOWARD_FOOD, 2], [REASON.LOOK_AROUND, 1],
  [REASON.REMEMBERED, 3], [REASON.TRIAL, 4], [REASON.BOREDOM, 5], [REASON.EAT, 5],
  [REASON.SILENCE, 5], [REASON.AVOID, 5], [REASON.PROGRAM, 3],
]);

/** Gives the states to show, by node. */
export class SteadyStates {
  constructor() {
    /** @type {Map<number, {state: State, weight: number, until: number}>} */
    this.held = new Map();
  }

  /**
   * @param {State[]} states - As they are.
   * @param {boolean} exact - Whether to show every move.
   * @returns {Map<number, State>}
   */
  shown(states, exact) {
    const now = performance.now();
    return new Map(states.map((state) => [state.node, exact ? this.take(state, now) : this.calm(state, now)]));
  }

  /**
   * @param {State} state
   * @param {number} now
   */
  calm(state, now) {
    const held = this.held.get(state.node);
    if (held && weightOf(state) < held.weight && now < held.until) return held.state;
    return this.take(state.reason === REASON.LOOK_AROUND ? { ...state, reason: REASON.WANDER } : state, now);
  }

  /**
   * @param {State} state
   * @param {number} now
   */
  take(state, now) {
    this.held.set(state.node, { state, weight: weightOf(state), until: now + HOLD_MS });
    return state;
  }
}

/** @param {State} state */
function weightOf(state) {
  return (state.lifted ? LIFTED_WEIGHT : WEIGHT.get(state.reason)) ?? 0;
}
