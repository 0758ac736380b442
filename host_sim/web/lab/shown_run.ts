/* One of the runs shown side by side: its experiment, its results, and its arena. */

import { made, setText } from "../core/dom.js";
import { heard, say } from "../core/language.js";
import { OPCODE, PARAMETERS, PROFILES } from "../generated.js";
import { Renderer } from "../draw/renderer.js";
import { RunData } from "../core/run_data.js";
import { Scene } from "../draw/scene.js";
import { RANDOM, nameOf } from "../core/world_names.js";
import { settingsOf } from "../sim/arena.js";
import type { Viewport } from "../draw/viewport.js";
import type { Recorded } from "../sim/page_worker.js";
import type { Beads } from "../sim/run_recorder.js";
import type { Change, Experiment, RobotSetup } from "../types.js";
import type { OnAnswer, Simulator } from "./simulator.js";

/** When each change was made: a later one has a higher number. */
const madeAt: WeakMap<Change, number> = new WeakMap();
let changesMade = 0;

/** Shows its run at any tick. `data` and `scene` are there once the first environment was simulated. */
export class ShownRun {
  /** Its name in a lesson: a key of the texts, or a behaviour. */
  called = "";
  canvas = made("canvas", [], { tabindex: "0", role: "application", "aria-describedby": "help" });
  caption = made("figcaption", []);
  figure = made("figure", [this.canvas, this.caption], { class: "lane" });
  renderer: Renderer;
  data: RunData | undefined;
  scene: Scene | undefined;
  /** Of each environment so far, the length of the shortest tour, mm. */
  tours: number[] = [];
  /** The beads of each robot. */
  beads: Beads[] = [];
  /** How often it was asked to simulate, and whether the last simulation is still running. */
  asked = 0;
  isRunning = false;
  /** Whether it is a recording, and was not simulated here. */
  isRecorded = false;
  /** The node of the robot to select first. */
  node: number | undefined;
  /** Settled when what was asked for last is simulated to its end. */
  done: Promise<void> = Promise.resolve();

  /**
   * @param number - 0 for the original, from 1 on for copies.
   * @param parent - Where its arena goes.
   * @param viewport - Says which part of the arena to show.
   */
  constructor(public experiment: Experiment, readonly number: number, parent: HTMLElement, viewport: Viewport) {
    parent.append(this.figure);
    this.renderer = new Renderer(this.canvas, viewport);
  }

  get name() {
    if (this.called) return heard(say(this.called as "learner"));
    return say((["original", "copy"] as const)[this.number] ?? "copyNumber", { number: this.number });
  }

  /** The last tick that is known. */
  get last() {
    return this.data?.last ?? 0;
  }

  /** The robot that is selected, counted from 0. */
  get robot() {
    return this.scene?.index ?? 0;
  }

  /** How the selected robot was started. */
  get setup() {
    return this.experiment.robots[this.robot];
  }

  /**
   * How a robot is set up at a tick.
   * @param robot - Counted from 0; the selected one by default.
   */
  setupAt(tick: number, robot: number = this.robot) {
    const { profile, settings } = this.experiment.robots[robot];
    const now = { profile, settings: { ...settings } };
    for (const change of this.experiment.changes.filter((it) => it.tick <= tick).map(inWords)) {
      if (change.do === "start" && change.robot === robot) Object.assign(now, { profile: change.profile, settings: { ...settings } });
      if (change.do === "set" && change.robot === robot) now.settings[change.parameter] = change.value;
    }
    return now;
  }

  /**
   * Simulates it again; changes that are refused are removed from its experiment.
   * @param onAnswer - Called when there is a run, and at its end.
   */
  simulate(simulator: Simulator, onAnswer: OnAnswer) {
    const { experiment } = this;
    const asked = (this.asked += 1);
    this.isRunning = true;
    this.done = new Promise((resolve) => {
      simulator.run(this, experiment, (answer) => {
        if (answer.run) this.take(answer.run);
        this.takeBack((answer.refusals ?? []).map(([place]) => experiment.changes[place]));
        if (answer.done && asked === this.asked) this.isRunning = false;
        if (answer.done) resolve();
        onAnswer(answer);
      });
    });
  }

  /** Takes the results of a simulation. */
  take({ run, columns, tours, beads }: Recorded) {
    this.tours = tours;
    this.beads = beads;
    this.showRun(new RunData(run, columns));
  }

  /** @param data - A recorded run, which it shows as it is. */
  keep(data: RunData) {
    this.isRecorded = true;
    this.showRun(data);
    this.go(data.first, true);
  }

