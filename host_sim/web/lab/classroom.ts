/* The page of a pupil: in a class its name and goals go to the board; elsewhere they become a code to type there. */

import { buttonOf, byId, made, setText } from "../core/dom.js";
import { inEachLanguage, say } from "../core/language.js";
import { hideToken, keep, kept } from "../core/storage.js";
import { PLANS } from "../lessons/plans.js";
import type { Course } from "../lessons/course.js";

const REPORT_MS = 3000;
/** A page without news reports at every fifth time only, to say that it is still there. */
const ALIVE_REPORTS = 5;
const NAME_MAX = 20;
const LINK_MAX = 4000;
const KEY_BYTES = 16;
const DIGITS = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
const DIGIT_BITS = 5;
const CHECK_BITS = 10;
const GROUP = 3;
const FNV_START = 0x811c9dc5;
const FNV_PRIME = 0x01000193;

/** Its element stands in the head of the page in a class, and in the lessons elsewhere. */
export class Classroom {
  /** Whether a server takes reports. */
  isOpen = document.querySelector('meta[name="octet-class"]') !== null;
  key = keptKey();
  told = "";
  reports = 0;
  isLost = false;
  field = made("input", [], { maxlength: `${NAME_MAX}`, autocomplete: "off", id: "my-name", value: kept("name") });
  news = made("span", [], { role: "status", id: "class-news" });
  element = made("div", [], { id: "class-name" });

  constructor(readonly course: Course) {
    if (this.isOpen) byId("show-link-code").after(this.element);
    if (this.isOpen) hideToken();
    this.field.addEventListener("change", () => this.rename());
    inEachLanguage(() => this.build());
    if (this.isOpen) setInterval(() => this.report(), REPORT_MS);
  }

  get name() {
    return this.field.value.trim().replace(/\s+/g, " ");
  }

  build() {
    const label = made("label", [`${say("pupilName")} `, this.field]);
    const code = buttonOf(say("showCode"), () => this.showCode());
    this.element.replaceChildren(label, ...(this.isOpen ? [] : [" ", code]), " ", this.news);
    this.show();
  }

  rename() {
    keep("name", this.name);
    if (!this.isOpen) setText(this.news, ""); // the code of another name
    this.report();
  }

  showCode() {
    const { name } = this;
    setText(this.news, name ? say("yourCode", { code: codeOf(name, this.goals) }) : say("nameFirst"));
  }

  /** The goals reached, by lesson. */
  get goals() {
    return Object.fromEntries(Object.entries(this.course.progress).map(([id, { goals }]) => [id, goals]));
  }

  /** Tells the board what has changed. */
  async report() {
    if (!this.isOpen || !this.name) return this.show();
    const text = JSON.stringify(this.state());
    this.reports = (this.reports + 1) % ALIVE_REPORTS;
    if (text === this.told && this.reports > 0) return;
    try {
      const answer = await fetch("report", { method: "POST", body: text });
      this.isLost = !answer.ok;
      if (answer.ok) this.told = text;
    } catch {
      this.isLost = true;
    }
    this.show();
  }

  state() {
    const { course } = this;
    const { lane, scene } = course.lab;
    const link = course.lab.link(lane.experiment);
    const memory = scene?.states[lane.robot]?.memory ?? [];
    const isPlain = [...memory].every((cell) => cell <= 2);
    return {
      key: this.key, name: this.name, lesson: course.plan.id, step: course.view.place, goals: this.goals,
      memory: isPlain ? [...memory] : [], link: link.length > LINK_MAX ? "" : link,
    };
  }

  show() {
    if (!this.isOpen) return;
    const reached = PLANS.flatMap(({ id }) => this.goals[id] ?? []).length;
    setText(this.news, !this.name ? say("nameFirst") : this.isLost ? say("boardLost") : say("onBoard", { goals: reached }));
  }
}

/** The key by which the board recognizes this page. */
function keptKey() {
  const old = kept("class-key");
  if (/^[0-9a-f]{32}$/.test(old)) return old;
  const bytes = crypto.getRandomValues(new Uint8Array(KEY_BYTES));
  const key = [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  keep("class-key", key);
  return key;
}

/**
 * A bit for each goal, then ten bits of a hash of these and of the name; host_sim/live/class_roster.py reads it.
 * @param reached - The goals reached, by lesson.
 */
function codeOf(name: string, reached: Record<string, number[]>) {
  const flags = PLANS.flatMap(({ id, goals }) => goals.map((_, i) => Number((reached[id] ?? []).includes(i)))).join("");
  const check = hash(`${flags} ${name.toLowerCase()}`) % 2 ** CHECK_BITS;
  const bits = flags + check.toString(2).padStart(CHECK_BITS, "0");
  const digits: string[] = [];
  for (let i = 0; i < bits.length; i += DIGIT_BITS) digits.push(DIGITS[parseInt(bits.slice(i, i + DIGIT_BITS).padEnd(DIGIT_BITS, "0"), 2)]);
  return Array.from({ length: Math.ceil(digits.length / GROUP) }, (_, i) => digits.slice(GROUP * i, GROUP * (i + 1)).join("")).join("-");
}

/** FNV-1a of a text in UTF-8, 32 bits. */
function hash(text: string) {
  let value = FNV_START;
  for (const byte of new TextEncoder().encode(text)) value = Math.imul(value ^ byte, FNV_PRIME);
  return value >>> 0;
}
