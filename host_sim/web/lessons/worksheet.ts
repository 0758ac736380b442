/* The printed pages: a worksheet with room to write, or the notes for teachers. */

import { pictureOf } from "../panel/cells_view.js";
import { byId, made, termsOf } from "../core/dom.js";
import { languageCode } from "../core/language.js";
import { CELL_COUNT } from "../generated.js";
import { binary } from "../core/phrases.js";
import type { Texts as AllTexts } from "../core/language.js";
import type { Plan } from "./plans.js";

type Texts = AllTexts["lessons"];

const LINES = 3;

/** Fills the element sheet; only a printer shows it. */
export class Worksheet {
  element = byId("sheet");

  constructor() {
    addEventListener("afterprint", () => this.element.replaceChildren());
  }

  get isEmpty() {
    return this.element.childElementCount === 0;
  }

  /** @param notes - Whether to fill it with those for teachers. */
  fill({ id }: Plan, texts: Texts, notes: boolean) {
    this.element.replaceChildren(...(notes ? this.notes(id, texts) : this.worksheet(id, texts)));
    this.element.lang = languageCode();
  }

  worksheet(id: Plan["id"], texts: Texts) {
    const { words, lessons } = texts;
    const { title, question, steps, goals, tasks } = lessons[id];
    const [table] = tableIn(texts, id);
    return [
      made("h1", [title]), headOf(words), made("p", [question], { class: "question" }),
      made("h2", [words.steps]), made("ol", steps.map((step) => made("li", [step]))),
      made("h2", [words.goalsPrinted]), made("ul", goals.map((goal) => made("li", [goal])), { class: "boxes" }),
      made("h2", [words.tasks]), made("ol", tasks.map((task) => made("li", [task, linesOf()]))),
      ...(table ? [made("h2", [table]), tableOf(words)] : []),
    ];
  }

  notes(id: Plan["id"], texts: Texts) {
    const { words, lessons, glossary } = texts;
    return [
      made("h1", [`${lessons[id].title}: ${words.notes}`]), notesOf(texts, id),
      made("h2", [words.glossary]), made("dl", termsOf(glossary), { class: "glossary" }),
    ];
  }
}

/** What the pupils are to fill a table with, and the answer; nothing if the lesson has no table. */
function tableIn({ tables }: Texts, id: Plan["id"]) {
  return (tables as Record<string, string[]>)[id] ?? [];
}

/** The notes on a lesson for teachers. */
export function notesOf(texts: Texts, id: Plan["id"]) {
  const { words, lessons } = texts;
  const { tasks, notes: { aim, time, expect, answers } } = lessons[id];
  const asked = [...tasks.map((task, place) => [task, answers[place]]), tableIn(texts, id)].filter(([task]) => task);
  const answered = asked.map(([task, answer]) => made("li", [made("em", [task]), ` ${answer}`]));
  const about = termsOf([[words.aim, aim], [words.time, time], [words.expect, expect]]);
  return made("div", [made("dl", about), made("h3", [words.answers]), made("ol", answered)], { class: "notes" });
}

function headOf({ name, group, date }: Texts["words"]) {
  return made("p", [name, group, date].map((field) => made("span", [`${field}:`])), { class: "head" });
}

function linesOf() {
  return made("div", Array.from({ length: LINES }, () => made("div", [])), { class: "lines" });
}

/** A row for each pattern to learn, with an empty field for the turn and one for the reason. */
function tableOf({ pattern, turn, why }: Texts["words"]) {
  const head = made("tr", [pattern, turn, why].map((text) => made("th", [text], { scope: "col" })));
  const rows = Array.from({ length: CELL_COUNT - 1 }, (_, i) => {
    const picture = made("td", [pictureOf(i + 1), ` ${binary(i + 1)}`]);
    return made("tr", [picture, made("td", []), made("td", [])]);
  });
  return made("table", [made("thead", [head]), made("tbody", rows)]);
}
