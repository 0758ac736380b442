// @ts-check
/* A lesson in the page: its question, its steps, its goals and what it needs. */

import { byId, setText } from "../core/elements.js";
import { buttonOf, choiceOf, glossaryOf, listOf, made } from "../core/building.js";
import { PLANS } from "./plans.js";
import { toolOf } from "./tools.js";
import { notesOf } from "./worksheet.js";

/**
 * @typedef {import("./course.js").Course} Course
 */

/** Fills the element panel-lessons, for one lesson in one language. */
export class LessonView {
  /** @param {Course} course */
  constructor(course) {
    const { texts, plan } = course;
    this.course = course;
    this.marks = texts.lessons[plan.id].goals.map((goal) => makeGoal(goal));
    this.tool = toolOf(plan.tool, course.lab, texts);
    this.news = made("p", [], { role: "status", id: "lesson-news" });
    this.begin = buttonOf(texts.words.start, () => course.begin());
    this.begin.className = "main";
    this.begin.id = "begin-lesson";
    byId("panel-lessons").replaceChildren(...this.parts());
  }

  parts() {
    const { texts, plan } = this.course;
    const { words, lessons } = texts;
    const { question, steps } = lessons[plan.id];
    const heading = (/** @type {string} */ text) => made("h2", [text]);
    return [
      this.choices(), made("p", [question], { class: "question" }), this.begin,
      heading(words.goals), made("ul", this.marks.map(({ item }) => item), { id: "goals" }), this.news,
      ...(this.tool ? [heading(words.tools), this.tool.element] : []),
      heading(words.steps), made("div", [listOf("ol", steps)], { class: "steps" }),
      this.prints(), ...this.details(),
    ];
  }

  choices() {
    const { course } = this;
    const { words, lessons } = course.texts;
    /** @type {[string, string][]} */
    const titles = PLANS.map(({ id }, i) => [id, `${i + 1} ${lessons[id].title}`]);
    const lesson = choiceOf(words.lesson, titles, (id) => course.choose(id));
    lesson.select.value = course.plan.id;
    lesson.select.id = "lesson";
    return made("div", [lesson.label], { class: "choices" });
  }

  prints() {
    const { course } = this;
    const { words } = course.texts;
    const sheet = buttonOf(words.printSheet, () => course.print(false));
    const notes = buttonOf(words.printNotes, () => course.print(true));
    return made("div", [sheet, notes], { class: "controls" });
  }

  details() {
    const { texts, plan } = this.course;
    const { words, lessons, glossary } = texts;
    return [
      made("details", [made("summary", [words.notes]), notesOf(words, lessons[plan.id])]),
      made("details", [made("summary", [words.glossary]), glossaryOf(glossary)]),
    ];
  }

  show() {
    const { reached, texts, begun } = this.course;
    const { words } = texts;
    this.tool?.show();
    setText(this.begin, begun ? words.again : words.start);
    this.marks.forEach(({ item, state }, place) => {
      item.classList.toggle("reached", reached.has(place));
      setText(state, reached.has(place) ? words.reached : words.open);
    });
    setText(this.news, this.newsNow());
  }

  newsNow() {
    const { reached, texts } = this.course;
    if (reached.size === this.marks.length) return texts.words.allReached;
    return reached.size ? `${texts.words.reached}: ${reached.size}/${this.marks.length}` : "";
  }
}

/** @param {string} goal */
function makeGoal(goal) {
  const state = made("span", [], { class: "state" });
  return { state, item: made("li", [`${goal} `, state]) };
}
