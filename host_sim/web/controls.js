/* The live page's buttons and keys for time, memory and run. */

import { byId } from "./panel.js";

const KEYS = { " ": "play", ".": "decision", n: "next" };

/** Sends what a person asks for, and shows how things stand. */
export class Controls {
  /** @param {(order: Object) => void} send */
  constructor(send) {
    this.send = send;
    this.playing = true;
    this.frozen = 0;
    this.bindButtons();
    document.addEventListener("keydown", (event) => this.press(event));
  }

  /** @param {Object} scene - With `play` as in host_sim/live/feed.py. */
  show({ play, state, environment, measures }) {
    this.playing = play.playing;
    this.showFrozen(state.frozen);
    setText(byId("play"), play.playing ? "Pause" : "Play");
    setText(byId("status"), statusOf(play));
    setText(byId("fact-speed"), play.rate ? `${((play.rate * measures.tick_ms) / 1000).toFixed(1)} ×` : "0 ×");
    for (const id of ["play", "decision", "next"]) byId(id).disabled = play.done;
    const speed = byId("speed");
    if (document.activeElement !== speed) speed.value = `${play.speed}`;
    const seed = byId("seed");
    if (seed.value === "" && document.activeElement !== seed) seed.value = `${environment.seed + 1}`;
  }

  showFrozen(frozen) {
    if (frozen === this.frozen) return;
    this.frozen = frozen;
    byId("freeze").setAttribute("aria-pressed", `${Boolean(frozen)}`);
    setText(byId("freeze"), frozen ? "Learning is frozen" : "Freeze learning");
  }

  bindButtons() {
    const on = (id, order) => byId(id).addEventListener("click", () => this.send(order()));
    on("play", () => ({ do: this.playing ? "pause" : "play" }));
    on("decision", () => ({ do: "decision" }));
    on("next", () => ({ do: "next" }));
    on("erase", () => ({ do: "erase" }));
    on("freeze", () => ({ do: "freeze", on: 1 - this.frozen }));
    byId("speed").addEventListener("change", (event) => {
      this.send({ do: "speed", factor: Number(event.target.value) });
      event.target.blur();
    });
    byId("seed-form").addEventListener("submit", (event) => this.startOver(event));
  }

  startOver(event) {
    event.preventDefault();
    this.send({ do: "seed", seed: Number(byId("seed").value) });
    byId("seed").value = "";
    byId("seed").blur();
  }

  /** Keys work wherever they do not mean something else already. */
  press(event) {
    const target = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest("input, select, summary")) return;
    if (event.key === " " && target.closest("button")) return;
    const id = KEYS[event.key.toLowerCase()];
    if (id === undefined) return;
    event.preventDefault();
    if (!byId(id).disabled) byId(id).click();
  }
}

function statusOf(play) {
  if (play.done) return play.stays ? "all done: start over with a seed" : "all done";
  return play.playing ? "live" : "paused";
}

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
