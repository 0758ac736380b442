/* Runs side by side at the same tick: what is simulated, which one is selected, and what a person changes in it. */

import { byId, mayMove, setText } from "../core/dom.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { ShownRun } from "./shown_run.js";
import { Toast } from "../core/toast.js";
import { PlayingPage } from "./playing_page.js";
import { Simulator } from "./simulator.js";
import type { RunData } from "../core/run_data.js";
import type { RecordedRun } from "../sim/log_opening.js";
import type { Worlds } from "../sim/simulation.js";
import type { Change, Experiment, RobotSetup } from "../types.js";

/**
 * What `octet_page` has put into the page: page.wasm packed, and the worker's script, and for a recorded run what repeats
 * it; or why it simulates nothing; and whether its run is a live one. `atlas` has the mean time of each memory, s.
 */
export type Parts = { worlds: Worlds; programs: Record<string, string>; wasm: string; worker: string; debugger: string; atlas: number[];
  recorded?: RecordedRun; why?: string; live?: Pick<RobotSetup, "profile" | "settings"> };

const LANES_MAX = 4;

/** Subclasses show the runs: `onLanes`, `onScene` and `onRefusal` tell them what has changed. */
export abstract class Laboratory extends PlayingPage {
  params = this.parts.worlds.random;
  simulator = new Simulator(this.parts);
  note = new Toast();
  /** Whether the next run plays as soon as it is there. */
  playsNext = false;
  lanes: ShownRun[] = [];
  lane: ShownRun;
  /** Settled when it is known how a recorded run is repeated; it fails with the reason if it cannot be. */
  recalled: Promise<void>;

  /**
   * @param experiment - The first run's.
   * @param recorded - That run, if it is a recorded one.
   */
  constructor(readonly parts: Parts, experiment: Experiment, public recorded?: RunData) {
    super(recorded?.first ?? 0);
    this.lane = this.addLane(experiment, recorded);
    this.recalled = this.recall(parts, this.lane);
    this.recalled.catch(() => {});
    inEachLanguage(() => this.showStatus());
  }

  /** @param lane - The first one. */
  async recall({ why, recorded }: Pick<Parts, "why" | "recorded">, lane: ShownRun) {
    if (why) throw new Error(why);
    if (recorded) lane.experiment = await this.simulator.ask("repeat", { recorded });
    this.stale = true;
  }

  /** Called when the number of runs has changed. */
  abstract onLanes(): void;

  /** Called when another scene or another robot is selected. */
  abstract onScene(): void;

  /** Called when a change was refused. */
  abstract onRefusal(): void;

  /** The last tick of all runs; while one of them is simulated, the tick that is shown may still be beyond it. */
  get last(): number {
    const known = Math.max(0, ...this.lanes.map((lane) => lane.last));
    return this.lanes.some((lane) => lane.isRunning) ? Math.max(known, this.tick) : known;
  }

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

  show() {
    for (const lane of this.lanes) lane.go(this.tick, false);
  }

  /** @param experiment - Of the run to add, and to simulate if it is not recorded. */
  addLane(experiment: Experiment, recorded?: RunData) {
    const number = this.lanes.length ? Math.max(...this.lanes.map((other) => other.number)) + 1 : 0;
    const lane = new ShownRun(experiment, number, byId("floors"), this.viewport);
    this.lanes.push(lane);
    lane.canvas.addEventListener("pointerdown", () => this.select(lane), { capture: true });
    lane.canvas.addEventListener("focus", () => this.select(lane));
    if (recorded) lane.keep(recorded);
    this.onLanes();
    if (!recorded) this.simulate(lane);
    return lane;
  }

  removeLane(lane: ShownRun) {
    if (this.lanes.length < 2) return;
    this.drop(lane);
    this.lanes = this.lanes.filter((other) => other !== lane);
    this.select(this.lanes[0]);
    this.onLanes();
  }

  /** Closes a run. */
  drop(lane: ShownRun) {
    lane.figure.remove();
    this.simulator.queued.delete(lane);
  }

  /**
   * @param experiment - Of the only run from now on.
   * @param recorded - That run, if it is a recorded one.
   */
  begin(experiment: Experiment, recorded?: RunData) {
    const old = this.lanes;
    this.lanes = [];
    old.forEach((lane) => this.drop(lane));
    this.setPlaying(false);
    this.go(0);
    this.select(this.addLane(experiment, recorded));
  }

  /** Begins an experiment that a person has described. */
  renew(experiment: Experiment) {
    this.begin(experiment);
    this.playsNext = mayMove();
  }

  select(lane: ShownRun) {
    if (lane === this.lane) return;
    this.lane = lane;
    this.onScene();
    this.showStatus();
  }

  whatIf() {
    if (this.lane.isRecorded) this.inCopy(() => {});
    else if (this.copy()) this.note.show(say("copyHint"));
  }

  /** Waits until it is known how the run is repeated; fails with the reason if it cannot be. */
  async whole() {
    await this.recalled;
  }

  /** Makes a change in the selected run or, if that is recorded, in a copy; if there cannot be one, says why. */
  inCopy(change: () => void) {
    if (!this.lane.isRecorded) return change();
    this.whole().then(() => {
      if (this.lane.isRecorded && this.copy()) this.note.show(say("copyHint"));
      if (!this.lane.isRecorded) change();
    }).catch((error) => {
      this.note.show(heard(error.message));
      this.onRefusal();
    });
  }

  /** Copies the selected run beside it; further changes go to the copy. Returns false if there is no room. */
  copy() {
    if (this.isFull) return false;
    this.setPlaying(false);
    const { experiment, scene } = this.lane;
    const copy = this.addLane({ ...experiment, changes: [...experiment.changes], ticks_max: undefined });
    copy.node = scene?.node;
    this.select(copy);
    return true;
  }

  /** Simulates a run anew, and goes on showing what it shows. */
  simulate(lane: ShownRun) {
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
    setText(byId("status"), this.lane.isRecorded ? this.title : this.doing);
  }

  /** The status of the simulation. */
  get doing() {
    const isRunning = this.lanes.some((lane) => lane.isRunning);
    return say(!isRunning ? "realFirmware" : this.scene ? "runningAhead" : "waking");
  }

  /** The title of the recorded run. */
  get title() {
    return heard(this.recorded?.run.title ?? "");
  }

  /** Shows why changes were refused, and the run without them. */
  refuse(lane: ShownRun, reasons: string[]) {
    this.note.show(reasons.map(heard).join("; "));
    this.onRefusal();
    this.simulate(lane);
  }

  /** Makes a change in the selected run, before the tick that is shown next. */
  change(change: Change) {
    this.inCopy(() => this.changeLane(change));
  }

  changeLane(change: Change) {
    const { lane } = this;
    const isFresh = lane.experiment.changes.some(({ tick }) => tick === this.tick) && !this.playing;
    const next = isFresh ? this.tick : this.tick + 1;
    const tick = lane.isRunning ? next : Math.min(next, lane.last);
    lane.change({ ...change, tick });
    this.goAhead(tick);
    this.simulate(lane);
  }

  /** @param setup - How the selected robot starts. */
  setUp(setup: Partial<RobotSetup>) {
    this.inCopy(() => {
      this.lane.setUp(setup);
      this.simulate(this.lane);
    });
  }
}
