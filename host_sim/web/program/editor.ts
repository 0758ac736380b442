/* A field for a program, with line numbers, the current line highlighted and the line of a mistake marked. */

import { made, setText } from "../core/dom.js";

/** The text is in `field`. */
export class Editor {
  numbers = made("pre", [], { "aria-hidden": "true" });
  lit = made("div", [], { class: "line lit", hidden: "" });
  wrong = made("div", [], { class: "line wrong", hidden: "" });
  field = made("textarea", [], { id: "program-text", spellcheck: "false", autocapitalize: "off", autocomplete: "off" });
  element = made("div", [this.numbers, this.lit, this.wrong, this.field], { class: "editor" });
  /** The lines of the marks, from 1; 0 for none. */
  lines = { lit: 0, wrong: 0 };

  /** @param onInput - Called when a person has changed the text. */
  constructor(onInput: () => void) {
    this.field.addEventListener("input", () => {
      this.number();
      onInput();
    });
    this.field.addEventListener("scroll", () => this.place());
  }

  get text() {
    return this.field.value;
  }

  set text(text) {
    this.field.value = text;
    this.number();
  }

  number() {
    const count = this.field.value.split("\n").length;
    setText(this.numbers, Array.from({ length: count }, (_, i) => i + 1).join("\n"));
    this.place();
  }

  /**
   * Lights a line and brings it into view, and marks one with a mistake.
   * @param lit - From 1; 0 for none.
   */
  show(lit: number, wrong: number) {
    if (lit === this.lines.lit && wrong === this.lines.wrong) return;
    this.lines = { lit, wrong };
    this.bringIntoView(wrong || lit);
    this.place();
  }

  /** The height of a line and the space above the first one, px. */
  get measures() {
    const { lineHeight, paddingTop } = getComputedStyle(this.field);
    return { height: parseFloat(lineHeight), above: parseFloat(paddingTop) };
  }

  bringIntoView(line: number) {
    if (!line) return;
    const { field } = this;
    const { height } = this.measures;
    const top = (line - 1) * height;
    const last = field.scrollTop + field.clientHeight - 3 * height;
    if (top < field.scrollTop + height || top > last) field.scrollTop = Math.max(0, top - field.clientHeight / 2);
  }

  place() {
    const { height, above } = this.measures;
    this.numbers.style.transform = `translateY(${-this.field.scrollTop}px)`;
    for (const name of ["lit", "wrong"] as const) {
      this[name].hidden = !this.lines[name];
      this[name].style.top = `${above + (this.lines[name] - 1) * height - this.field.scrollTop}px`;
    }
  }
}
