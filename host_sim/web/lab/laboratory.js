// @ts-check
/* Runs side by side at the same tick: what is simulated, which one is selected, and what a person changes in it. */

import { byId, setText } from "../core/elements.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { ShownRun, restartNames } from "./shown_run.js";
import { Toast } from "../core/toast.js";
import { PlayingPage } from "../replay/playing_page.js";
import { Simulator } from "./simulator.js";

/**
 * What the page has in it: page.wasm and the worker's script, packed, the worlds, and the programs to choose from.
 * @typedef {{wasm: string, worker: string, worlds: Worlds, programs: Record<string, string>}} Parts
 */

const LANES_MAX = 4;

/** A class that extends it shows the runs: `onLanes`, `onScene` and `onRefusal` tell it what has changed. */
export class Laboratory extends PlayingPage {
  /**
   * @param {Parts} parts
   * @param {Experiment} experiment - The first run's.
   */
  constructor(parts, experiment) {
    super(0);
    const { worlds, programs } = parts;
    this.programs = programs;
    this.worlds = worlds;
    this.params = worlds.random;
    this.simulator = new Simulator(parts);
    this.note = new Toast();
    /** Whether the next run plays as soon as it is there. */
    this.playsNext = false;
    /** @type {ShownRun[]} */
    this.lanes = [];
    this.lane = this.addLane(experiment);
    inEachLanguage(() => this.showStatus());
  }

  /** Called when the number of runs has changed. */
  onLanes() {}

  /** Called when another scene or another robot is selected. */
  onScene() {}

  /** Called when a change was refused. */
  onRefusal() {}

  /**
   * The last tick of all runs; while one of them is simulated, the tick that is shown may still be beyond it.
   * @override
   * @returns {number}
   */
  get last() {
    const known = Math.max(0, ...this.lanes.map((lane) => lane.last));
    return this.lanes.some((lane) => lane.isRunning) ? Math.max(known, this.tick) : known;
  }

  /** @override */
  get tickMs() {
    return this.params.tick_s * 1000;
  }

  /** The scene that is selected; undefined before the first run. */
  get scene() {
    return this.lane.scene;
  }

  /** Whether there is no room for another run. */
  get isFull() {
    return this.lanes.length >= LANES_MAX;
  }

  /** @override */
  show() {
    for (const lane of this.lanes) lane.go(this.tick, false);
  }

  /** @param {Experiment} experiment - Of the run to add and to simulate. */
  addLane(experiment) {
    const lane = new ShownRun(experiment, byId("floors"), this.viewport);
    this.lanes.push(lane);
    lane.canvas.addEventListener("pointerdown", () => this.select(lane), { capture: true });
    lane.canvas.addEventListener("focus", () => this.select(lane));
    this.onLanes();
    this.simulate(lane);
    return lane;
  }

  /** @param {ShownRun} lane */
  removeLane(lane) {
    if (this.lanes.length < 2) return;
    this.drop(lane);
    this.lanes = this.lanes.filter((other) => other !== lane);
    this.select(this.lanes[0]);
    this.onLanes();
  }

  /** @param {ShownRun} lane - Is closed. */
  drop(lane) {
    lane.remove();
    this.simulator.queued.delete(lane);
  }

  /** @param {Experiment} experiment - Of the only run from now on. */
  begin(experiment) {
    const old = this.lanes;
    this.lanes = [];
    old.forEach((lane) => this.drop(lane));
    restartNames();
    this.setPlaying(false);
    this.go(0);
    this.select(this.addLane(experiment));
  }

  /** @param {ShownRun} lane */
  select(lane) {
    if (lane === this.lane) return;
    this.lane = lane;
    this.onScene();
  }

  /**
   * Copies the selected run beside it; what is changed next is changed there.
   * @override
   */
  whatIf() {
    if (this.isFull) return;
    this.setPlaying(false);
    const { experiment } = this.lane;
    this.select(this.addLane({ ...experiment, changes: [...experiment.changes], ticks_max: undefined }));
    this.note.show(say("copyHint"));
  }

  /**
   * Simulates a run anew, and goes on showing what it shows.
   * @param {ShownRun} lane
   */
  simulate(lane) {
    const isNew = !lane.scene;
    lane.simulate(this.simulator, ({ run, refusals = [], error, done }) => {
      if (error) this.note.show(heard(error));
      if (!run) return this.showStatus();
      if (done) this.go(this.tick);
      lane.go(this.tick, true);
      if (isNew || lane === this.lane) this.onScene();
      if (refusals.length) this.refuse(lane, refusals.map(([, why]) => why));
      if (done) this.resize();
      this.showStatus();
    });
  }

  showStatus() {
    const isRunning = this.lanes.some((lane) => lane.isRunning);
    setText(byId("status"), say(!isRunning ? "realFirmware" : this.scene ? "runningAhead" : "waking"));
  }

  /**
   * Shows why changes were refused, and the run without them.
   * @param {ShownRun} lane
   * @param {string[]} reasons
   */
  refuse(lane, reasons) {
    this.note.show(reasons.map(heard).join("; "));
    this.onRefusal();
    this.simulate(lane);
  }

  /**
   * Makes a change in the selected run, before the tick that is shown next.
   * @param {Change} change
   */
  change(change) {
    const { lane } = this;
    const isFresh = lane.experiment.changes.some(({ tick }) => tick === this.tick) && !this.playing;
    const next = isFresh ? this.tick : this.tick + 1;
    const tick = lane.isRunning ? next : Math.min(next, lane.last);
    lane.change({ ...change, tick });
    this.goAhead(tick);
    this.simulate(lane);
  }
}
