// @ts-check
/* What is written beside the arena: what a robot does and why, how bored it is, how the run stands. */

import { CellsView } from "./cells_view.js";
import { byId, setText } from "./elements.js";
import { REASON } from "./generated.js";
import { REASON_KEYS } from "./palette.js";
import { REASON_NAMES, clock, sentence, verdict } from "./phrases.js";

/**
 * @typedef {import("./scene.js").Scene} Scene
 * @typedef {import("./types.js").Measures} Measures
 * @typedef {import("./types.js").State} State
 */

/** A sentence stays this long before one that matters less: people read more slowly than robots decide. */
const HOLD_MS = 700;
/** How much each reason matters. */
const LIFTED_WEIGHT = 9;
const WEIGHT = new Map([
  [REASON.STOP, 0], [REASON.WANDER, 1], [REASON.TOWARD_FOOD, 2], [REASON.LOOK_AROUND, 1],
  [REASON.REMEMBERED, 3], [REASON.TRIAL, 4], [REASON.BOREDOM, 5], [REASON.EAT, 5],
]);
const MEMORY = "Memory: eight bytes, all it ever learns";

/** Fills the elements of a page that have these ids: doing why boredom facts legend cells memory-title. */
export class Panel {
  /** @param {import("./cells_view.js").OnPress} [onPress] - As in `CellsView`. */
  constructor(onPress) {
    this.cells = new CellsView(byId("cells"), onPress);
    this.legend = makeLegend(byId("legend"));
    this.held = { node: -1, weight: -1, until: 0 };
    this.reason = -1;
  }

  /**
   * @param {Scene} scene
   * @param {{exact: boolean, then?: number[]}} how - Whether to tell every move, and a memory to compare with.
   */
  show(scene, { exact, then }) {
    const { state, measures } = scene;
    this.showSentence(state, exact);
    this.showBoredom(state, measures);
    this.showFacts(scene);
    setText(byId("memory-title"), scene.states.length > 1 ? MEMORY.replace(":", ` of robot ${state.node}:`) : MEMORY);
    this.cells.show(state, measures, then);
  }

  /**
   * @param {State} state
   * @param {boolean} exact
   */
  showSentence(state, exact) {
    const now = performance.now();
    const weight = (state.lifted ? LIFTED_WEIGHT : WEIGHT.get(state.reason)) ?? 0;
    const holds = state.node === this.held.node && weight < this.held.weight && now < this.held.until;
    if (!exact && holds) return;
    this.held = { node: state.node, weight, until: now + HOLD_MS };
    setText(byId("doing"), sentence(state, exact));
    setText(byId("why"), verdict(state));
    this.showReason(!exact && state.reason === REASON.LOOK_AROUND ? REASON.WANDER : state.reason);
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

  /** @param {Scene} scene */
  showFacts({ environment, state, measures }) {
    const left = environment.food.length - state.eaten.reduce((sum, eaten) => sum + eaten, 0);
    setText(byId("fact-environment"), `${environment.number} of ${environment.of}`);
    setText(byId("fact-food"), `${left} of ${environment.food.length}`);
    setText(byId("fact-time"), clock(state.tick, measures));
    setText(byId("fact-seed"), `${environment.seed}`);
  }
}

/** @param {HTMLElement} list */
function makeLegend(list) {
  return REASON_NAMES.map((name, reason) => {
    const item = list.appendChild(document.createElement("li"));
    item.textContent = name;
    item.dataset.reason = REASON_KEYS[reason];
    return item;
  });
}
