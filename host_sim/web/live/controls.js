// @ts-check
/* The live page's buttons and keys for time, memory and run. */

import { byId, isForPage, setText, typedById } from "../core/elements.js";
import { ending } from "../core/endings.js";
import { inEachLanguage, robotWords, say } from "../core/language.js";
import { decimal } from "../core/phrases.js";
import { lookBack } from "./connection.js";

/** @type {Record<string, string>} */
const KEYS = { " ": "play", ".": "decision", n: "next", w: "what-if" };
/** The controls without effect once the run is over. */
const NEEDS_A_RUN = ["play", "decision", "lift", "add-bar", "add-plant", "break"];

/** Sends what a person asks for, and shows how things stand. */
export class Controls {
  /** @param {(command: Command) => void} send */
  constructor(send) {
    this.send = send;
    this.playing = true;
    this.frozen = 0;
    this.node = 0;
    this.speed = typedById("speed", HTMLSelectElement);
    this.seed = typedById("seed", HTMLInputElement);
    this.keep = typedById("keep", HTMLInputElement);
    this.scrub = typedById("scrub", HTMLInputElement);
    this.isScrubbed = false;
    this.bindButtons();
    inEachLanguage(() => this.showFrozen(this.frozen));
    document.addEventListener("keydown", (event) => this.onKey(event));
  }

  /**
   * @param {Scene} scene
   * @param {Play} play
   */
  show(scene, play) {
    const { state, environment, measures } = scene;
    if (!this.isScrubbed) this.showTime(state.tick);
    setText(byId("clock"), scene.clock(Number(this.scrub.value)));
    this.playing = play.playing;
    this.node = state.node;
    this.showFrozen(state.frozen);
    setText(byId("play"), say(play.playing ? "pause" : "play"));
    setText(byId("status"), statusOf(play));
    const rate = (play.rate * measures.tick_ms) / 1000;
    setText(byId("fact-speed"), `${rate ? decimal(rate, 1, robotWords()) : 0} ×`);
    for (const id of NEEDS_A_RUN) typedById(id, HTMLButtonElement).disabled = play.done;
    typedById("next", HTMLButtonElement).disabled = play.done || environment.number >= environment.of;
    showEnding(play);
    if (document.activeElement !== this.speed) this.speed.value = `${play.speed}`;
    const empty = this.seed.value === "" && document.activeElement !== this.seed;
    if (empty) this.seed.value = `${environment.seed + 1}`;
  }

  /** @param {number} frozen */
  showFrozen(frozen) {
    this.frozen = frozen;
    byId("freeze").setAttribute("aria-pressed", `${Boolean(frozen)}`);
    setText(byId("freeze"), say(frozen ? "frozen" : "freeze"));
  }

  /** @param {number} tick - The present, at the end of the slider. */
  showTime(tick) {
    this.scrub.max = `${tick}`;
    this.scrub.value = this.scrub.max;   // after its bound, which it cannot pass
  }

  bindButtons() {
    const on = (/** @type {string} */ id, /** @type {() => Command} */ command) =>
      byId(id).addEventListener("click", () => this.send(command()));
    on("play", () => ({ do: this.playing ? "pause" : "play" }));
    on("decision", () => ({ do: "decision" }));
    on("next", () => ({ do: "next" }));
    on("erase", () => ({ do: "erase", node: this.node }));
    on("freeze", () => ({ do: "freeze", node: this.node, on: 1 - this.frozen }));
    byId("what-if").addEventListener("click", () => lookBack("what-if"));
    this.scrub.addEventListener("input", () => (this.isScrubbed = true));
    this.scrub.addEventListener("change", () => lookBack(`tick=${this.scrub.value}`));
    this.speed.addEventListener("change", () => {
      this.send({ do: "speed", factor: Number(this.speed.value) });
      this.speed.blur();
    });
    byId("seed-form").addEventListener("submit", (event) => this.startOver(event));
  }

  /** @param {SubmitEvent} event */
  startOver(event) {
    event.preventDefault();
    this.send({ do: "seed", seed: Number(this.seed.value), keep: Number(this.keep.checked) });
    this.seed.value = "";
    this.seed.blur();
  }

  /**
   * Keys work wherever they do not mean something else already.
   * @param {KeyboardEvent} event
   */
  onKey(event) {
    const id = KEYS[event.key.toLowerCase()];
    const fields = event.key === " " ? "input, select, summary, button" : "input, select, summary";
    if (id === undefined || !isForPage(event, fields)) return;
    event.preventDefault();
    const button = typedById(id, HTMLButtonElement);
    if (!button.disabled) button.click();
  }
}

/**
 * Says over the arena how the environment ended, or the run.
 * @param {Play} play
 */
function showEnding({ ended, done }) {
  const [heading, text] = ended ? ending(ended, done) : ["", ""];
  setText(byId("banner"), ended ? `${heading}\n${text}` : "");
}

/** @param {Play} play */
function statusOf(play) {
  if (play.done) return say(play.stays ? "allDoneSeed" : "allDone");
  if (play.ended) return say("onToNext");
  return say(play.playing ? "live" : "paused");
}
