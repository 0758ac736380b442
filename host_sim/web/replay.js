/* The kept page: plays a recorded run, forward and back, and compares its memory at two times. */

import { Panel, byId } from "./panel.js";
import { Renderer } from "./renderer.js";
import { RunData } from "./run_data.js";
import { drawMarks } from "./timeline.js";
import { Trail } from "./trail.js";
import { clock, lessonWords } from "./words.js";

/** Shows one run; `go` shows its state at a tick. */
class Player {
  /** @param {RunData} data */
  constructor(data) {
    Object.assign(this, { data, tick: data.first, playing: false, then: undefined, pinned: undefined });
    this.renderer = new Renderer(byId("arena"));
    this.panel = new Panel();
    this.scene = { measures: data.measures, trail: new Trail() };
    this.bind();
    this.go(data.first);
    new ResizeObserver(() => this.resize()).observe(byId("marks"));
    requestAnimationFrame((now) => this.frame(now));
  }

  bind() {
    const scrub = byId("scrub");
    [scrub.min, scrub.max] = [this.data.first, this.data.last];
    scrub.addEventListener("input", () => this.go(Number(scrub.value)));
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    byId("before").addEventListener("click", () => this.jump(-1));
    byId("after").addEventListener("click", () => this.jump(1));
    byId("pin").addEventListener("click", () => this.pin());
    document.addEventListener("keydown", (event) => this.press(event));
  }

  resize() {
    drawMarks(byId("marks"), this.data);
    this.stale = true;
  }

  /** Shows a tick; one beyond the ends shows the end. */
  go(tick) {
    const { data, scene } = this;
    const before = this.tick;
    this.tick = Math.min(data.last, Math.max(data.first, Math.floor(tick)));
    const environment = data.sceneAt(this.tick);
    const onward = scene.state && this.tick >= before && environment.first_tick === scene.environment.first_tick;
    if (onward) data.addTrail(scene.trail, before + 1, this.tick);
    else data.trailAt(this.tick, scene.trail);
    scene.environment = environment;
    scene.state = data.stateAt(this.tick);
    this.stale = true;
  }

  setPlaying(playing) {
    if (playing && this.tick === this.data.last) this.go(this.data.first);
    this.playing = playing;
    this.exactTick = this.tick;
    this.frameAt = undefined;
    byId("play").textContent = this.playing ? "Pause" : "Play";
    this.stale = true;
  }

  jump(step) {
    const kind = byId("kind").value;
    const tick = this.data.eventFrom(kind, this.tick, step);
    const none = `no ${step > 0 ? "later" : "earlier"} ${kind}`;
    byId("status").textContent = tick === undefined ? none : this.data.run.title;
    if (tick === undefined) return;
    this.setPlaying(false);
    this.go(tick);
  }

  /** Holds the memory of now against that of other times; once more lets go of it. */
  pin() {
    this.pinned = this.pinned === undefined ? this.tick : undefined;
    this.then = this.pinned === undefined ? undefined : this.data.memoryAt(this.pinned);
    const pinned = this.pinned !== undefined;
    byId("pin").textContent = pinned ? `Compared with ${clock(this.pinned, this.data.measures)}` : "Compare with now";
    byId("pin").setAttribute("aria-pressed", `${pinned}`);
    this.stale = true;
  }

  frame(now) {
    if (this.playing) this.advance(now);
    if (this.stale) this.draw();
    requestAnimationFrame((next) => this.frame(next));
  }

  advance(now) {
    const ticks = ((now - (this.frameAt ?? now)) / this.data.measures.tick_ms) * Number(byId("speed").value);
    this.frameAt = now;
    this.exactTick += ticks;
    this.go(this.exactTick);
    if (this.tick === this.data.last) this.setPlaying(false);
  }

  draw() {
    this.stale = false;
    this.renderer.draw(this.scene);
    this.panel.show(this.scene, { exact: !this.playing, then: this.then });
    const scrub = byId("scrub");
    scrub.value = this.tick;
    scrub.setAttribute("aria-valuetext", clock(this.tick, this.data.measures));
    this.showLessons();
  }

  showLessons() {
    const lessons = this.data.lessonsUpTo(this.tick);
    if (this.lessons === lessons.length) return;
    this.lessons = lessons.length;
    byId("lessons").replaceChildren(...lessons.reverse().map((lesson) => this.lessonItem(lesson)));
  }

  lessonItem(lesson) {
    const item = document.createElement("li");
    item.textContent = `${clock(lesson.tick, this.data.measures)} ${lessonWords(lesson)}`;
    return item;
  }

  press(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select")) return;
    const action = this.actionOf(event);
    if (!action) return;
    event.preventDefault();
    action();
  }

  actionOf({ key, shiftKey, target }) {
    const step = shiftKey ? Math.round(1000 / this.data.measures.tick_ms) : 1;
    if (key === " ") return target.closest("button") ? undefined : () => this.setPlaying(!this.playing);
    return {
      arrowright: () => this.go(this.tick + step),
      arrowleft: () => this.go(this.tick - step),
      home: () => this.go(this.data.first),
      end: () => this.go(this.data.last),
      n: () => this.jump(1),
      p: () => this.jump(-1),
    }[key.toLowerCase()];
  }
}

async function start() {
  const text = byId("run").textContent;
  if (!text) throw new Error("This page has no run in it: tools/octet replay RUN.LOG --html makes one that has.");
  const run = JSON.parse(text);
  byId("status").textContent = run.title;
  window.octet = new Player(await RunData.from(run));
}

start().catch((error) => (byId("status").textContent = error.message));
