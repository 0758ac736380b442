/* The eight cells: for each pattern its picture, what was learned, when, and how often it was used. */

import { REASON } from "./reasons.js";
import { PATTERN_NAMES, SIDE_NAMES, clock } from "./words.js";

const SVG = "http://www.w3.org/2000/svg";
/** A cone of 45 degrees that looks up. */
const SECTOR = "M0 0 L-12.2 -29.6 A32 32 0 0 1 12.2 -29.6 Z";

/** Shows a memory in a list; a cell can be pressed where someone listens. */
export class CellsView {
  /**
   * @param {HTMLElement} list
   * @param {(cell: number, side: number) => void} [onPress] - Told which cell, and what it holds next.
   */
  constructor(list, onPress) {
    this.cells = PATTERN_NAMES.map((_, cell) => makeCell(list, cell, onPress));
    this.shown = [];
  }

  /**
   * @param {Object} state - As in host_sim/view/state.py.
   * @param {Object} measures
   * @param {number[]} [then] - A memory to compare with.
   */
  show(state, measures, then) {
    this.cells.forEach((parts, cell) => {
      const facts = factsOf(state, measures, cell, then);
      const key = JSON.stringify(facts);
      if (this.shown[cell] !== key) fillCell(parts, facts);
      this.shown[cell] = key;
    });
  }
}

function factsOf(state, measures, cell, then) {
  const side = state.memory[cell];
  const about = state.pattern === cell && !state.lifted;
  return {
    cell,
    side,
    when: state.learned[cell] < 0 ? "" : clock(state.learned[cell], measures),
    uses: state.uses[cell],
    inUse: about && state.reason === REASON.remembered,
    trying: about && state.reason === REASON.trial ? (state.trial?.side ?? 0) : 0,
    then: then ? then[cell] : null,
  };
}

function fillCell(parts, facts) {
  const { button } = parts;
  button.dataset.side = SIDE_NAMES[facts.side];
  button.classList.toggle("in-use", facts.inUse);
  button.classList.toggle("trying", facts.trying > 0);
  button.classList.toggle("changed", facts.then !== null && facts.then !== facts.side);
  parts.side.textContent = sideWords(facts);
  parts.story.textContent = storyOf(facts);
  parts.then.textContent = facts.then === null ? "" : `then: ${facts.then ? SIDE_NAMES[facts.then] : "empty"}`;
  const story = [PATTERN_NAMES[facts.cell], parts.side.textContent, parts.story.textContent, parts.then.textContent];
  button.setAttribute("aria-label", `Cell ${facts.cell}, ${story.filter(Boolean).join(", ")}`);
}

function sideWords({ cell, side, trying }) {
  if (cell === 0) return "drive on";
  if (trying) return `${trying === 1 ? "↰" : "↱"} ${SIDE_NAMES[trying]}?`;
  if (side === 0) return "empty";
  return side === 1 ? "↰ left" : "right ↱";
}

function storyOf({ cell, side, when, uses }) {
  if (cell === 0) return "";
  const learned = side && when ? `learned ${when}` : "";
  return [learned, uses ? `used ${uses}×` : ""].filter(Boolean).join(", ");
}

function makeCell(list, cell, onPress) {
  const item = list.appendChild(document.createElement("li"));
  const button = item.appendChild(document.createElement(onPress ? "button" : "div"));
  button.className = "cell";
  button.appendChild(pictureOf(cell));
  const parts = { button };
  for (const name of ["name", "side", "story", "then"]) parts[name] = addSpan(button, name);
  parts.name.textContent = PATTERN_NAMES[cell];
  if (onPress) makePressable(button, cell, onPress);
  else button.setAttribute("role", "img");
  return parts;
}

function makePressable(button, cell, onPress) {
  button.type = "button";
  button.disabled = cell === 0;
  button.title = cell ? "Press to change: empty, left, right" : "Nothing in the way: nothing to learn";
  button.addEventListener("click", () => onPress(cell, (SIDE_NAMES.indexOf(button.dataset.side) + 1) % 3));
}

function addSpan(parent, name) {
  const span = parent.appendChild(document.createElement("span"));
  span.className = `cell-${name}`;
  return span;
}

/** The robot from above with its three front sensors, those of the pattern lit. */
function pictureOf(pattern) {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "-34 -34 68 50");
  svg.setAttribute("aria-hidden", "true");
  for (const [bit, degrees] of [[1, 45], [2, 0], [4, -45]]) {
    const lit = pattern & bit ? "lit" : "dark";
    addShape(svg, "path", { d: SECTOR, class: lit, transform: `rotate(${degrees})` });
  }
  addShape(svg, "circle", { r: 13, class: "body" });
  addShape(svg, "path", { d: "M0 -9 L5 4 H-5 Z", class: "nose" });
  return svg;
}

function addShape(svg, name, attributes) {
  const shape = svg.appendChild(document.createElementNS(SVG, name));
  for (const [key, value] of Object.entries(attributes)) shape.setAttribute(key, value);
}
