// @ts-check
/* The texts beside the arena: what a robot does and why, how bored it is, and the state of the run. */

import { SteadyStates } from "./steady_states.js";
import { CellsView } from "./cells_view.js";
import { made } from "../core/dom.js";
import { byId, setText } from "../core/elements.js";
import { REASON_KEYS } from "../core/palette.js";
import { inEachLanguage, nameIn, robotWords, say } from "../core/language.js";
import { sentence, verdict } from "../core/phrases.js";

/**
 * What else is drawn in the arena, by its name in the style sheet.
 * @type {[string, import("../core/language.js").Key][]}
 */
const THINGS = [
  ["cone", "thingCone"], ["cone-dark", "thingConeDark"], ["beam", "thingBeam"], ["food", "thingFood"], ["eaten", "thingEaten"],
  ["bar", "thingBar"],
];

/** Fills the elements of a page that have these ids: doing why boredom-meter facts legend to-legend cells memory-title. */
export class Panel {
  /** @param {import("./cells_view.js").OnPress} [onPress] - As in `CellsView`. */
  constructor(onPress) {
    this.cells = new CellsView(byId("cells"), onPress);
    /** @type {HTMLElement[]} */
    this.legend = [];
    inEachLanguage(() => this.fillLegend(byId("legend")));
    byId("to-legend").addEventListener("click", () => byId("reference").scrollIntoView({ block: "end" }));
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
    const { node } = scene.state;
    const state = scene.shown.get(node) ?? scene.state;
    this.showSentence(state, exact);
    this.showBoredom(state, scene.measures);
    showFacts(scene);
    setText(byId("memory-title"), say(scene.states.length > 1 ? "memoryOf" : "memory", { node }));
    this.cells.show(scene, state, { then, where });
  }

  /**
   * @param {State} state
   * @param {boolean} exact
   */
  showSentence(state, exact) {
    setText(byId("doing"), sentence(state, exact, robotWords()));
    setText(byId("why"), verdict(state, robotWords()));
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
    const meter = byId("boredom-meter");
    const words = say("ofCount", { count, all: measures.boredom });
    if (byId("boredom-count").textContent === words) return;
    meter.style.setProperty("--share", `${count / measures.boredom}`);
    meter.setAttribute("aria-valuenow", `${count}`);
    meter.setAttribute("aria-valuemax", `${measures.boredom}`);
    setText(byId("boredom-count"), words);
  }

  /** @param {HTMLElement} list */
  fillLegend(list) {
    this.legend = REASON_KEYS.map((key) => made("li", [nameIn("reasons", key)], { "data-reason": key }));
    list.replaceChildren(...this.legend, ...THINGS.map(([name, key]) => made("li", [say(key)], { "data-thing": name })));
    this.reason = -1;
  }
}

/** @param {Scene} scene */
export function showFacts(scene) {
  const { environment, state } = scene;
  const left = environment.food.length - state.eaten.reduce((sum, eaten) => sum + eaten, 0);
  setText(byId("fact-environment"), say("ofCount", { count: environment.number, all: environment.of }));
  setText(byId("fact-food"), say("ofCount", { count: left, all: environment.food.length }));
  setText(byId("fact-time"), scene.clock(state.tick));
  setText(byId("fact-seed"), `${environment.seed}`);
}
