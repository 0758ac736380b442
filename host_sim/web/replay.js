// @ts-check
/* The page of a recorded run: plays it, forward and back, and compares its memory at two times. */

import { byId, isForPage, setText, typedById } from "./elements.js";
import { itemAt } from "./hit_testing.js";
import { LessonsView } from "./lessons_view.js";
import { Panel } from "./panel.js";
import { Renderer } from "./renderer.js";
import { ReplayWhatIf } from "./replay_what_if.js";
import { RobotPicker } from "./robot_picker.js";
import { RunData } from "./run_data.js";
import { Scene } from "./scene.js";
import { drawMarks } from "./timeline.js";

/** @typedef {import("./types.js").EventKind} EventKind */

/** Shows one run; `go` shows its state at a tick. */
class Player {
  /** @param {RunData} data */
  constructor(data) {
    this.data = data;
    this.tick = this.exactTick = data.first;
    this.playing = false;
    /**
     * The tick that the memory is compared with.
     * @type {number | undefined}
     */
    this.pinned = undefined;
    /**
     * When the last frame was drawn, ms.
     * @type {number | undefined}
     */
    this.frameAt = undefined;
    this.stale = true;
    this.scrub = typedById("scrub", HTMLInputElement);
    this.marks = typedById("marks", HTMLCanvasElement);
    this.renderer = new Renderer(typedById("arena", HTMLCanvasElement));
    this.panel = new Panel();
    this.lessonsView = new LessonsView();
    this.scene = new Scene(data.measures, data.sceneAt(data.first), data.statesAt(data.first));
    this.scene.news = data.run.news ?? [];
    this.picker = new RobotPicker(this.scene, (node) => this.select(node));
    this.laboratory = new ReplayWhatIf(data);
    data.trailsAt(data.first, this.scene.trails);
    this.bind();
    new ResizeObserver(() => this.resize()).observe(this.marks);
    requestAnimationFrame((now) => this.frame(now));
  }

  bind() {
    [this.scrub.min, this.scrub.max] = [`${this.data.first}`, `${this.data.last}`];
    this.scrub.addEventListener("input", () => this.go(Number(this.scrub.value)));
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    byId("before").addEventListener("click", () => this.jump(-1));
    byId("after").addEventListener("click", () => this.jump(1));
    byId("pin").addEventListener("click", () => this.pin());
    byId("what-if").addEventListener("click", () => this.whatIf());
    this.renderer.canvas.addEventListener("click", (event) => this.onClick(event));
    document.addEventListener("keydown", (event) => this.onKey(event));
  }

  /** The robot that is selected. */
  get robot() {
    return this.data.robots[this.scene.index];
  }

  /** @param {number} node */
  select(node) {
    this.scene.node = node;
    this.resize();
  }

  resize() {
    drawMarks(this.marks, this.robot, this.data);
    this.stale = true;
  }

  /**
   * Shows a tick; one beyond the ends shows the end.
   * @param {number} tick
   */
  go(tick) {
    const { data, scene } = this;
    const before = this.tick;
    this.tick = Math.min(data.last, Math.max(data.first, Math.floor(tick)));
    const environment = data.sceneAt(this.tick);
    const onward = this.tick >= before && environment.first_tick === scene.environment.first_tick;
    if (onward) data.addTrails(scene.trails, before + 1, this.tick);
    else data.trailsAt(this.tick, scene.trails);
    scene.environment = environment;
    scene.states = data.statesAt(this.tick);
    this.stale = true;
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing && this.tick === this.data.last) this.go(this.data.first);
    this.playing = playing;
    this.exactTick = this.tick;
    this.frameAt = undefined;
    byId("play").textContent = this.playing ? "Pause" : "Play";
    this.stale = true;
  }

  /** @param {number} step - 1 for the next event of the chosen kind, -1 for the one before. */
  jump(step) {
    const kind = /** @type {EventKind} */ (typedById("kind", HTMLSelectElement).value);
    const tick = this.robot.eventFrom(kind, this.tick, step);
    const none = `no ${step > 0 ? "later" : "earlier"} ${kind}`;
    setText(byId("status"), tick === undefined ? none : this.data.run.title);
    if (tick === undefined) return;
    this.setPlaying(false);
    this.go(tick);
  }

  /** Compares the memory of now with that of other times; once more ends that. */
  pin() {
    this.pinned = this.pinned === undefined ? this.tick : undefined;
    const words = this.pinned === undefined ? "Compare with now" : `Compared with ${this.scene.clock(this.pinned)}`;
    setText(byId("pin"), words);
    byId("pin").setAttribute("aria-pressed", `${this.pinned !== undefined}`);
    this.stale = true;
  }

  /** @returns {Promise<void>} */
  whatIf() {
    this.setPlaying(false);
    return this.laboratory.open(this.tick, this.scene.node);
  }

  /** @param {number} now */
  frame(now) {
    if (this.playing) this.advance(now);
    if (this.stale) this.draw();
    requestAnimationFrame((next) => this.frame(next));
  }

  /** @param {number} now */
  advance(now) {
    const speed = Number(typedById("speed", HTMLSelectElement).value);
    this.exactTick += ((now - (this.frameAt ?? now)) / this.data.measures.tick_ms) * speed;
    this.frameAt = now;
    this.go(this.exactTick);
    if (this.tick === this.data.last) this.setPlaying(false);
  }

  draw() {
    const { scene, robot, tick } = this;
    this.stale = false;
    this.panel.settle(scene, !this.playing);
    this.renderer.draw(scene);
    const then = this.pinned === undefined ? undefined : robot.memoryAt(this.pinned);
    this.panel.show(scene, { exact: !this.playing, then });
    this.picker.show();
    setText(byId("news"), scene.lastNews);
    this.lessonsView.show(scene, robot.lessonsUpTo(tick, scene.environment.start_tick));
    this.scrub.value = `${tick}`;
    this.scrub.setAttribute("aria-valuetext", scene.clock(tick));
  }

  /** @param {MouseEvent} event */
  onClick(event) {
    const item = itemAt(this.scene, this.renderer.placeOf(event));
    if (item?.kind === "robot") this.select(item.id);
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    if (this.laboratory.isOpen || !isForPage(event, event.key === " " ? "select, button" : "select")) return;
    const action = this.actionOf(event);
    if (!action) return;
    event.preventDefault();
    action();
  }

  /**
   * @param {KeyboardEvent} event
   * @returns {(() => void) | undefined}
   */
  actionOf({ key, shiftKey }) {
    const step = shiftKey ? Math.round(1000 / this.data.measures.tick_ms) : 1;
    /** @type {Record<string, () => void>} */
    const actions = {
      " ": () => this.setPlaying(!this.playing),
      arrowright: () => this.go(this.tick + step),
      arrowleft: () => this.go(this.tick - step),
      home: () => this.go(this.data.first),
      end: () => this.go(this.data.last),
      n: () => this.jump(1),
      p: () => this.jump(-1),
      w: () => this.whatIf(),
    };
    return actions[key.toLowerCase()];
  }
}

async function start() {
  const text = byId("run").textContent;
  if (!text) throw new Error("This page has no run in it: tools/octet replay RUN.LOG --html makes one that has.");
  const run = JSON.parse(text);
  setText(byId("status"), run.title);
  Object.assign(window, { octet: new Player(await RunData.from(run)) });
}

start().catch((error) => setText(byId("status"), error.message));
