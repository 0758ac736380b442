/* A page that plays a run, forward and back: the tick that it shows, its buttons and its keys. */

import { byId, setText, typedById } from "../core/dom.js";
import { inEachLanguage, say } from "../core/language.js";
import { Viewport } from "../draw/viewport.js";
import { explainMarks } from "../panel/timeline.js";

export abstract class PlayingPage {
  /** The tick that is shown. */
  tick = this.first;
  /** The same with a fraction, while it plays. */
  exactTick = this.first;
  playing = false;
  /** When the last frame was drawn, ms. */
  frameAt: number | undefined;
  /** Whether there is anything new to draw. */
  stale = true;
  viewport = new Viewport(() => (this.stale = true));
  scrub = typedById("scrub", HTMLInputElement);
  marks = typedById("marks", HTMLCanvasElement);

  /** @param first - The first tick. */
  constructor(public first: number) {
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
  abstract get last(): number;

  /** Length of a tick, ms of robot time. */
  abstract get tickMs(): number;

  /** Shows the tick. */
  abstract show(): void;
  abstract draw(): void;

  /** Draws the marks above the scrubber. */
  abstract drawMarks(): void;

  /** @param step - 1 for the next event of the chosen kind, -1 for the one before. */
  abstract jump(step: number): void;

  /** Opens "What if?" at this tick. */
  abstract whatIf(): void;

  /** Whether a key is meant for the page. */
  abstract takesKey(event: KeyboardEvent): boolean;

  resize() {
    this.drawMarks();
    this.stale = true;
  }

  /** Shows a tick; beyond the ends it shows the end. */
  go(tick: number) {
    this.goAhead(Math.min(this.last, Math.max(this.first, tick)));
  }

  /** Shows a tick, which may not be simulated yet. */
  goAhead(tick: number) {
    this.exactTick = tick;
    this.tick = Math.floor(tick);
    this.show();
    this.stale = true;
  }

  /** Shows a tick, and pauses. */
  seek(tick: number) {
    this.setPlaying(false);
    this.go(tick);
  }

  /** Draws the same tick again, since something else in it is to be shown. */
  lightUp() {
    this.stale = true;
  }

  setPlaying(playing: boolean) {
    if (playing && this.tick >= this.last) this.go(this.first);
    this.playing = playing;
    this.frameAt = undefined;
    this.showPlaying();
    this.stale = true;
  }

  showPlaying() {
    setText(byId("play"), say(this.playing ? "pause" : "play"));
  }

  frame(now: number) {
    if (this.playing) this.advance(now);
    if (this.stale) {
      this.stale = false;
      this.draw();
    }
    requestAnimationFrame((next) => this.frame(next));
  }

  advance(now: number) {
    const speed = Number(typedById("speed", HTMLSelectElement).value);
    const passed = ((now - (this.frameAt ?? now)) / this.tickMs) * speed;
    this.frameAt = now;
    this.go(this.exactTick + passed);
    if (this.tick >= this.last) this.setPlaying(false);
  }

  /** @param clock - The robot time that is shown. */
  showTime(clock: string) {
    this.scrub.max = `${this.last}`;
    this.scrub.value = `${this.tick}`;
    this.scrub.setAttribute("aria-valuetext", clock);
    setText(byId("clock"), clock);
  }

  onKey(event: KeyboardEvent) {
    if (!this.takesKey(event)) return;
    const action = this.actions(event.shiftKey ? Math.round(1000 / this.tickMs) : 1)[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /**
   * What each key does.
   * @param step - Ticks that an arrow goes.
   */
  actions(step: number): Record<string, () => void> {
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
