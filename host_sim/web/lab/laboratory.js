// @ts-check
/* Runs side by side at the same tick: what is simulated, which one is selected, and what a person changes in it. */

import { byId, setText } from "../core/elements.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { ShownRun, restartNames } from "./shown_run.js";
import { Toast } from "../core/toast.js";
import { PlayingPage } from "./playing_page.js";
import { Simulator } from "./simulator.js";

/**
 * What `octet_page` has put into the page: page.wasm and the worker's script, packed, and for a recorded run what repeats
 * it; or why it simulates nothing.
 * @typedef {{worlds: Worlds, programs: Record<string, string>, wasm: string, worker: string, recorded?: RecordedRun, why?: string}} Parts
 */

const LANES_MAX = 4;
/** What is behind the address of a live run that has ended. */
export const ENDED = "#ended";

/** A class that extends it shows the runs: `onLanes`, `onScene` and `onRefusal` tell it what has changed. */
export class Laboratory extends PlayingPage {
  /**
   * @param {Parts} parts
   * @param {Experiment} experiment - The first run's.
   * @param {RunData} [recorded] - That run, if it is a recorded one.
   */
  constructor(parts, experiment, recorded) {
    super(recorded?.first ?? 0);
    const { worlds, programs } = parts;
    this.recorded = recorded;
    this.programs = programs;
    this.worlds = worlds;
    this.params = worlds.random;
    this.simulator = new Simulator(parts);
    this.note = new Toast();
    /** Whether the next run plays as soon as it is there. */
    this.playsNext = false;
    /** @type {ShownRun[]} */
    this.lanes = [];
    this.lane = this.addLane(experiment, recorded);
    /** Settled when it is known how a recorded run is repeated; it fails with the reason if it cannot be. */
    this.recalled = this.recall(parts, this.lane);
    this.recalled.catch(() => {});
    inEachLanguage(() => this.showStatus());
  }

  /**
   * @param {Parts} parts
   * @param {ShownRun} lane - The first one.
   */
  async recall({ why, recorded }, lane) {
    if (why) throw new Error(why);
    if (recorded) lane.experiment = await this.simulator.ask("repeat", { recorded });
    this.stale = true;
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
    return this.recorded?.measures.tick_ms ?? this.params.tick_s * 1000;
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

  /**
   * @param {Experiment} experiment - Of the run to add, and to simulate if it is not recorded.
   * @param {RunData} [recorded]
   */
  addLane(experiment, recorded) {
    const lane = new ShownRun(experiment, byId("floors"), this.viewport);
    this.lanes.push(lane);
    lane.canvas.addEventListener("pointerdown", () => this.select(lane), { capture: true });
    lane.canvas.addEventListener("focus", () => this.select(lane));
    if (recorded) lane.keep(recorded);
    this.onLanes();
    if (!recorded) this.simulate(lane);
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
    this.showStatus();
  }

  /** @override */
  whatIf() {
    if (this.lane.isRecorded) this.inCopy(() => {});
    else this.copy();
  }

  /**
   * Makes a change in the selected run or, if that is recorded, in a copy; if there cannot be one, says why.
   * @param {() => void} change
   */
  inCopy(change) {
    if (!this.lane.isRecorded) return change();
    this.recalled.then(() => {
      if (this.lane.isRecorded) this.copy();
      if (!this.lane.isRecorded) change();
    }).catch((error) => {
      this.note.show(heard(error.message));
      this.onRefusal();
    });
  }

  /** Copies the selected run beside it; what is changed next is changed there. */
  copy() {
    if (this.isFull) return;
    this.setPlaying(false);
    const { experiment, scene } = this.lane;
    const copy = this.addLane({ ...experiment, changes: [...experiment.changes], ticks_max: undefined });
    copy.node = scene?.node;
    this.select(copy);
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
    const words = say(!isRunning ? "realFirmware" : this.scene ? "runningAhead" : "waking");
    setText(byId("status"), this.lane.isRecorded ? this.title : words);
  }

  /** What the recorded run is. */
  get title() {
    return location.hash === ENDED ? say("runRecorded") : heard(this.recorded?.run.title ?? "");
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
    this.inCopy(() => this.changeLane(change));
  }

  /** @param {Change} change */
  changeLane(change) {
    const { lane } = this;
    const isFresh = lane.experiment.changes.some(({ tick }) => tick === this.tick) && !this.playing;
    const next = isFresh ? this.tick : this.tick + 1;
    const tick = lane.isRunning ? next : Math.min(next, lane.last);
    lane.change({ ...change, tick });
    this.goAhead(tick);
    this.simulate(lane);
  }

  /** @param {Partial<RobotSetup>} setup - How the selected robot starts. */
  setUp(setup) {
    this.inCopy(() => {
      this.lane.setUp(setup);
      this.simulate(this.lane);
    });
  }
}
