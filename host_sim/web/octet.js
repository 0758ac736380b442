// @ts-check
/* octet.html: runs of the real firmware in this page, side by side; what a person changes makes another future. */

import { Desk } from "./desk.js";
import { byId, isForPage, setText, typedById } from "./elements.js";
import { Lane, experimentOf, restartNames } from "./lane.js";
import { nextTick } from "./lane_events.js";
import { LabEditor } from "./lab_editor.js";
import { Course } from "./lessons/course.js";
import { Note } from "./note.js";
import { Panel } from "./panel.js";
import { partingWords } from "./parting.js";
import { RobotPicker } from "./robot_picker.js";
import { Simulator } from "./simulator.js";
import { drawMarks } from "./timeline.js";

/**
 * @typedef {import("./types.js").Change} Change
 * @typedef {import("./types.js").Experiment} Experiment
 *
 * A recorded run that the page begins with: the tick and the robot that are shown.
 * @typedef {{recorded: import("./log_opening.js").RecordedRun, tick: number, node: number}} Begin
 */

const LANES_MAX = 4;

/** The page: its lanes, the time that all of them show, and the lane that is selected. */
class LabPage {
  /**
   * @param {{wasm: string, worlds: import("./worlds.js").Worlds}} parts
   * @param {Begin | null} begin - What to begin with; null for a new run.
   */
  constructor({ wasm, worlds }, begin) {
    this.worlds = worlds;
    this.params = worlds.random;
    this.simulator = new Simulator(Uint8Array.from(atob(wasm), (letter) => letter.charCodeAt(0)).buffer, worlds);
    this.tick = this.exactTick = 0;
    this.playing = false;
    /** @type {number | undefined} */
    this.frameAt = undefined;
    this.stale = true;
    /** The runs, and what they were simulated from, that the words about their parting are of. */
    this.partingKey = "";
    this.note = new Note();
    /** @type {Lane[]} */
    this.lanes = [];
    const first = experimentOf({ seed: 1, environments: 5, robots: 1, profile: "article" });
    this.lane = this.addLane(begin ? { ...first, ticks_max: 1 } : first);
    this.scrub = typedById("scrub", HTMLInputElement);
    this.marks = typedById("marks", HTMLCanvasElement);
    this.panel = new Panel((cell, side) => this.change({ do: "write", robot: this.lane.robot, cell, side }));
    this.desk = new Desk(this);
    this.course = new Course(this);
    /** @type {RobotPicker | undefined} */
    this.picker = undefined;
    /** @type {LabEditor | undefined} */
    this.editor = undefined;
    this.bind();
    new ResizeObserver(() => this.onResize()).observe(this.marks);
    requestAnimationFrame((now) => this.frame(now));
    /** Settled when a recorded run that the page begins with, and its copy, are simulated to their ends. */
    this.repeated = begin ? this.repeat(begin) : Promise.resolve();
  }

  /**
   * Simulates a recorded run again, and lays a copy beside it.
   * @param {Begin} begin
   */
  async repeat({ recorded, tick, node }) {
    this.begin(await this.simulator.repeat(recorded));
    await this.lane.done;
    this.go(tick);
    this.whatIf();
    await this.lane.done;
    this.pick(node);
  }

  /** The scene that is selected; undefined before the first run. */
  get scene() {
    return this.lane.scene;
  }

  bind() {
    this.scrub.addEventListener("input", () => this.go(Number(this.scrub.value)));
    byId("play").addEventListener("click", () => this.setPlaying(!this.playing));
    byId("before").addEventListener("click", () => this.jump(-1));
    byId("after").addEventListener("click", () => this.jump(1));
    byId("what-if").addEventListener("click", () => this.whatIf());
    document.addEventListener("keydown", (event) => this.onKey(event));
  }

  /**
   * Adds a run beside the others, and simulates it.
   * @param {Experiment} experiment
   */
  addLane(experiment) {
    const lane = new Lane(experiment, byId("floors"));
    this.lanes.push(lane);
    lane.canvas.addEventListener("pointerdown", () => this.select(lane), { capture: true });
    lane.canvas.addEventListener("focus", () => this.select(lane));
    this.onLanes();
    this.simulate(lane);
    return lane;
  }

