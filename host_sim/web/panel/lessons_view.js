// @ts-check
/* The list of what was learned, the newest first. */

import { made } from "../core/dom.js";
import { byId } from "../core/elements.js";
import { languageCode, robotWords, say } from "../core/language.js";
import { lessonSentence } from "../core/phrases.js";

/** Fills the element `lessons`. */
export class LessonsView {
  constructor() {
    this.list = byId("lessons");
    this.key = "";
  }

  /**
   * @param {Scene} scene
   * @param {Lesson[]} lessons - Those of the robot that the panel shows, the oldest first.
   */
  show(scene, lessons) {
    const key = JSON.stringify([languageCode(), scene.environment.start_tick, lessons]);
    if (this.key === key) return;
    this.key = key;
    this.list.replaceChildren(...lessons.map((lesson) => itemFor(lesson, scene)).reverse());
    if (!lessons.length) this.list.append(made("li", [say("nothingLearned")]));
  }
}

/**
 * @param {Lesson} lesson
 * @param {Scene} scene
 */
function itemFor(lesson, scene) {
  return made("li", [`${scene.clock(lesson.tick)} ${lessonSentence(lesson, robotWords())}`]);
}
