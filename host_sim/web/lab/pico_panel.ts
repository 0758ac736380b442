/* Runs a Pico's flash image in rp2040js beside the page's robot, and shows both robots' frames. */

import { buttonOf, byId, made, setText } from "../core/dom.js";
import { heard, inEachLanguage, wordsOf } from "../core/language.js";
import { inflate } from "../core/packed_columns.js";
import { filled } from "../core/phrases.js";
import { FRAMES } from "../generated.js";
import type { Pair, Progress } from "../sim/pico_worker.js";
import type { Laboratory } from "./laboratory.js";

/** The worker's script and the flash image, packed. */
type PicoParts = { worker: string; image: string };

/** Across both columns of the fields. */
const WIDE = "grid-column: 1 / -1";

/** Stands at the end of the tab "Run". */
export class PicoPanel {
  worker: Worker | undefined;
  progress: Progress | undefined;
  /** Why it does not run, in the language of the page. */
  why = () => "";
  legend = made("legend", []);
  button = buttonOf("", () => (this.worker ? this.stop() : this.start()));
  verdict = made("p", [], { id: "pico-verdict", role: "status", style: WIDE });
  head = made("tr", []);
  rows = made("tbody", []);
  table = made("table", [made("thead", [this.head]), this.rows], { style: WIDE });

  constructor(readonly lab: Laboratory, readonly parts: PicoParts) {
    this.button.id = "run-pico";
    byId("panel-run").append(made("fieldset", [this.legend, this.button, this.verdict, this.table], { class: "fields" }));
    inEachLanguage(() => this.show());
  }

  /** Compares the frames of the selected run, from its beginning. */
  async start() {
    this.progress = undefined;
    this.button.disabled = true; // until there is something to stop
    const worker = new Worker(URL.createObjectURL(new Blob([await inflate(this.parts.worker)], { type: "text/javascript" })));
    this.button.disabled = false;
    Object.assign(this, { worker, why: () => "" });
    worker.addEventListener("message", ({ data }) => this.take(data));
    this.show();
    try {
      const { lane: { experiment }, simulator, tickMs } = this.lab;
      if (experiment.robots[0].program !== undefined) return this.fail(() => wordsOf("pico").noProgram);
      const log = await simulator.ask("log", { experiment });
      worker.postMessage({ image: await inflate(this.parts.image), log: await new Blob(log).text(), tickMs });
    } catch (error) {
      this.fail(() => heard(error instanceof Error ? error.message : `${error}`));
    }
  }

  fail(why: () => string) {
    this.why = why;
    this.stop();
  }

  stop() {
    this.worker?.terminate();
    this.worker = undefined;
    this.show();
  }

  take(news: Progress | { error: string }) {
    if ("error" in news) return this.fail(() => heard(news.error));
    this.progress = news;
    if (news.done) this.stop();
    else this.show();
  }

  show() {
    const { progress, worker } = this;
    const words = wordsOf("pico");
    setText(this.legend, words.title);
    setText(this.button, worker ? words.stop : words.start);
    setText(this.verdict, this.why() || (progress ? verdictOf(progress) : worker ? words.begins : words.what));
    this.head.replaceChildren(...[words.tick, words.frame, words.page, words.image].map((name) => made("th", [name])));
    this.rows.replaceChildren(...(progress?.differs ?? progress?.newest ?? []).map(rowOf));
    this.table.hidden = !progress;
  }
}

function verdictOf({ ticks, frames, equal, speed, differs }: Progress) {
  const words = wordsOf("pico");
  const counts = filled(words.equal, { equal, frames, ticks, speed: speed.toFixed(1) });
  return differs ? `${filled(words.differs, { tick: differs[0].tick })} ${counts}` : counts;
}

function rowOf({ tick, page, pico }: Pair) {
  const id = parseInt(page || pico, 16);
  const [name = ""] = Object.entries(FRAMES).find(([, base]) => base === id) ?? [];
  const frames = [page, pico].map((frame) => made("td", [made("code", [frame || "–"])]));
  return made("tr", [made("td", [`${tick}`]), made("td", [name]), ...frames]);
}
