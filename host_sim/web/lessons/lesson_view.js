// @ts-check
/* A lesson in the page: its question, its steps, its goals and what it needs. */

import { byId, setText } from "../core/elements.js";
import { buttonOf, choiceOf, made, termsOf } from "../core/building.js";
import { filled } from "../core/phrases.js";
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
    this.step = made("div", [], { id: "step", role: "group" });
    /** The index of the step that is shown, and a key of what is written about it. */
    this.place = this.firstOpen;
    this.written = "";
    byId("panel-lessons").replaceChildren(...this.parts());
  }

  parts() {
    const { texts, plan } = this.course;
    const { words, lessons } = texts;
    const { question } = lessons[plan.id];
    const heading = (/** @type {string} */ text) => made("h2", [text]);
    return [
      this.choices(), this.step, made("p", [question], { class: "question" }),
      heading(words.goals), made("ul", this.marks.map(({ item }) => item), { id: "goals" }), this.news,
      ...(this.tool ? [heading(words.tools), this.tool.element] : []),
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
    return made("div", [lesson.label, this.begin], { class: "choices" });
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
    const { words, glossary } = texts;
    return [
      made("details", [made("summary", [words.notes]), notesOf(texts, plan.id)]),
      made("details", [made("summary", [words.glossary]), made("dl", termsOf(glossary))]),
    ];
  }

  get steps() {
    return this.course.texts.lessons[this.course.plan.id].steps;
  }

  /** The first step that is not done, or the last one. */
  get firstOpen() {
    const open = this.steps.findIndex((_, place) => !this.course.done.has(place));
    return open < 0 ? this.steps.length - 1 : open;
  }

  /** @param {number} place - Of the step to show. */
  go(place) {
    this.place = place;
    this.showStep();
  }

  showStep() {
    const { course, place, steps } = this;
    const { done, next, texts: { words } } = course;
    const key = JSON.stringify([place, ...done]);
    if (key === this.written) return;
    this.written = key;
    const said = filled(words.stepOf, { step: place + 1, all: steps.length });
    const marks = steps.map((_, i) => {
      const mark = buttonOf(done.has(i) ? `${i + 1} ✓` : `${i + 1}`, () => this.go(i));
      mark.classList.toggle("done", done.has(i));
      mark.setAttribute("aria-label", `${filled(words.stepOf, { step: i + 1, all: steps.length })}${done.has(i) ? `, ${words.ticked}` : ""}`);
      if (i === place) mark.setAttribute("aria-current", "step");
      return mark;
    });
    const isLast = done.size === steps.length;
    const on = isLast ? next && buttonOf(words.nextLesson, () => course.choose(next.id)) : buttonOf(this.doneWords, () => this.tick());
    if (on) Object.assign(on, { id: "step-done", className: "main" });
    this.step.setAttribute("aria-label", said);
    this.step.replaceChildren(
      made("div", [made("b", [said]), ...marks], { class: "head" }), made("p", [steps[place]]),
      ...(isLast ? [made("p", [words.allSteps])] : []), ...(on ? [on] : []),
    );
  }

  get doneWords() {
    const { words } = this.course.texts;
    return this.place < this.steps.length - 1 ? words.stepDone : words.lastDone;
  }

  /** The step is done, and the next one that is not comes. */
  tick() {
    this.course.tick(this.place);
    this.go(this.firstOpen);
    document.getElementById("step-done")?.focus();
  }

  show() {
    this.showStep();
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
