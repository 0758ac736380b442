// @ts-check
/* One of the runs shown side by side: its experiment, its results, and its arena. */

import { made } from "../core/dom.js";
import { heard, say } from "../core/language.js";
import { setText } from "../core/elements.js";
import { OPCODE, PARAMETERS, PROFILES } from "../generated.js";
import { Renderer } from "../draw/renderer.js";
import { RunData } from "../core/run_data.js";
import { Scene } from "../draw/scene.js";
import { RANDOM, nameOf } from "../core/world_names.js";
import { settingsOf } from "../sim/arena.js";

let lanes = 0;
/** @type {WeakMap<Change, number>} - When each change was made: a later one has a higher number. */
const madeAt = new WeakMap();
let changesMade = 0;

/** The next run is the original again. */
export function restartNames() {
  lanes = 0;
}

/** Shows its run at any tick. `data` and `scene` are there once the first environment was simulated. */
export class ShownRun {
  /**
   * @param {Experiment} experiment
   * @param {HTMLElement} parent - Where its arena goes.
   * @param {Viewport} viewport - Says which part of the arena to show.
   */
  constructor(experiment, parent, viewport) {
    this.experiment = experiment;
    this.number = lanes;
    lanes += 1;
    /** What it is in a lesson: a key of the texts, or a behaviour. */
    this.called = "";
    this.canvas = made("canvas", [], { tabindex: "0", role: "application", "aria-describedby": "help" });
    this.caption = made("figcaption", []);
    this.figure = made("figure", [this.canvas, this.caption], { class: "lane" });
    parent.append(this.figure);
    this.renderer = new Renderer(this.canvas, viewport);
    /** @type {RunData | undefined} */
    this.data = undefined;
    /** @type {Scene | undefined} */
    this.scene = undefined;
    /** @type {number[]} - Of each environment so far, the length of the shortest tour, mm. */
    this.tours = [];
    /** @type {import("../sim/run_recorder.js").Beads[]} - Of each robot. */
    this.beads = [];
    /** How often it was asked to simulate, and whether the last simulation is still running. */
    this.asked = 0;
    this.isRunning = false;
    /** Whether it was not simulated here. */
    this.isRecorded = false;
    /** @type {number | undefined} - The node of the robot to select first. */
    this.node = undefined;
    /** @type {Promise<void>} - Settled when what was asked for last is simulated to its end. */
    this.done = Promise.resolve();
  }

  get name() {
    if (this.called) return heard(say(/** @type {"learner"} */ (this.called)));
    return say(/** @type {const} */ (["original", "copy"])[this.number] ?? "copyNumber", { number: this.number });
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
   * @param {number} tick
   * @param {number} [robot] - Counted from 0; the selected one by default.
   */
  setupAt(tick, robot = this.robot) {
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
   * @param {Simulator} simulator
   * @param {import("./simulator.js").OnAnswer} onAnswer - Called when there is a run, and at its end.
   */
  simulate(simulator, onAnswer) {
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

  /** @param {import("../sim/page_worker.js").Recorded} recorded - What was simulated. */
  take({ run, columns, tours, beads }) {
    this.tours = tours;
    this.beads = beads;
    this.showRun(new RunData(run, columns));
  }

  /** @param {RunData} data - A recorded run, which it shows as it is. */
  keep(data) {
    this.isRecorded = true;
    this.showRun(data);
    this.go(data.first, true);
  }

  /** @param {RunData} data */
  showRun(data) {
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
   * @param {number} tick
   * @param {boolean} anew - Whether the trail must be drawn from its beginning.
   */
  go(tick, anew) {
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

  /** @param {number} tick */
  draw(tick) {
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

  /**
   * Adds a change to the experiment; it replaces an earlier one of the same thing at the same tick.
   * @param {Change & {tick: number}} change
   */
  change(change) {
    const { changes } = this.experiment;
    const key = draggedKey(change);
    madeAt.set(change, (changesMade += 1));
    const kept = changes.filter((it) => !key || draggedKey(it) !== key);
    const at = kept.findIndex(({ tick }) => tick > change.tick);
    const place = at < 0 ? kept.length : at;
    this.experiment = { ...this.experiment, changes: [...kept.slice(0, place), change, ...kept.slice(place)] };
  }

  /** @param {Change[]} changes */
  takeBack(changes) {
    if (!changes.length) return;
    this.experiment = { ...this.experiment, changes: this.experiment.changes.filter((it) => !changes.includes(it)) };
  }

  /** Undoes the change that was made last; those of a file in the order of their ticks. False if there is none. */
  undo() {
    const orderOf = (/** @type {Change} */ change) => madeAt.get(change) ?? 0;
    const last = [...this.experiment.changes].sort((a, b) => orderOf(a) - orderOf(b)).at(-1);
    this.takeBack(last ? [last] : []);
    return last !== undefined;
  }

  /** @param {Partial<RobotSetup>} setup - How the selected robot starts from now on. */
  setUp(setup) {
    const robots = this.experiment.robots.map((it, robot) => (robot === this.robot ? { ...it, ...setup } : it));
    this.experiment = { ...this.experiment, robots };
  }

  remove() {
    this.figure.remove();
  }
}

/**
 * What a logged command does, if it starts a robot or sets a parameter; any other change as it is.
 * @param {Change} change
 * @returns {Change}
 */
export function inWords(change) {
  if (change.do !== "command") return change;
  const { robot, opcode, which, value } = change;
  if (opcode === OPCODE.START) return { do: "start", robot, profile: PROFILES[which] };
  return opcode === OPCODE.SET ? { do: "set", robot, parameter: Object.keys(PARAMETERS)[which], value } : change;
}

/**
 * A later change with the same key replaces an earlier one; empty for a change that replaces none.
 * @param {Change & {tick: number}} change
 */
function draggedKey(change) {
  if (change.do === "move_bar" || change.do === "move_food" || change.do === "move_plant") return `${change.tick} ${change.do} ${change.id}`;
  if (change.do === "set") return `${change.tick} set ${change.robot} ${change.parameter}`;
  if (change.do === "start") return `${change.tick} start ${change.robot}`;
  return "";
}

/**
 * An experiment with one behaviour for all its robots.
 * @param {{seed: number, environments: number, robots: number, profile: string,
 *   world?: Experiment["world"], body?: Experiment["body"]}} wanted
 * @returns {Experiment}
 */
export function experimentOf({ seed, environments, robots, profile, world = RANDOM, body }) {
  const setup = () => ({ profile, settings: settingsOf(body), memory: null });
  const limit_ticks = Math.round(600_000 / PARAMETERS.tick_ms.default);
  return { seed, environments, limit_ticks, robots: Array.from({ length: robots }, setup), changes: [], world, body };
}
