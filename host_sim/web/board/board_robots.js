// @ts-check
/* Who has learned what: a row for each robot, a column for each pattern. */

import { made } from "../core/building.js";
import { byId } from "../core/elements.js";
import { languageCode, robotWords, say } from "../core/language.js";
import { binary } from "../core/phrases.js";
import { PATTERNS, SIDES } from "../generated.js";
import { pictureOf } from "../panel/cells_view.js";

/**
 * A robot in the table: `page`, whether one of its own is open; `meals`, the pieces of food that it has eaten.
 * @typedef {{node: number, name: string, colour: string, page: boolean, memory: number[], meals: number}} Row
 */

const ALL = PATTERNS.length - 1;
const ARROWS = ["·", "↰", "↱"];
/** Robots in one table; more of them stand in several, side by side. */
const ROWS_MAX = 16;

/** Fills the element `class`. */
export class BoardRobots {
  constructor() {
    this.element = byId("class");
    this.shown = "";
  }

  /** @param {Row[]} rows */
  show(rows) {
    const key = languageCode() + JSON.stringify(rows);
    if (key === this.shown) return;
    this.shown = key;
    const tables = Math.ceil(rows.length / ROWS_MAX);
    const each = Math.ceil(rows.length / tables);
    document.body.classList.toggle("many", tables > 1);
    document.body.style.setProperty("--rows", `${each + 1}`);
    this.element.replaceChildren(...Array.from({ length: tables }, (_, i) => tableOf(rows.slice(i * each, (i + 1) * each))));
  }
}

/** @param {Row[]} rows */
function tableOf(rows) {
  const patterns = robotWords().patterns.slice(1).map((name, i) => {
    return made("th", [pictureOf(i + 1), binary(i + 1)], { scope: "col", title: name });
  });
  const numbers = [say("knows"), say("ate")].map((name) => made("th", [name], { scope: "col" }));
  const head = made("tr", [made("th", [say("robot")], { scope: "col" }), ...patterns, ...numbers]);
  return made("table", [made("thead", [head]), made("tbody", rows.map(rowOf))]);
}

/** @param {Row} row */
function rowOf({ node, name, colour, page, memory, meals }) {
  const tag = made("span", [`${node}`], { class: "tag" });
  tag.style.setProperty("--colour", colour);
  const cells = memory.slice(1).map((side) => made("td", [ARROWS[side]], { "data-side": SIDES[side], title: robotWords().sides[side] }));
  const known = memory.filter((side, cell) => cell > 0 && side > 0).length;
  const numbers = [`${known}/${ALL}`, `${meals}`];
  const head = made("th", [tag, name || (page ? "–" : say("free"))], { scope: "row", title: name || say("robotNumber", { node }) });
  return made("tr", [head, ...cells, ...numbers.map((text) => made("td", [text], { class: "number" }))], page ? {} : { class: "empty" });
}
