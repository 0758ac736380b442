/* A lesson in the page: its question, its steps, its goals and what it needs. */

import { buttonOf, byId, choiceOf, made, setText, termsOf } from "../core/dom.js";
import { filled } from "../core/phrases.js";
import { PLANS } from "./plans.js";
import { toolOf } from "./tools.js";
import { notesOf } from "./worksheet.js";
import type { Course } from "./course.js";
import type { Tool } from "./tools.js";

/** Fills the element panel-lessons, for one lesson in one language. */
export class LessonView {
  marks = this.course.texts.lessons[this.course.plan.id].goals.map((goal) => makeGoal(goal));
  /** The tools of the step that is shown. */
  tools: Tool[] = [];
  news = made("p", [], { role: "status", id: "lesson-news" });
  begin = buttonOf(this.course.texts.words.start, () => this.course.begin());
  head = made("div", [], { class: "head" });
  body = made("div", [], { class: "held" });
  foot = made("div", [], { class: "foot" });
  step = made("div", [this.head, this.news, this.body, this.foot], { id: "step", role: "group" });
  /** The index of the step that is shown, of the one whose text and tools are written, and a key of what else is. */
  place = this.firstOpen;
  writtenPlace = NaN;
  written = "";

  constructor(readonly course: Course) {
    Object.assign(this.begin, { className: "main", id: "begin-lesson" });
    byId("panel-lessons").replaceChildren(...this.parts());
  }

  parts() {
    const { texts, plan } = this.course;
    const { words, lessons } = texts;
    const { question } = lessons[plan.id];
    const heading = (text: string) => made("h2", [text]);
    return [
      this.choices(), this.step, made("p", [question], { class: "question" }),
      heading(words.goals), made("ul", this.marks.map(({ item }) => item), { id: "goals" }),
      this.prints(), ...(this.course.classroom.isOpen ? [] : [this.course.classroom.element]), ...this.details(),
    ];
  }

  choices() {
    const { course } = this;
    const { words, lessons } = course.texts;
    const titles: [string, string][] = PLANS.map(({ id }, i) => [id, `${i + 1} ${lessons[id].title}`]);
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

  /** @param place - Of the step to show. */
  go(place: number) {
    this.place = place;
    this.show();
    this.reveal();
  }

  /** Where the panel is below the arena, or beside it in a page that scrolls, brings the step into view. */
  reveal() {
    if (matchMedia("(max-width: 899px), (max-height: 500px)").matches) this.step.scrollIntoView();
  }

  showStep() {
    this.showMarks();
    if (this.place === this.writtenPlace) return;
    this.writtenPlace = this.place;
    const { texts, plan, lab } = this.course;
    this.tools = (plan.steps[this.place].tools ?? []).map((name) => toolOf(name, lab, texts));
    this.step.setAttribute("aria-label", this.nameOf(this.place));
    this.body.replaceChildren(made("p", [this.steps[this.place]]), ...this.tools.map(({ element }) => element));
  }

  /** Shows which steps are done, and what can be pressed then. */
  showMarks() {
    const { course, place, steps } = this;
    const { done, texts: { words } } = course;
    const key = JSON.stringify([place, ...done]);
    if (key === this.written) return;
    this.written = key;
    const hadFocus = this.foot.contains(document.activeElement);
    const marks = steps.map((_, i) => this.markOf(i));
    this.head.replaceChildren(made("b", [this.nameOf(place)]), ...marks);
    const on = this.onwards();
    const said = done.size === steps.length ? words.allSteps : done.has(place) ? words.seenDone : "";
    this.foot.replaceChildren(...(said ? [made("p", [said])] : []), ...(on ? [on] : []));
    if (hadFocus) on?.focus();
  }

  /** @param place - Of a step. */
  nameOf(place: number) {
    return filled(this.course.texts.words.stepOf, { step: place + 1, all: this.steps.length });
  }

  /** @param place - Of a step. */
  markOf(place: number) {
    const { done, texts } = this.course;
    const isDone = done.has(place);
    const mark = buttonOf(isDone ? `${place + 1} ✓` : `${place + 1}`, () => this.go(place));
    mark.classList.toggle("done", isDone);
    mark.setAttribute("aria-label", `${this.nameOf(place)}${isDone ? `, ${texts.words.ticked}` : ""}`);
    if (place === this.place) mark.setAttribute("aria-current", "step");
    return mark;
  }

  /** The button that leads on from this step. */
  onwards() {
    const { course, place, steps } = this;
    const { done, next, texts: { words } } = course;
    const isLast = done.size === steps.length && place === steps.length - 1;
    if (isLast && !next) return undefined;
    const text = isLast ? words.nextLesson : done.has(place) ? words.nextStep : place < steps.length - 1 ? words.stepDone : words.lastDone;
    const on = buttonOf(text, () => (isLast ? course.choose(next.id) : this.tick()));
    return Object.assign(on, { id: "step-done", className: "main" });
  }

  /** The step is done, and the next one comes; after the last one, the first that is not done. */
  tick() {
    const { course, place, steps } = this;
    if (!course.done.has(place)) course.tick(place);
    this.go(place < steps.length - 1 ? place + 1 : this.firstOpen);
    document.getElementById("step-done")?.focus();
  }

  show() {
    this.showStep();
    const { reached, texts, begun } = this.course;
    const { words } = texts;
    for (const tool of this.tools) tool.show();
    setText(this.begin, begun ? words.again : words.start);
    this.marks.forEach(({ item, state }, place) => {
      item.classList.toggle("reached", reached.has(place));
      setText(state, reached.has(place) ? words.reached : words.open);
    });
    setText(this.news, this.newsNow());
    this.news.classList.toggle("all", reached.size === this.marks.length);
  }

  newsNow() {
    const { reached, texts } = this.course;
    if (reached.size === this.marks.length) return texts.words.allReached;
    return reached.size ? `${texts.words.reached}: ${reached.size}/${this.marks.length}` : "";
  }
}

function makeGoal(goal: string) {
  const state = made("span", [], { class: "state" });
  return { state, item: made("li", [`${goal} `, state]) };
}