  /** @param {Lane} lane */
  removeLane(lane) {
    if (this.lanes.length < 2) return;
    lane.remove();
    this.lanes = this.lanes.filter((other) => other !== lane);
    this.select(this.lanes[0]);
    this.onLanes();
  }

  /**
   * Begins anew with one run.
   * @param {Experiment} experiment
   */
  begin(experiment) {
    const old = this.lanes;
    this.lanes = [];
    old.forEach((lane) => lane.remove());
    restartNames();
    this.tick = this.exactTick = 0;
    this.setPlaying(false);
    this.select(this.addLane(experiment));
  }

  onLanes() {
    byId("floors").dataset.lanes = `${this.lanes.length}`;
    typedById("remove-lane", HTMLButtonElement).disabled = this.lanes.length < 2;
    typedById("what-if", HTMLButtonElement).disabled = this.lanes.length >= LANES_MAX;
    this.stale = true;
  }

  /** @param {Lane} lane */
  select(lane) {
    if (lane === this.lane) return;
    this.lane = lane;
    this.onScene();
  }

  /** Another scene is selected, or another robot. */
  onScene() {
    const { scene } = this.lane;
    this.stale = true;
    this.onResize();
    if (!scene) return;
    this.picker ??= new RobotPicker(scene, (node) => this.pick(node));
    this.picker.scene = scene;
    this.editor ??= new LabEditor(this, scene);
    this.editor.scene = scene;
    for (const lane of this.lanes) this.editor.watch(lane);
  }

  /** @param {number} node */
  pick(node) {
    if (this.scene) this.scene.node = node;
    this.onScene();
  }

  onResize() {
    const { data, robot } = this.lane;
    if (data) drawMarks(this.marks, data.robots[robot], { first: 0, last: this.last });
    this.stale = true;
  }

  /** Copies the selected run beside it; what is changed next is changed there. */
  whatIf() {
    if (this.lanes.length >= LANES_MAX) return;
    this.setPlaying(false);
    const { experiment } = this.lane;
    this.select(this.addLane({ ...experiment, changes: [...experiment.changes], ticks_max: undefined }));
    this.note.show("Change a cell, an obstacle, the behaviour or a parameter: this copy runs on from here with it.");
  }

  /**
   * Simulates a run anew, and goes on showing what it shows.
   * @param {Lane} lane
   */
  simulate(lane) {
    let onDone = () => {};
    lane.done = new Promise((resolve) => (onDone = resolve));
    this.simulator.run(lane, lane.experiment, ({ run, refusals, error, done }) => {
      if (done) onDone();
      if (error) this.note.show(error);
      if (!run) return;
      const isFirst = !lane.scene;
      lane.take(run);
      lane.go(this.tick, true);
      if (isFirst || lane === this.lane) this.onScene();
      for (const [place, why] of refusals ?? []) this.refuse(lane, place, why);
      if (done) this.onResize();
      setText(byId("status"), done ? "the real firmware, in this page" : "running ahead");
    });
  }

  /**
   * A change could not be made: it goes.
   * @param {Lane} lane
   * @param {number} place - Of the change among the experiment's.
   * @param {string} why
   */
  refuse(lane, place, why) {
    this.note.show(why);
    this.editor?.onRefusal();
    const changes = lane.experiment.changes.filter((_, i) => i !== place);
    lane.experiment = { ...lane.experiment, changes };
    this.simulate(lane);
  }

  /**
   * Makes a change in the selected run, before the tick that is shown next.
   * @param {Change} change
   */
  change(change) {
    const { lane } = this;
    const isFresh = lane.experiment.changes.some(({ tick }) => tick === this.tick) && !this.playing;
    const tick = Math.min(isFresh ? this.tick : this.tick + 1, lane.last);
    lane.change({ ...change, tick });
    this.go(tick);
    this.simulate(lane);
  }

  /** The last tick of all runs. */
  get last() {
    return Math.max(0, ...this.lanes.map((lane) => lane.last));
  }

