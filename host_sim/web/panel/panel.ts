/* The texts beside the arena: what a robot does and why, how bored it is, and the state of the run; and which robot is meant. */

import { CellsView } from "./cells_view.js";
import { buttonOf, byId, isForPage, made, setText } from "../core/dom.js";
import { REASON_KEYS } from "../core/palette.js";
import { inEachLanguage, nameIn, robotWords, say } from "../core/language.js";
import { sentence, verdict } from "../core/phrases.js";
import { REASON } from "../generated.js";
import type { Key } from "../core/language.js";
import type { Scene } from "../draw/scene.js";
import type { Measures, State } from "../generated_types.js";
import type { OnPress } from "./cells_view.js";

/** What else is drawn in the arena, by its name in the style sheet. */
const THINGS: [string, Key][] = [
  ["cone", "thingCone"], ["cone-dark", "thingConeDark"], ["beam", "thingBeam"], ["food", "thingFood"], ["eaten", "thingEaten"],
  ["bar", "thingBar"],
];

/** A sentence with more characters is written smaller: it must not move what stands below. */
const SHORT_MAX = 56;

/** Fills the elements of a page that have these ids: doing why boredom-meter facts legend to-legend cells memory-title. */
export class Panel {
  cells = new CellsView(byId("cells"), this.onPress);
  legend: HTMLElement[] = [];
  calm: WeakMap<Scene, SteadyStates> = new WeakMap();
  reason = -1;

  /** @param onPress - As in `CellsView`. */
  constructor(readonly onPress: OnPress) {
    inEachLanguage(() => this.fillLegend(byId("legend")));
    byId("to-legend").addEventListener("click", () => byId("reference").scrollIntoView({ block: "end" }));
  }

  /**
   * Decides which states the words and the colours in the arena tell of.
   * @param exact - Whether to tell every move.
   */
  settle(scene: Scene, exact: boolean) {
    const calm = this.calm.get(scene) ?? new SteadyStates();
    this.calm.set(scene, calm);
    scene.shown = calm.shown(scene.states, exact);
  }

  /** @param how - Whether to tell every move, and a memory to compare with, and when or where it is. */
  show(scene: Scene, { exact, then, where }: { exact: boolean; then?: number[]; where?: string }) {
    const { node } = scene.state;
    const state = scene.shown.get(node) ?? scene.state;
    this.showSentence(state, exact);
    this.showBoredom(state, scene.measures);
    showFacts(scene);
    setText(byId("memory-title"), say(scene.states.length > 1 ? "memoryOf" : "memory", { node }));
    this.cells.show(scene, state, { then, where });
  }

  showSentence(state: State, exact: boolean) {
    const doing = sentence(state, exact, robotWords());
    setText(byId("doing"), doing);
    byId("doing").classList.toggle("long", doing.length > SHORT_MAX);
    setText(byId("why"), verdict(state, robotWords()));
    this.showReason(state.reason);
  }

  showReason(reason: number) {
    if (this.reason === reason) return;
    this.reason = reason;
    byId("doing").dataset.reason = REASON_KEYS[reason];
    this.legend.forEach((item, i) => item.classList.toggle("now", i === reason));
  }

  showBoredom(state: State, measures: Measures) {
    const count = Math.min(state.repeat_count, measures.boredom);
    const meter = byId("boredom-meter");
    const words = say("ofCount", { count, all: measures.boredom });
    if (byId("boredom-count").textContent === words) return;
    meter.style.setProperty("--share", `${count / measures.boredom}`);
    meter.setAttribute("aria-valuenow", `${count}`);
    meter.setAttribute("aria-valuemax", `${measures.boredom}`);
    setText(byId("boredom-count"), words);
  }

  fillLegend(list: HTMLElement) {
    this.legend = REASON_KEYS.map((key) => made("li", [nameIn("reasons", key)], { "data-reason": key }));
    list.replaceChildren(...this.legend, ...THINGS.map(([name, key]) => made("li", [say(key)], { "data-thing": name })));
    this.reason = -1;
  }
}

function showFacts(scene: Scene) {
  const { environment, state } = scene;
  const left = environment.food.length - state.eaten.reduce((sum, eaten) => sum + eaten, 0);
  setText(byId("fact-environment"), say("ofCount", { count: environment.number, all: environment.of }));
  setText(byId("fact-food"), say("ofCount", { count: left, all: environment.food.length }));
  setText(byId("fact-time"), scene.clock(state.tick));
  setText(byId("fact-seed"), `${environment.seed}`);
}

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
class SteadyStates {
  held: Map<number, { state: State; weight: number; until: number }> = new Map();

  /**
   * @param states - As they are.
   * @param exact - Whether to show every move.
   */
  shown(states: State[], exact: boolean): Map<number, State> {
    const now = performance.now();
    return new Map(states.map((state) => [state.node, exact ? this.take(state, now) : this.calm(state, now)]));
  }

  calm(state: State, now: number) {
    const held = this.held.get(state.node);
    if (held && weightOf(state) < held.weight && now < held.until) return held.state;
    return this.take(state.reason === REASON.LOOK_AROUND ? { ...state, reason: REASON.WANDER } : state, now);
  }

  take(state: State, now: number) {
    this.held.set(state.node, { state, weight: weightOf(state), until: now + HOLD_MS });
    return state;
  }
}

function weightOf(state: State) {
  return (state.lifted ? LIFTED_WEIGHT : WEIGHT.get(state.reason)) ?? 0;
}

/** Fields that use the keys themselves. */
const FIELDS = "select, summary, textarea, input:not([type=range])";

/**
 * Chooses which of several robots the panel shows; hidden if there is only one. Fills the element `robots`. Keys: 1..9 for the robot of that number, [ and ] for the one before
 * and after.
 */
export class RobotPicker {
  element = byId("robots");
  buttons: HTMLButtonElement[] = [];

  constructor(public scene: Scene, readonly onPick: (node: number) => void) {
    document.addEventListener("keydown", (event) => this.onKey(event));
    inEachLanguage(() => this.fill(this.buttons.map(({ value }) => Number(value))));
  }

  show() {
    const { states, node } = this.scene;
    const nodes = states.length > 1 ? states.map((state) => state.node) : [];
    if (nodes.join() !== this.buttons.map(({ value }) => value).join()) this.fill(nodes);
    for (const button of this.buttons) button.setAttribute("aria-pressed", `${button.value === `${node}`}`);
  }

  fill(nodes: number[]) {
    this.element.hidden = nodes.length === 0;
    this.buttons = nodes.map((node) => this.makeButton(node));
    this.element.replaceChildren(say("robot"), ...this.buttons);
  }

  makeButton(node: number) {
    const button = buttonOf(`${node}`, () => this.onPick(node));
    button.value = `${node}`;
    button.setAttribute("aria-label", say("robotNumber", { node }));
    return button;
  }

  onKey(event: KeyboardEvent) {
    if (this.scene.states.length < 2 || !isForPage(event, FIELDS)) return;
    const node = nodeFor(event.key, this.scene);
    if (node === undefined) return;
    event.preventDefault();
    this.onPick(node);
  }
}

/** The robot that a key stands for, if it stands for one. */
function nodeFor(key: string, { states, index }: Scene) {
  if (key === "[" || key === "]") {
    const step = key === "]" ? 1 : states.length - 1;
    return states[(index + step) % states.length].node;
  }
  return states.find(({ node }) => key === `${node}`)?.node;
}
