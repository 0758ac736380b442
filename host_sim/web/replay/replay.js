// @ts-check
/* The page of a recorded run: plays it, forward and back, and compares its memory at two times. */

import { byId, setText, typedById } from "../core/elements.js";
import { heard, inEachLanguage, nameIn, say } from "../core/language.js";
import { itemAt } from "../edit/hit_testing.js";
import { LessonsView } from "../panel/lessons_view.js";
import { Panel } from "../panel/panel.js";
import { PlayingPage } from "./playing_page.js";
import { showTick } from "../draw/recorded_scene.js";
import { Renderer } from "../draw/renderer.js";
import { ReplayWhatIf } from "./replay_what_if.js";
import { RobotPicker } from "../panel/robot_picker.js";
import { RunData } from "../core/run_data.js";
import { Scene } from "../draw/scene.js";
import { drawMarks } from "../panel/timeline.js";
import { Conversations } from "../talk/conversation.js";
import { TalkBox } from "../talk/talk_box.js";

/** What is behind the address of a live run that has ended. */
const ENDED = "#ended";

/** Shows one run. */
class Player extends PlayingPage {
  /** @param {RunData} data */
  constructor(data) {
    super(data.first);
    this.data = data;
    /** @type {number | undefined} - The tick that the memory is compared with. */
    this.pinned = undefined;
    this.renderer = new Renderer(typedById("arena", HTMLCanvasElement), this.viewport);
    this.panel = new Panel();
    this.lessonsView = new LessonsView();
    this.scene = new Scene(data.measures, data.sceneAt(data.first), data.statesAt(data.first));
    this.scene.news = data.run.news ?? [];
    this.picker = new RobotPicker(this.scene, (node) => this.select(node));
    this.laboratory = new ReplayWhatIf(data);
    this.conversations = new Conversations();
    this.talk = new TalkBox(byId("talk"), this);
    data.trailsAt(data.first, this.scene.trails);
    byId("pin").addEventListener("click", () => this.pin());
    inEachLanguage(() => {
      this.showPin();
      setText(byId("status"), this.title);
    });
    this.renderer.canvas.addEventListener("click", (event) => this.onClick(event));
  }

  get title() {
    return location.hash === ENDED ? say("runRecorded") : heard(this.data.run.title);
  }

  /** Shows the tick that the run names; of a live run, does what the address asks for: the tick before which it was left, or its end. */
  followAddress() {
    if (!location.protocol.startsWith("http")) {
      this.go(this.data.run.shown ?? this.first);
      return;
    }
    const asked = new URLSearchParams(location.hash.slice(1));
    byId("to-live").hidden = location.hash === ENDED;
    byId("to-live").addEventListener("click", () => location.assign("/"));
    this.go(Number(asked.get("tick") ?? this.last));
    if (asked.has("what-if")) this.whatIf();
  }

  /** @override */
  get last() {
    return this.data.last;
  }

  /** @override */
  get tickMs() {
    return this.data.measures.tick_ms;
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

  /** @override */
  drawMarks() {
    drawMarks(this.marks, this.robot, this.data);
  }

  /** @override */
  show() {
    showTick(this.scene, this.data, this.tick, false);
  }

  /**
   * @override
   * @param {number} step
   */
  jump(step) {
    const kind = /** @type {EventKind} */ (typedById("kind", HTMLSelectElement).value);
    const tick = this.robot.eventFrom(kind, this.tick, step);
    const none = say(step > 0 ? "noLater" : "noEarlier", { kind: nameIn("kinds", kind) });
    setText(byId("status"), tick === undefined ? none : this.title);
    if (tick !== undefined) this.seek(tick);
  }

  /** Begins to compare the present memory with that of other times; called again, ends it. */
  pin() {
    this.pinned = this.pinned === undefined ? this.tick : undefined;
    this.showPin();
    byId("pin").setAttribute("aria-pressed", `${this.pinned !== undefined}`);
    this.stale = true;
  }

  showPin() {
    setText(byId("pin"), this.pinned === undefined ? say("compareNow") : say("comparedWith", { time: this.scene.clock(this.pinned) }));
  }

  /**
   * @override
   * @returns {Promise<void>}
   */
  whatIf() {
    this.setPlaying(false);
    return this.laboratory.open(this.tick, this.scene.node);
  }

  /** @override */
  draw() {
    const { scene, robot, tick } = this;
    this.panel.settle(scene, !this.playing);
    this.renderer.draw(scene);
    const then = this.pinned === undefined ? undefined : robot.memoryAt(this.pinned);
    this.panel.show(scene, { exact: !this.playing, then });
    this.picker.show();
    setText(byId("news"), scene.lastNews);
    this.lessonsView.show(scene, robot.lessonsUpTo(tick, scene.environment.start_tick));
    this.showTime(scene.clock(tick));
  }

  /**
   * @param {string} who
   * @param {string} sentence
   */
  async ask(who, sentence) {
    const about = { data: this.data, robot: this.scene.index, tick: this.tick, told: { starts: [], health: [] } };
    this.talk.answer(...(await this.conversations.ask(who, sentence, about)));
  }

  /** @param {MouseEvent} event */
  onClick(event) {
    const item = itemAt(this.scene, this.renderer.placeOf(event));
    if (item?.kind === "robot") this.select(item.id);
  }

  /**
   * @override
   * @param {KeyboardEvent} event
   */
  takesKey(event) {
    return !this.laboratory.isOpen && !(event.target === this.talk.line) && super.takesKey(event);
  }

  /**
   * @override
   * @param {number} step
   */
  actions(step) {
    return { ...super.actions(step), p: () => this.jump(-1), w: () => this.whatIf() };
  }
}

async function start() {
  const text = byId("run").textContent;
  if (!text) throw new Error("This page contains no run: tools/octet replay RUN.LOG --html writes one that does.");
  const run = JSON.parse(text);
  const player = new Player(await RunData.from(run));
  Object.assign(window, { octet: player });
  player.followAddress();
}

start().catch((error) => setText(byId("status"), heard(error.message)));
