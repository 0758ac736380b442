/* The eight cells: for each pattern its picture, what was learned, when, and how often it was used. */

import { buttonOf, made } from "../core/dom.js";
import { CELL_COUNT, REASON, SIDE, SIDES } from "../generated.js";
import { inEachLanguage, robotWords, say } from "../core/language.js";
import { binary } from "../core/phrases.js";
import { CONES, patternBit } from "../core/sensors.js";
import type { Scene } from "../draw/scene.js";
import type { State } from "../generated_types.js";

/** What a cell shows; `then` is what it held at another time, or in another run. */
type Facts = { cell: number; side: number; when: string; byHand: boolean; uses: number; inUse: boolean; trying: number; meant: boolean;
  then: number | null; where: string };

/** The elements of a cell. */
type Parts = { button: HTMLElement; name: HTMLElement; side: HTMLElement; history: HTMLElement; then: HTMLElement };

export type OnPress = (cell: number, side: number) => void;

export const SVG = "http://www.w3.org/2000/svg";
/** A cone of 45 degrees that looks up. */
const SECTOR = "M0 0 L-12.2 -29.6 A32 32 0 0 1 12.2 -29.6 Z";

/** Shows a memory in a list; its cells are buttons. */
export class CellsView {
  cells = Array.from({ length: CELL_COUNT }, (_, cell) => makeCell(this.list, cell, this.onPress));
  shown: string[] = [];

  /** @param onPress - Gets the cell that was pressed, and what it is to hold next. */
  constructor(readonly list: HTMLElement, readonly onPress: OnPress) {
    inEachLanguage(() => this.nameCells());
  }

  nameCells() {
    this.shown = [];
    this.cells.forEach(({ name, button }, cell) => {
      name.replaceChildren(made("span", [robotWords().patterns[cell]]), ` ${binary(cell)}`);
      button.title = say(cell ? "pressCell" : "nothingToLearn");
    });
  }

  /**
   * @param state - The state of its robot; the sentence describes the same state.
   * @param other - A memory to compare with, and when or where it is.
   */
  show(scene: Scene, state: State, { then, where = say("then") }: { then?: number[]; where?: string }) {
    this.cells.forEach((parts, cell) => {
      const facts = { ...factsOf(scene, state, cell), then: then ? then[cell] : null, where };
      const key = JSON.stringify(facts);
      if (this.shown[cell] !== key) fillCell(parts, facts);
      this.shown[cell] = key;
    });
  }
}

function factsOf(scene: Scene, state: State, cell: number): Omit<Facts, "then" | "where"> {
  const about = state.pattern === cell && !state.lifted;
  return {
    cell,
    side: state.memory[cell],
    when: state.learned[cell] < 0 ? "" : scene.clock(state.learned[cell]),
    byHand: Boolean(state.by_hand[cell]),
    uses: state.uses[cell],
    inUse: about && state.reason === REASON.REMEMBERED,
    trying: about && state.reason === REASON.TRIAL && state.trial ? state.trial.side : SIDE.NOTHING,
    meant: scene.meant?.cells.includes(cell) ?? false,
  };
}

function fillCell(parts: Parts, facts: Facts) {
  const { button } = parts;
  showSide(button, facts.side);
  button.classList.toggle("in-use", facts.inUse);
  button.classList.toggle("trying", facts.trying !== SIDE.NOTHING);
  button.classList.toggle("meant", facts.meant);
  button.classList.toggle("changed", facts.then !== null && facts.then !== facts.side);
  parts.side.textContent = sideWords(facts);
  parts.history.textContent = historyOf(facts);
  parts.then.textContent = facts.then === null ? "" : `${facts.where}: ${sideName(facts.then)}`;
  const words = [parts.name, parts.side, parts.history, parts.then].map(({ textContent }) => textContent);
  button.setAttribute("aria-label", say("cell", { cell: facts.cell, words: words.filter(Boolean).join(", ") }));
}

/** @param button - Of a cell. */
export function showSide(button: HTMLElement, side: number) {
  if (button.dataset.side !== SIDES[side]) delete button.dataset.wanted;
  button.dataset.side = SIDES[side];
}

function sideWords({ cell, side, trying }: Facts) {
  if (cell === 0) return say("driveOn");
  if (trying !== SIDE.NOTHING) return `${trying === SIDE.LEFT ? "↰" : "↱"} ${sideName(trying)}?`;
  return side === SIDE.RIGHT ? `${sideName(side)} ↱` : `${side ? "↰ " : ""}${sideName(side)}`;
}

export function sideName(side: number) {
  return side ? robotWords().sides[side] : say("empty");
}

function historyOf({ cell, side, when, byHand, uses }: Facts) {
  if (cell === 0 || side === SIDE.NOTHING) return "";
  const learned = when && say(byHand ? "toldAt" : "learnedAt", { time: when });
  return [learned, uses ? say("usedTimes", { uses }) : ""].filter(Boolean).join(", ");
}

function makeCell(list: HTMLElement, cell: number, onPress: OnPress): Parts {
  const parts = ["name", "side", "history", "then"].map((part) => made("span", [], { class: `cell-${part}` }));
  const [name, side, history, then] = parts;
  const button = makeButton(cell, onPress);
  button.classList.add("cell");
  button.append(pictureOf(cell), ...parts);
  list.append(made("li", [button]));
  return { button, name, side, history, then };
}

/** A button that asks for the next side of a cell; its data-side is the side that is shown. */
export function makeButton(cell: number, onPress: OnPress) {
  const button = buttonOf("", () => {
    // A second press before the first one is shown continues from the side that the first one asked for.
    const next = (SIDES.indexOf(button.dataset.wanted ?? button.dataset.side ?? "") + 1) % SIDES.length;
    button.dataset.wanted = SIDES[next];
    onPress(cell, next);
  });
  button.disabled = cell === 0;
  return button;
}

/** The robot from above with its three front sensors, those of the pattern lit. */
export function pictureOf(pattern: number) {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "-34 -34 68 50");
  svg.setAttribute("aria-hidden", "true");
  for (const { bit, bearing } of CONES.filter((cone) => patternBit(cone.bit))) {
    const lit = pattern & patternBit(bit) ? "lit" : "dark";
    addShape(svg, "path", { d: SECTOR, class: lit, transform: `rotate(${bearing})` });
  }
  addShape(svg, "circle", { r: "13", class: "body" });
  addShape(svg, "path", { d: "M0 -9 L5 4 H-5 Z", class: "nose" });
  return svg;
}

export function addShape(svg: Element, name: string, attributes: Record<string, string>) {
  const shape = svg.appendChild(document.createElementNS(SVG, name));
  for (const [key, value] of Object.entries(attributes)) shape.setAttribute(key, value);
}
