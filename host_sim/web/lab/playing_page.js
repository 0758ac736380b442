// @ts-check
/* A page that plays a run, forward and back: the tick that it shows, its buttons and its keys. */

import { byId, isForPage, setText, typedById } from "../core/elements.js";
import { inEachLanguage, say } from "../core/language.js";
import { Viewport } from "../draw/viewport.js";
import { explainMarks } from "../panel/timeline.js";

/**
 * A class that extends it says which ticks there are (`last`, `tickMs`), shows one (`show`), draws (`draw`, `drawMarks`),
 * and does what the buttons ask for (`jump`, `whatIf`).
 */
export class PlayingPage {
  /** @param {number} first - The first tick. */
  constructor(first) {
    this.first = first;
    /** The tick that is shown. */
    this.tick = first;
    /** The same with a fraction, while it plays. */
    this.exactTick = first;
    this.playing = false;
    /** @type {number | undefined} - When the last frame was drawn, ms. */
    this.frameAt = undefined;
    /** Whether there is anything new to draw. */
    this.stale = true;
    this.viewport = new Viewport(() => (this.stale = true));
    this.scrub = typedById("scrub", HTMLInputElement);
    this.marks = typedById("marks", HTMLCanvasElement);
    this.scrub.min = `${first}`;
    this.scrub.addEventListener("input", () => this.go(Number(this.scrub.value)));
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    byId("before").addEventListener("click", () => this.jump(-1));
    byId("after").addEventListener("click", () => this.jump(1));
    byId("what-if").addEventListener("click", () => this.whatIf());
    document.addEventListener("keydown", (event) => this.onKey(event));
    explainMarks();
    inEachLanguage(() => {
      this.showPlaying();
      this.stale = true;
    });
    new ResizeObserver(() => this.resize()).observe(this.marks);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.resize());
    requestAnimationFrame((now) => this.frame(now));
  }

  /** The last tick. */
  get last() {
    return this.first;
  }

  /** Length of a tick, ms of robot time. */
  get tickMs() {
    return Infinity;
  }

  /** Shows the tick. */
  show() {}

  draw() {}

  /** Draws the marks above the scrubber. */
  drawMarks() {}

  /** @param {number} _step - 1 for the next event of the chosen kind, -1 for the one before. */
  jump(_step) {}

  /** Opens "What if?" at this tick. */
  whatIf() {}

  resize() {
    this.drawMarks();
    this.stale = true;
  }

  /** @param {number} tick - One beyond the ends shows the end. */
  go(tick) {
    this.goAhead(Math.min(this.last, Math.max(this.first, tick)));
  }

  /** @param {number} tick - It may be there only later. */
  goAhead(tick) {
    this.exactTick = tick;
    this.tick = Math.floor(tick);
    this.show();
    this.stale = true;
  }

  /** @param {number} tick - To stay at. */
  seek(tick) {
    this.setPlaying(false);
    this.go(tick);
  }

  /** Something else is to be drawn at the same tick. */
  lightUp() {
    this.stale = true;
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing && this.tick >= this.last) this.go(this.first);
    this.playing = playing;
    this.frameAt = undefined;
    this.showPlaying();
    this.stale = true;
  }

  showPlaying() {
    setText(byId("play"), say(this.playing ? "pause" : "play"));
  }

  /** @param {number} now */
  frame(now) {
    if (this.playing) this.advance(now);
    if (this.stale) {
      this.stale = false;
      this.draw();
    }
    requestAnimationFrame((next) => this.frame(next));
  }

  /** @param {number} now */
  advance(now) {
    const speed = Number(typedById("speed", HTMLSelectElement).value);
    const passed = ((now - (this.frameAt ?? now)) / this.tickMs) * speed;
    this.frameAt = now;
    this.go(this.exactTick + passed);
    if (this.tick >= this.last) this.setPlaying(false);
  }

  /** @param {string} clock - The robot time that is shown. */
  showTime(clock) {
    this.scrub.max = `${this.last}`;
    this.scrub.value = `${this.tick}`;
    this.scrub.setAttribute("aria-valuetext", clock);
    setText(byId("clock"), clock);
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    if (!this.takesKey(event)) return;
    const action = this.actions(event.shiftKey ? Math.round(1000 / this.tickMs) : 1)[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** @param {KeyboardEvent} event - Of a key that may be meant for the page. */
  takesKey(event) {
    return isForPage(event, event.key === " " ? "select, button" : "select");
  }

  /**
   * What each key does.
   * @param {number} step - Ticks that an arrow goes.
   * @returns {Record<string, () => void>}
   */
  actions(step) {
    return {
      " ": () => this.setPlaying(!this.playing),
      arrowright: () => this.go(this.tick + step),
      arrowleft: () => this.go(this.tick - step),
      home: () => this.go(this.first),
      end: () => this.go(this.last),
      n: () => this.jump(1),
    };
  }
}
