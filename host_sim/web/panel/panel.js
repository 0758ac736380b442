// @ts-check
/* What is written beside the arena: what a robot does and why, how bored it is, how the run stands. */

import { SteadyStates } from "./steady_states.js";
import { CellsView } from "./cells_view.js";
import { byId, setText } from "../core/elements.js";
import { REASON_KEYS } from "../core/palette.js";
import { REASON_NAMES, sentence, verdict } from "../core/phrases.js";

/**
 * @typedef {import("../draw/scene.js").Scene} Scene
 * @typedef {import("../types.js").Measures} Measures
 * @typedef {import("../types.js").State} State
 */

/**
 * What else is drawn in the arena, by its name in the style sheet.
 * @type {[string, string][]}
 */
const THINGS = [
  ["cone", "sensor: something is near"], ["cone-dark", "sensor: nothing is near"], ["beam", "looks for food"],
  ["food", "food"], ["eaten", "food that was eaten"], ["bar", "obstacle, wall"],
];
const MEMORY = "Memory: eight bytes, all it ever learns";

/** Fills the elements of a page that have these ids: doing why boredom facts legend cells memory-title. */
export class Panel {
  /** @param {import("./cells_view.js").OnPress} [onPress] - As in `CellsView`. */
  constructor(onPress) {
    this.cells = new CellsView(byId("cells"), onPress);
    this.legend = makeLegend(byId("legend"));
    /** @type {WeakMap<Scene, SteadyStates>} */
    this.calm = new WeakMap();
    this.reason = -1;
  }

  /**
   * Decides which states the words and the colours in the arena tell of.
   * @param {Scene} scene
   * @param {boolean} exact - Whether to tell every move.
   */
  settle(scene, exact) {
    const calm = this.calm.get(scene) ?? new SteadyStates();
    this.calm.set(scene, calm);
    scene.shown = calm.shown(scene.states, exact);
  }

  /**
   * @param {Scene} scene
   * @param {{exact: boolean, then?: number[], where?: string}} how - Whether to tell every move, and a memory to compare
   *   with, and when or where it is.
   */
  show(scene, { exact, then, where }) {
    const { state, measures } = scene;
    this.showSentence(scene.shown.get(state.node) ?? state, exact);
    this.showBoredom(state, measures);
    showFacts(scene);
    setText(byId("memory-title"), scene.states.length > 1 ? MEMORY.replace(":", ` of robot ${state.node}:`) : MEMORY);
    this.cells.show(scene, then, where);
  }

  /**
   * @param {State} state
   * @param {boolean} exact
   */
  showSentence(state, exact) {
    setText(byId("doing"), sentence(state, exact));
    setText(byId("why"), verdict(state));
    this.showReason(state.reason);
  }

  /** @param {number} reason */
  showReason(reason) {
    if (this.reason === reason) return;
    this.reason = reason;
    byId("doing").dataset.reason = REASON_KEYS[reason];
    this.legend.forEach((item, i) => item.classList.toggle("now", i === reason));
  }

  /**
   * @param {State} state
   * @param {Measures} measures
   */
  showBoredom(state, measures) {
    const count = Math.min(state.repeat_count, measures.boredom);
    const meter = byId("boredom");
    const words = `${count} of ${measures.boredom}`;
    if (byId("boredom-count").textContent === words) return;
    meter.style.setProperty("--share", `${count / measures.boredom}`);
    meter.setAttribute("aria-valuenow", `${count}`);
    meter.setAttribute("aria-valuemax", `${measures.boredom}`);
    setText(byId("boredom-count"), words);
  }
}

/**
 * How the run stands.
 * @param {Scene} scene
 */
export function showFacts(scene) {
  const { environment, state } = scene;
  const left = environment.food.length - state.eaten.reduce((sum, eaten) => sum + eaten, 0);
  setText(byId("fact-environment"), `${environment.number} of ${environment.of}`);
  setText(byId("fact-food"), `${left} of ${environment.food.length}`);
  setText(byId("fact-time"), scene.clock(state.tick));
  setText(byId("fact-seed"), `${environment.seed}`);
}

/** @param {HTMLElement} list */
function makeLegend(list) {
  const add = (/** @type {string} */ text) => {
    const item = list.appendChild(document.createElement("li"));
    item.textContent = text;
    return item;
  };
  const reasons = REASON_NAMES.map((name, reason) => {
    const item = add(name);
    item.dataset.reason = REASON_KEYS[reason];
    return item;
  });
  for (const [name, text] of THINGS) add(text).dataset.thing = name;
  return reasons;
}
