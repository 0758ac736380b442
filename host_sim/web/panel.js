/* What is written beside the arena: what the robot does and why, how bored it is, how the run stands. */

import { CellsView } from "./cells_view.js";
import { REASON } from "./reasons.js";
import { REASON_NAMES, clock, sentence, verdict } from "./words.js";

/** A sentence stays this long before one that matters less: people read more slowly than robots decide. */
const HOLD_MS = 700;
/** How much each reason matters. */
const LIFTED_WEIGHT = 9;
const WEIGHT = [0, 1, 2, 1, 3, 4, 5, 5];

/** Fills the elements of a page that have these ids: doing why boredom facts legend cells. */
export class Panel {
  /** @param {(cell: number, side: number) => void} [onPress] - As in `CellsView`. */
  constructor(onPress) {
    this.cells = new CellsView(byId("cells"), onPress);
    this.legend = makeLegend(byId("legend"));
    this.held = { weight: -1, until: 0 };
    this.texts = {};
  }

  /**
   * @param {import("./renderer.js").Scene} scene
   * @param {{exact: boolean, then?: number[]}} how - Whether to tell every move, and a memory to compare with.
   */
  show(scene, { exact, then }) {
    const { state, measures } = scene;
    this.say(state, exact);
    this.showBoredom(state, measures);
    this.showFacts(scene);
    this.cells.show(state, measures, then);
  }

  /** Writes into an element, if that changes anything. */
  write(id, text) {
    if (this.texts[id] !== text) byId(id).textContent = text;
    this.texts[id] = text;
  }

  say(state, exact) {
    const now = performance.now();
    const weight = state.lifted ? LIFTED_WEIGHT : WEIGHT[state.reason];
    if (!exact && weight < this.held.weight && now < this.held.until) return;
    this.held = { weight, until: now + HOLD_MS };
    this.write("doing", sentence(state, exact));
    this.write("why", verdict(state));
    this.showReason(!exact && state.reason === REASON.lookAround ? REASON.wander : state.reason);
  }

  showReason(reason) {
    if (this.reason === reason) return;
    this.reason = reason;
    byId("doing").dataset.reason = reason;
    this.legend.forEach((item, i) => item.classList.toggle("now", i === reason));
  }

  showBoredom(state, measures) {
    const count = Math.min(state.repeat_count, measures.boredom);
    const meter = byId("boredom");
    if (this.count === count) return;
    this.count = count;
    meter.style.setProperty("--share", count / measures.boredom);
    meter.setAttribute("aria-valuenow", count);
    meter.setAttribute("aria-valuemax", measures.boredom);
    this.write("boredom-count", `${count} of ${measures.boredom}`);
  }

  showFacts({ environment, state, measures }) {
    const left = environment.food.length - state.eaten.reduce((sum, eaten) => sum + eaten, 0);
    this.write("fact-environment", `${environment.number} of ${environment.of}`);
    this.write("fact-food", `${left} of ${environment.food.length}`);
    this.write("fact-time", clock(state.tick, measures));
    this.write("fact-seed", `${environment.seed}`);
  }
}

/** The element with an id. */
export function byId(id) {
  return document.getElementById(id);
}

function makeLegend(list) {
  return REASON_NAMES.map((name, reason) => {
    const item = list.appendChild(document.createElement("li"));
    item.textContent = name;
    item.dataset.reason = reason;
    return item;
  });
}
