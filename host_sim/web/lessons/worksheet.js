// @ts-check
/* The printed pages: a worksheet with room to write, or the notes for teachers. */

import { pictureOf } from "../panel/cells_view.js";
import { byId } from "../core/elements.js";
import { CELL_COUNT } from "../generated.js";
import { binary } from "../core/phrases.js";
import { made, termsOf } from "../core/dom.js";

/**
 * @typedef {import("../core/language.js").Texts["lessons"]} Texts
 * @typedef {import("./plans.js").Plan} Plan
 */

const LINES = 3;

/** Fills the element sheet; only a printer shows it. */
export class Worksheet {
  constructor() {
    this.element = byId("sheet");
    addEventListener("afterprint", () => this.clear());
  }

  get isEmpty() {
    return this.element.childElementCount === 0;
  }

  clear() {
    this.element.replaceChildren();
  }

  /**
   * @param {Plan} plan
   * @param {Texts} texts
   */
  fill({ id }, texts) {
    const { words, lessons } = texts;
    const { title, question, steps, goals, tasks } = lessons[id];
    const [table] = tableIn(texts, id);
    this.element.replaceChildren(
      made("h1", [title]), headOf(words), made("p", [question], { class: "question" }),
      made("h2", [words.steps]), made("ol", steps.map((step) => made("li", [step]))),
      made("h2", [words.goalsPrinted]), made("ul", goals.map((goal) => made("li", [goal])), { class: "boxes" }),
      made("h2", [words.tasks]), made("ol", tasks.map((task) => made("li", [task, linesOf()]))),
      ...(table ? [made("h2", [table]), tableOf(words)] : []),
    );
  }

  /**
   * @param {Plan} plan
   * @param {Texts} texts
   */
  fillNotes({ id }, texts) {
    const { words, lessons, glossary } = texts;
    this.element.replaceChildren(
      made("h1", [`${lessons[id].title}: ${words.notes}`]), notesOf(texts, id),
      made("h2", [words.glossary]), made("dl", termsOf(glossary), { class: "glossary" }),
    );
  }
}

/**
 * What the pupils are to fill a table with, and the answer; nothing if the lesson has no table.
 * @param {Texts} texts
 * @param {Plan["id"]} id
 */
function tableIn({ tables }, id) {
  return /** @type {Record<string, string[]>} */ (tables)[id] ?? [];
}

/**
 * What a teacher wants to know of a lesson.
 * @param {Texts} texts
 * @param {Plan["id"]} id
 */
export function notesOf(texts, id) {
  const { words, lessons } = texts;
  const { tasks, notes: { aim, time, expect, answers } } = lessons[id];
  const asked = [...tasks.map((task, place) => [task, answers[place]]), tableIn(texts, id)].filter(([task]) => task);
  const answered = asked.map(([task, answer]) => made("li", [made("em", [task]), ` ${answer}`]));
  const about = termsOf([[words.aim, aim], [words.time, time], [words.expect, expect]]);
  return made("div", [made("dl", about), made("h3", [words.answers]), made("ol", answered)], { class: "notes" });
}

/** @param {Texts["words"]} words */
function headOf({ name, group, date }) {
  return made("p", [name, group, date].map((field) => made("span", [`${field}:`])), { class: "head" });
}

function linesOf() {
  return made("div", Array.from({ length: LINES }, () => made("div", [])), { class: "lines" });
}

/**
 * A row for each pattern to learn, with an empty field for the turn and one for the reason.
 * @param {Texts["words"]} words
 */
function tableOf({ pattern, turn, why }) {
  const head = made("tr", [pattern, turn, why].map((text) => made("th", [text], { scope: "col" })));
  const rows = Array.from({ length: CELL_COUNT - 1 }, (_, i) => {
    const picture = made("td", [pictureOf(i + 1), ` ${binary(i + 1)}`]);
    return made("tr", [picture, made("td", []), made("td", [])]);
  });
  return made("table", [made("thead", [head]), made("tbody", rows)]);
}
