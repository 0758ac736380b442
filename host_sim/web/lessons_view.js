// @ts-check
/* The list of what was learned, the newest first. */

import { byId } from "./elements.js";
import { clock, lessonSentence } from "./phrases.js";

/**
 * @typedef {import("./types.js").Lesson} Lesson
 * @typedef {import("./types.js").Measures} Measures
 */

/** Fills the element `lessons`. */
export class LessonsView {
  constructor() {
    this.list = byId("lessons");
    this.key = "";
  }

  /**
   * @param {number} node - The robot whose lessons they are.
   * @param {Lesson[]} lessons - The oldest first.
   * @param {Measures} [measures] - To say when.
   */
  show(node, lessons, measures) {
    const key = [node, lessons.length, lessons.at(-1)?.tick].join();
    if (this.key === key) return;
    this.key = key;
    this.list.replaceChildren(...lessons.map((lesson) => itemFor(lesson, measures)).reverse());
  }
}

/**
 * @param {Lesson} lesson
 * @param {Measures} [measures]
 */
function itemFor(lesson, measures) {
  const item = document.createElement("li");
  item.textContent = `${measures ? `${clock(lesson.tick, measures)} ` : ""}${lessonSentence(lesson)}`;
  return item;
}