  showRun(data: RunData) {
    const { first, measures, run } = data;
    this.data = data;
    if (!this.scene) {
      this.scene = new Scene(measures, data.sceneAt(first), data.statesAt(first));
      this.scene.node = this.node ?? this.scene.node;
    }
    this.scene.measures = measures;
    this.scene.news = run.news ?? [];
  }

  /**
   * Shows a tick; beyond the end it shows the end.
   * @param anew - Whether the trail must be drawn from its beginning.
   */
  go(tick: number, anew: boolean) {
    const { data, scene } = this;
    if (!data || !scene) return;
    const [before, now] = [scene.state.tick, Math.min(tick, data.last)];
    const environment = data.sceneAt(now);
    const goesOn = !anew && now >= before && environment.first_tick === scene.environment.first_tick;
    if (goesOn) data.addTrails(scene.trails, before + 1, now);
    else data.trailsAt(now, scene.trails);
    scene.environment = environment;
    scene.states = data.statesAt(now);
  }

  draw(tick: number) {
    const { scene } = this;
    if (!scene) return;
    this.renderer.draw(scene);
    const { seed, world = RANDOM } = this.experiment;
    const own = this.setup.seed ?? seed;
    const brain = this.setup.program === undefined ? heard(this.setupAt(tick).profile) : say("yourProgram");
    const parts = [
      this.called === this.setupAt(tick).profile ? brain : `${this.name}: ${brain}`, say("captionSeed", { seed }), own === seed ? "" : say("captionOwn", { seed: own }),
      world === RANDOM ? "" : say("captionWorld", { world: heard(nameOf(world)) }),
    ];
    setText(this.caption, parts.join(""));
    this.canvas.setAttribute("aria-label", say("arenaOf", { run: this.name }));
  }

  /** Adds a change to the experiment; it replaces an earlier one of the same thing at the same tick. */
  change(change: Change & { tick: number }) {
    const { changes } = this.experiment;
    const key = draggedKey(change);
    madeAt.set(change, (changesMade += 1));
    const kept = changes.filter((it) => !key || draggedKey(it) !== key);
    const at = kept.findIndex(({ tick }) => tick > change.tick);
    const place = at < 0 ? kept.length : at;
    this.experiment = { ...this.experiment, changes: [...kept.slice(0, place), change, ...kept.slice(place)] };
  }

  takeBack(changes: Change[]) {
    if (!changes.length) return;
    this.experiment = { ...this.experiment, changes: this.experiment.changes.filter((it) => !changes.includes(it)) };
  }

  /** Undoes the newest change, of those in a file the one with the last tick. Returns false if there is none. */
  undo() {
    const orderOf = (change: Change) => madeAt.get(change) ?? 0;
    const last = [...this.experiment.changes].sort((a, b) => orderOf(a) - orderOf(b)).at(-1);
    this.takeBack(last ? [last] : []);
    return last !== undefined;
  }

  /** Changes how the selected robot starts. */
  setUp(setup: Partial<RobotSetup>) {
    const robots = this.experiment.robots.map((it, robot) => (robot === this.robot ? { ...it, ...setup } : it));
    this.experiment = { ...this.experiment, robots };
  }
}

/** What a logged command does, if it starts a robot or sets a parameter; any other change as it is. */
export function inWords(change: Change): Change {
  if (change.do !== "command") return change;
  const { robot, opcode, which, value } = change;
  if (opcode === OPCODE.START) return { do: "start", robot, profile: PROFILES[which] };
  return opcode === OPCODE.SET ? { do: "set", robot, parameter: Object.keys(PARAMETERS)[which], value } : change;
}

/** A later change with the same key replaces an earlier one; empty for a change that replaces none. */
function draggedKey(change: Change & { tick: number }) {
  if (change.do === "move_bar" || change.do === "move_food" || change.do === "move_plant") return `${change.tick} ${change.do} ${change.id}`;
  if (change.do === "set") return `${change.tick} set ${change.robot} ${change.parameter}`;
  if (change.do === "start") return `${change.tick} start ${change.robot}`;
  return "";
}

/** An experiment with one behaviour for all its robots. */
export function experimentOf(
  { seed, environments, robots, profile, world = RANDOM, body }: { seed: number, environments: number, robots: number, profile: string, world?: Experiment["world"], body?: Experiment["body"] },
): Experiment {
  const setup = () => ({ profile, settings: settingsOf(body), memory: null });
  const limit_ticks = Math.round(600_000 / PARAMETERS.tick_ms.default);
  return { seed, environments, limit_ticks, robots: Array.from({ length: robots }, setup), changes: [], world, body };
}
