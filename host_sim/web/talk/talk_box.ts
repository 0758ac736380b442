/* The box for conversations: the choice of a speaker, what was said, and an input line. */

import { buttonOf, made, setText } from "../core/dom.js";
import { inEachLanguage, LANGUAGES, languageCode, say } from "../core/language.js";
import type { Meant } from "../draw/scene.js";
import type { LabPage } from "../lab/lab_page.js";
import type { Said, WirePlace } from "../types.js";

/**
 * What was asked, and the answer; and of a page that has the whole run, the tick that was asked about, and how often
 * people had changed the run before.
 */
export type Exchange = { who: string; sentence: string; said: Said; tick?: number; changes?: number };

/** The speakers, and the language of each. */
const SPEAKERS = { robot: "en", "robot-de": "de", eliza: "en", "eliza-de": "de" };
const LENGTH_MAX = "300";
const SAID_MAX = 50;
const TIMES_SHOWN = 3;

/** Is put into an element of the page. */
export class TalkBox {
  /** The oldest first. */
  history: Exchange[] = [];
  /** What speakers were taught to say. */
  taught: Set<string> = new Set();
  who = made("select", Object.keys(SPEAKERS).map((value) => made("option", [], { value })), { id: "talk-who" });
  list = made("ol", [], { id: "talk-said", "aria-live": "polite", tabindex: "0" });
  line = made("input", [], { id: "talk-line", maxlength: LENGTH_MAX, autocomplete: "off" });
  element = made("div", [this.list], { id: "talk-box" });

  constructor(parent: HTMLElement, readonly page: LabPage) {
    this.who.addEventListener("change", () => this.mean(undefined));
    const to = made("span", []);
    const button = made("button", [], { class: "main" });
    const form = made("form", [made("label", [to, " ", this.who]), this.line, button], { class: "controls" });
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.page.ask(this.who.value, this.line.value);
      this.line.value = "";
    });
    this.element.append(form);
    parent.append(this.element);
    inEachLanguage(() => this.name(to, button));
  }

  /** Writes its words. The robot is asked in the page's language, if it knows that. */
  name(to: HTMLElement, button: HTMLElement) {
    setText(to, say("talkTo"));
    setText(button, say("say"));
    this.list.setAttribute("aria-label", say("said"));
    this.line.setAttribute("aria-label", say("youSay"));
    this.line.placeholder = say("talkExample");
    for (const option of this.who.options) option.text = speakerName(option.value);
    this.meetRobot();
  }

  meetRobot() {
    this.who.value = Object.entries(SPEAKERS).find(([, code]) => code === languageCode())?.[0] ?? "robot";
  }

  moveTo(parent: HTMLElement) {
    if (this.element.parentElement !== parent) parent.append(this.element);
  }

  /** Begins anew. */
  forget() {
    this.history = [];
    this.taught.clear();
    this.list.replaceChildren();
    this.mean(undefined);
  }

  /**
   * Shows an answer, and highlights what it is about.
   * @param places - Where the robot was in the ticks on which the answer rests, if that is in view.
   */
  answer(exchange: Exchange, places: WirePlace[]) {
    const { who, sentence, said } = exchange;
    this.history = [...this.history, exchange].slice(-SAID_MAX);
    const mark = made("span", [`[${said.mark}]`], { class: `mark ${said.mark}` });
    const lang = SPEAKERS[who as keyof typeof SPEAKERS];
    const answer = made("p", [mark, ` ${said.text} `, ...this.times(said)], { lang });
    this.list.append(made("li", [made("p", [sentence || "…"], { class: "asked", lang }), answer]));
    if (this.list.childElementCount > SAID_MAX) this.list.firstElementChild?.remove();
    this.list.scrollTop = this.list.scrollHeight;
    const { first_tick = 0 } = this.page.scene?.environment ?? {};
    this.mean(said.mark === "log" ? { ...said, places, first_tick } : undefined);
  }

  mean(meant: Meant | undefined) {
    if (this.page.scene) this.page.scene.meant = meant;
    this.page.lightUp();
  }

  /** The last times on which an answer rests, as buttons. */
  times({ ticks }: Said) {
    const { scene } = this.page;
    return scene ? ticks.slice(-TIMES_SHOWN).map((tick) => buttonOf(scene.clock(tick), () => this.page.seek(tick))) : [];
  }
}

function speakerName(who: string) {
  const code = SPEAKERS[who as keyof typeof SPEAKERS];
  const name = who.startsWith("eliza") ? "ELIZA" : say("speakerRobot");
  return code === languageCode() ? name : `${name} (${LANGUAGES.find(([known]) => known === code)?.[1]})`;
}
