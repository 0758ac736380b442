/* Chooses which of several robots the panel shows: a button for each, and keys. Hidden if there is only one robot. */

import { buttonOf, byId, isForPage } from "../core/dom.js";
import { inEachLanguage, say } from "../core/language.js";
import type { Scene } from "../draw/scene.js";

const FIELDS = "select, summary, textarea, input:not([type=range])";

/** Fills the element `robots`. Keys: 1..9 for the robot of that number, [ and ] for the one before and after. */
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
