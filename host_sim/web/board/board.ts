/* The board of a class: how to join, and who has reached which goals. */

import { buttonOf, byId, made, setText, typedById } from "../core/dom.js";
import { inEachLanguage, languageCode, robotWords, say, wordsOf } from "../core/language.js";
import { hideToken } from "../core/storage.js";
import { drawModules } from "../draw/shapes.js";
import { SIDES } from "../generated.js";
import type { Texts } from "../core/language.js";

/**
 * A pupil; see host_sim/live/class_roster.py. `silent_s` is the time since the page was heard; null for a typed code.
 */
type Pupil = { key: string; name: string; lesson: string; step: number; goals: Record<string, number[]>; memory: number[];
  link: string; silent_s: number | null };

type Lesson = keyof Texts["lessons"]["lessons"];

type Class = { pupils: Pupil[]; join: { urls: string[]; modules: string[] } };

const ASK_MS = 1000;
/** After this time, s, a page counts as closed. */
const SILENT_S = 30;
const ARROWS = ["·", "↰", "↱"];

/** Asks the server once a second, and shows its answer. */
class Board {
  class: Class | undefined;
  shown = "";
  isLost = false;

  constructor() {
    hideToken();
    byId("code-form").addEventListener("submit", (event) => this.takeCode(event));
    byId("print").addEventListener("click", () => print());
    inEachLanguage(() => this.show());
    this.ask();
  }

  async ask() {
    try {
      const answer = await fetch("pupils");
      this.isLost = !answer.ok;
      if (answer.ok) this.class = await answer.json();
    } catch {
      this.isLost = true;
    }
    this.show();
    setTimeout(() => this.ask(), ASK_MS);
  }

  show() {
    document.body.classList.toggle("lost", this.isLost);
    if (!this.class) return setText(byId("status"), say(this.isLost ? "noConnection" : "connecting"));
    const { pupils, join } = this.class;
    const here = pupils.filter(({ silent_s }) => silent_s !== null && silent_s < SILENT_S).length;
    setText(byId("status"), this.isLost ? say("noConnection") : say("presence", { open: here, all: pupils.length }));
    const key = languageCode() + JSON.stringify([pupils.map((it) => ({ ...it, silent_s: isHere(it) })), join]);
    if (key === this.shown || byId("class").contains(document.activeElement)) return;
    this.shown = key;
    document.body.style.setProperty("--rows", `${pupils.length + 3}`);
    showJoin(join);
    byId("class").replaceChildren(...(pupils.length ? [this.table(pupils)] : [made("p", [say("nobody")])]));
  }

  table(pupils: Pupil[]) {
    const { lessons } = wordsOf("lessons");
    const ids = Object.keys(lessons) as Lesson[];
    const titles = ids.map((id, i) => made("th", [`${i + 1} ${lessons[id].title}`], { scope: "col" }));
    const [pupil, goals, learned] = [say("pupil"), say("goalsOf"), say("learnedNow")].map((name) => made("th", [name], { scope: "col" }));
    const head = made("tr", [pupil, ...titles, goals, learned, made("td", [])]);
    return made("table", [made("thead", [head]), made("tbody", pupils.map((it) => this.row(it, ids)))]);
  }

  /** @param ids - The lessons, one for each column. */
  row(pupil: Pupil, ids: Lesson[]) {
    const { lessons } = wordsOf("lessons");
    const cells = ids.map((id) => {
      const reached = pupil.goals[id] ?? [];
      const dots = lessons[id].goals.map((goal, i) => made("span", [reached.includes(i) ? "●" : "○"], { title: goal }));
      const said = say("goalsReached", { reached: reached.length, all: dots.length });
      const now: Record<string, string> = pupil.lesson === id && isHere(pupil) ? { "aria-current": "step", title: say("atStep", { step: pupil.step + 1 }) } : {};
      return made("td", [made("span", dots, { role: "img", "aria-label": said })], now);
    });
    const count = Object.values(pupil.goals).flat().length;
    const name = made("th", [pupil.name || "–"], { scope: "row", title: pupil.name });
    const all = [name, ...cells, made("td", [`${count}`], { class: "number" }), made("td", [memoryOf(pupil)]), made("td", this.buttons(pupil))];
    return made("tr", all, isHere(pupil) ? {} : { class: "away" });
  }

  buttons(pupil: Pupil) {
    const remove = buttonOf(say("removePupil"), () => this.post("remove", { key: pupil.key }));
    remove.setAttribute("aria-label", say("removeNamed", { name: pupil.name }));
    const run = made("a", [say("showRun")], { href: `/${pupil.link}`, target: "_blank", rel: "noopener" });
    run.setAttribute("aria-label", say("showRunOf", { name: pupil.name }));
    return pupil.link ? [run, " ", remove] : [remove];
  }

  async takeCode(event: Event) {
    event.preventDefault();
    const [name, code] = ["code-name", "code"].map((id) => typedById(id, HTMLInputElement));
    if (!(await this.post("code", { name: name.value, code: code.value }))) return;
    name.value = code.value = "";
    name.focus();
  }

  /** Sends an order; true if it was carried out. */
  async post(what: string, said: object) {
    const answer = await fetch(what, { method: "POST", body: JSON.stringify(said) });
    const isDone = answer.ok && (await answer.json()).done;
    setText(byId("code-news"), isDone ? "" : say(answer.ok ? "codeWrong" : "noConnection"));
    if (isDone && document.activeElement instanceof HTMLElement && byId("class").contains(document.activeElement)) document.activeElement.blur();
    return isDone;
  }
}

function isHere({ silent_s }: Pupil) {
  return silent_s !== null && silent_s < SILENT_S;
}

function memoryOf({ memory }: Pupil) {
  const { patterns, sides } = robotWords();
  const cells = memory.slice(1).map((side, i) =>
    made("span", [ARROWS[side]], { "data-side": SIDES[side], title: `${patterns[i + 1]}: ${sides[side]}` }));
  return made("span", cells, { class: "memory" });
}

function showJoin({ urls, modules }: { urls: string[]; modules: string[] }) {
  byId("urls").replaceChildren(...urls.map((url) => {
    const [, home, code] = /^([^/]+\/)([^/]+)$/.exec(url) ?? ["", url, ""];
    return made("li", [home, made("b", [code])]);
  }));
  const canvas = typedById("qr", HTMLCanvasElement);
  canvas.hidden = modules.length === 0;
  drawModules(canvas, modules.length, (x, y) => modules[y][x] === "1");
}

Object.assign(window, { octet: new Board() });
