// @ts-check
/* Chooses which of several robots the panel shows: a button for each, and keys. Hidden if there is only one robot. */

import { buttonOf } from "../core/dom.js";
import { byId, isForPage } from "../core/elements.js";
import { inEachLanguage, say } from "../core/language.js";

const FIELDS = "select, summary, textarea, input:not([type=range])";

/** Fills the element `robots`. Keys: 1..9 for the robot of that number, [ and ] for the one before and after. */
export class RobotPicker {
  /**
   * @param {Scene} scene
   * @param {(node: number) => void} onPick
   */
  constructor(scene, onPick) {
    this.scene = scene;
    this.onPick = onPick;
    this.element = byId("robots");
    /** @type {HTMLButtonElement[]} */
    this.buttons = [];
    document.addEventListener("keydown", (event) => this.onKey(event));
    inEachLanguage(() => this.fill(this.buttons.map(({ value }) => Number(value))));
  }

  show() {
    const { states, node } = this.scene;
    const nodes = states.length > 1 ? states.map((state) => state.node) : [];
    if (nodes.join() !== this.buttons.map(({ value }) => value).join()) this.fill(nodes);
    for (const button of this.buttons) button.setAttribute("aria-pressed", `${button.value === `${node}`}`);
  }

  /** @param {number[]} nodes */
  fill(nodes) {
    this.element.hidden = nodes.length === 0;
    this.buttons = nodes.map((node) => this.makeButton(node));
    this.element.replaceChildren(say("robot"), ...this.buttons);
  }

  /** @param {number} node */
  makeButton(node) {
    const button = buttonOf(`${node}`, () => this.onPick(node));
    button.value = `${node}`;
    button.setAttribute("aria-label", say("robotNumber", { node }));
    return button;
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    if (this.scene.states.length < 2 || !isForPage(event, FIELDS)) return;
    const node = nodeFor(event.key, this.scene);
    if (node === undefined) return;
    event.preventDefault();
    this.onPick(node);
  }
}

/**
 * The robot that a key stands for, if it stands for one.
 * @param {string} key
 * @param {Scene} scene
 */
function nodeFor(key, { states, index }) {
  if (key === "[" || key === "]") {
    const step = key === "]" ? 1 : states.length - 1;
    return states[(index + step) % states.length].node;
  }
  return states.find(({ node }) => key === `${node}`)?.node;
}