  /**
   * Shows a tick.
   * @param {number} tick
   */
  go(tick) {
    this.tick = Math.min(this.last, Math.max(0, Math.floor(tick)));
    for (const lane of this.lanes) lane.go(this.tick, false);
    this.stale = true;
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing && this.tick >= this.last) this.go(0);
    this.playing = playing;
    this.exactTick = this.tick;
    this.frameAt = undefined;
    setText(byId("play"), playing ? "Pause" : "Play");
    this.stale = true;
  }

  /** @param {number} step - 1 for the next event of the chosen kind, -1 for the one before. */
  jump(step) {
    const { data, robot } = this.lane;
    if (!data) return;
    const kind = typedById("kind", HTMLSelectElement).value;
    const tick = nextTick(data.robots[robot], kind, this.tick, step);
    if (tick === undefined) {
      this.note.show(`There is no ${step > 0 ? "later" : "earlier"} ${kind}.`);
      return;
    }
    this.setPlaying(false);
    this.go(tick);
  }

  /** @param {number} now */
  frame(now) {
    if (this.playing) this.advance(now);
    if (this.stale || this.editor?.changed) this.draw();
    requestAnimationFrame((next) => this.frame(next));
  }

  /** @param {number} now */
  advance(now) {
    const speed = Number(typedById("speed", HTMLSelectElement).value);
    this.exactTick += ((now - (this.frameAt ?? now)) / (this.params.tick_s * 1000)) * speed;
    this.frameAt = now;
    this.go(this.exactTick);
    if (this.tick >= this.last) this.setPlaying(false);
  }

  draw() {
    const { lane, lanes, tick } = this;
    const { scene, data } = lane;
    this.stale = false;
    if (!scene || !data) return;
    this.editor?.beforeDrawing();
    for (const each of lanes) {
      if (each.scene) this.panel.settle(each.scene, !this.playing);
      each.draw(tick);
      each.figure.classList.toggle("selected", each === lane);
    }
    this.panel.settle(scene, !this.playing);
    this.panel.show(scene, { exact: !this.playing, ...this.otherMemory() });
    this.picker?.show();
    this.desk.show();
    setText(byId("news"), scene.lastNews);
    this.course.show();
    this.showParting();
    this.scrub.max = `${this.last}`;
    this.scrub.value = `${tick}`;
    this.scrub.setAttribute("aria-valuetext", scene.clock(tick));
  }

  /** The memory in the first other run, to compare with. */
  otherMemory() {
    const other = this.lanes.find((lane) => lane !== this.lane && lane.scene);
    const states = other?.scene?.states ?? [];
    return { then: states[Math.min(this.lane.robot, states.length - 1)]?.memory, where: `in ${other?.name}` };
  }

  showParting() {
    const [first, ...others] = this.lanes;
    const other = this.lane === first ? others[0] : this.lane;
    const key = other ? `${first.name}${first.version} ${other.name}${other.version}` : "";
    if (this.partingKey === key) return;
    this.partingKey = key;
    setText(byId("parting"), other ? partingWords(first, other) : "");
  }

  /** @param {KeyboardEvent} event */
  onKey(event) {
    const inArena = event.target instanceof HTMLCanvasElement;
    const fields = event.key === " " ? "select, button, input, summary" : "select, input:not(#scrub), [role=tab]";
    if (!isForPage(event, fields) || event.defaultPrevented || (inArena && event.key.startsWith("Arrow"))) return;
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
    const step = shiftKey ? Math.round(1 / this.params.tick_s) : 1;
    /** @type {Record<string, () => void>} */
    const actions = {
      " ": () => this.setPlaying(!this.playing),
      arrowright: () => this.go(this.tick + step),
      arrowleft: () => this.go(this.tick - step),
      home: () => this.go(0),
      end: () => this.go(this.last),
      n: () => this.jump(1),
      b: () => this.jump(-1),
    };
    return actions[key.toLowerCase()];
  }
}

try {
  const [parts, begin] = ["parts", "begin"].map((id) => JSON.parse(byId(id).textContent || "null"));
  Object.assign(window, { octet: new LabPage(parts, begin) });
} catch (error) {
  setText(byId("status"), error instanceof Error ? error.message : `${error}`);
}
