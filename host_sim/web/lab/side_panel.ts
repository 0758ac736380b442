/* The desk beside the arena: the run, the parameters, the listing, the curves and the files, one at a time. */

import { Curves } from "./curves.js";
import { buttonOf, byId, made, setText, typedById } from "../core/dom.js";
import { heard, inEachLanguage, languageCode, robotWords, say } from "../core/language.js";
import { bodySentence, lessonSentence } from "../core/phrases.js";
import { SENSORS } from "../core/sensors.js";
import { FilesTab } from "./files.js";
import { PARAMETERS, PROFILES } from "../generated.js";
import { experimentOf } from "./shown_run.js";
import { WorldPictures } from "./world_pictures.js";
import { ListingView } from "../panel/listing_view.js";
import { RANDOM, nameOf } from "../core/world_names.js";
import type { Scene } from "../draw/scene.js";
import type { Lesson } from "../generated_types.js";
import type { Experiment } from "../types.js";
import type { Laboratory } from "./laboratory.js";

type World = NonNullable<Experiment["world"]>;

const TABS = ["run", "parameters", "listing", "program", "curves", "atlas", "files", "talk", "lessons"];

/** The changes of a body that the page offers, as for `tools/run --change`; docs/worlds.md explains each. */
const FAULTS = [
  ...SENSORS.flatMap((sensor) => [`stuck-on:${sensor}`, `stuck-off:${sensor}`]),
  "mirror", "noise:10/1000", "noise:100/1000", "swap-motors", "weak-motor:left:60%", "weak-motor:right:60%",
  "swap-odometers", "odometer:left:0%", "odometer:right:0%", "false-beacon:100", "lag:60ms", "slack:3deg",
  "slip:5%", "latency:1", "dark-wall", "weak-battery", "repair",
];

/** Shows and changes the selected run. */
export class SidePanel {
  tab = TABS[0];
  bench = new ParameterSliders((parameter, value) => this.set(parameter, value));
  listing = new ListingView();
  curves = new Curves();
  files = new FilesTab(this);
  behaviour = typedById("behaviour", HTMLSelectElement);
  /** The worlds to choose from, by name. */
  worlds = new Map(Object.keys(this.lab.parts.worlds).map((name) => [name, name as World]));
  pictures = new WorldPictures(this.lab.simulator);
  body = typedById("body", HTMLSelectElement);
  fault = typedById("fault", HTMLSelectElement);
  robotSeed = typedById("robot-seed", HTMLInputElement);
  frozen = 0;
  /** What is written of the lessons. */
  lessonsKey = "";

  constructor(readonly lab: Laboratory) {
    inEachLanguage(() => this.offer());
    this.bindTabs();
    this.bindRun();
  }

  /** Fills the fields with their choices. */
  offer() {
    offer(this.behaviour, PROFILES.map((name) => [name, heard(name)]));
    offer(this.fault, FAULTS.map((what) => [what, heard(bodySentence(what)).replace(/\.$/, "")]));
    this.pictures.offer(this.worlds, this.pictures.chosen);
  }

  bindTabs() {
    for (const tab of TABS) byId(`tab-${tab}`).addEventListener("click", () => this.open(tab));
    byId("tabs").addEventListener("keydown", ({ key }) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
      if (!step) return;
      this.open(TABS[(TABS.indexOf(this.tab) + step + TABS.length) % TABS.length]);
      byId(`tab-${this.tab}`).focus();
    });
  }

  open(tab: string) {
    this.tab = tab;
    for (const name of TABS) {
      byId(`tab-${name}`).setAttribute("aria-selected", `${name === tab}`);
      byId(`tab-${name}`).tabIndex = name === tab ? 0 : -1;
      byId(`panel-${name}`).hidden = name !== tab;
    }
    if (tab === "curves") this.lab.whole().catch(() => {}); // curves need the whole run, and work without What if?
    this.show();
    this.lab.lightUp(); // what other modules write into the tab is written with the next picture
  }

  bindRun() {
    const { lab } = this;
    const on = (id: string, action: () => void) => byId(id).addEventListener("click", action);
    byId("new-run").addEventListener("submit", (event) => {
      event.preventDefault();
      lab.renew(this.wanted);
    });
    this.behaviour.addEventListener("change", () => this.choose(this.behaviour.value));
    this.robotSeed.addEventListener("change", () => this.reseed());
    byId("curve").addEventListener("change", () => this.show());
    on("erase", () => lab.change({ do: "erase", robot: lab.lane.robot }));
    on("freeze", () => lab.change({ do: "freeze", robot: lab.lane.robot, on: 1 - this.frozen }));
    on("break", () => {
      const { robot, experiment } = lab.lane;
      lab.change({ do: "body", what: this.fault.value, robot, seed: experiment.seed });
    });
    on("copy-debugger", () => this.copyDebugger());
    on("remove-lane", () => lab.removeLane(lab.lane));
    on("undo", () => {
      if (lab.lane.undo()) lab.simulate(lab.lane);
    });
  }

  /** The experiment that the form describes. */
  get wanted() {
    const number = (id: string) => {
      const field = typedById(id, HTMLInputElement);
      return Number(field.checkValidity() ? field.value : field.defaultValue);
    };
    const wanted = { seed: number("seed"), environments: number("environments"), robots: number("robot-count") };
    const body = this.body.value;
    return experimentOf({ ...wanted, profile: this.behaviour.value, world: this.worlds.get(this.pictures.chosen), body });
  }

  /** Begins anew with the run of a file; its world can be chosen from then on. */
  begin(experiment: Experiment) {
    const { world = RANDOM } = experiment;
    this.worlds.set(nameOf(world), world);
    this.pictures.offer(this.worlds, nameOf(world));
    this.lab.begin(experiment);
  }

  /** Starts the robot with other random turns. */
  reseed() {
    if (!this.robotSeed.checkValidity() || this.robotSeed.value === "") return;
    this.lab.setUp({ seed: Number(this.robotSeed.value) });
  }

  /** Whether a change is to hold from the start of the run. */
  get fromStart() {
    return typedById("when", HTMLSelectElement).value === "start";
  }

  choose(profile: string) {
    const { lane } = this.lab;
    if (!this.fromStart && lane.setup.program === undefined) this.lab.change({ do: "start", robot: lane.robot, profile });
    else this.lab.setUp({ profile, program: undefined });
  }

  set(parameter: string, value: number) {
    const { lane } = this.lab;
    if (!this.fromStart) this.lab.change({ do: "set", robot: lane.robot, parameter, value });
    else this.lab.setUp({ settings: { ...lane.setup.settings, [parameter]: value } });
  }

  /** The command that stops the selected robot in a debugger at the tick that is shown. */
  get debugger() {
    const { parts, lane, recorded, scene } = this.lab;
    const log = lane.isRecorded ? recorded?.run.log ?? "RUN.LOG" : "run.log";
    return `${parts.debugger} ${log} --node ${scene?.state.node} --tick ${scene?.state.tick}`;
  }

  /** Puts that command into the clipboard, or says why there is none. */
  copyDebugger() {
    const { lane, note } = this.lab;
    if (lane.setup.program !== undefined) return note.show(say("debuggerNeedsC"));
    const words = say(!lane.isRecorded ? "debuggerNeedsLog" : "debuggerCopied");
    navigator.clipboard?.writeText(this.debugger).then(() => note.show(words), () => {});
  }

  show() {
    const { lane, lanes, tick } = this.lab;
    const { scene, data } = lane;
    if (!scene || !data) return;
    const { state } = scene;
    const setup = lane.setupAt(tick);
    this.frozen = state.frozen;
    if (document.activeElement !== this.behaviour) this.behaviour.value = setup.profile;
    if (document.activeElement !== this.robotSeed) {
      this.robotSeed.value = `${lane.setup.seed ?? lane.experiment.seed + lane.robot}`;
    }
    byId("freeze").setAttribute("aria-pressed", `${Boolean(state.frozen)}`);
    setText(byId("freeze"), say(state.frozen ? "frozen" : "freeze"));
    typedById("undo", HTMLButtonElement).disabled = lane.isRecorded || lane.experiment.changes.length === 0;
    const robot = data.robots[lane.robot];
    if (this.tab === "run") {
      this.showLessons(scene, robot.lessonsUpTo(state.tick, scene.environment.start_tick));
      this.pictures.show();
    }
    if (this.tab === "parameters") this.bench.show(setup.settings);
    if (this.tab === "listing") {
      this.listing.show(state, robot.actionStart(state.tick));
      setText(byId("debugger"), this.debugger);
    }
    if (this.tab === "curves") this.curves.show(lanes, tick);
  }

  /** @param lessons - Those of the robot that the panel shows, the oldest first. */
  showLessons(scene: Scene, lessons: Lesson[]) {
    const key = JSON.stringify([languageCode(), scene.environment.start_tick, lessons]);
    if (this.lessonsKey === key) return;
    this.lessonsKey = key;
    const said = lessons.map((lesson) => `${scene.clock(lesson.tick)} ${lessonSentence(lesson, robotWords())}`).reverse();
    byId("lessons").replaceChildren(...(said.length ? said : [say("nothingLearned")]).map((words) => made("li", [words])));
  }
}

/**
 * Fills a field, and keeps the choice that was made.
 * @param options - Their values and names.
 */
function offer(select: HTMLSelectElement, options: [string, string][]) {
  const chosen = select.value || options[0][0];
  select.replaceChildren(...options.map(([value, name]) => new Option(name, value, false, value === chosen)));
}

type Parameter = keyof typeof PARAMETERS;

type Slider = { input: HTMLInputElement; output: HTMLElement; reset: HTMLButtonElement };

/** A slider for each parameter of the robot. Fills the element panel-parameters. */
class ParameterSliders {
  sliders: Map<Parameter, Slider> = new Map();

  constructor(readonly onChange: (parameter: string, value: number) => void) {
    inEachLanguage(() => this.fill(byId("panel-parameters")));
  }

  fill(panel: HTMLElement) {
    panel.replaceChildren();
    for (const name of Object.keys(PARAMETERS) as Parameter[]) this.sliders.set(name, this.makeSlider(panel, name));
  }

  /** @param settings - All but the defaults. */
  show(settings: Record<string, number>) {
    for (const [name, { input, output, reset }] of this.sliders) {
      const value = settings[name] ?? PARAMETERS[name].default;
      if (document.activeElement !== input || input.value === output.dataset.value) input.value = `${value}`;
      output.dataset.value = `${value}`;
      output.textContent = `${input.value} ${heard(PARAMETERS[name].unit)}`;
      reset.disabled = value === PARAMETERS[name].default;
    }
  }

  makeSlider(parent: HTMLElement, name: Parameter): Slider {
    const { min, max, default: usual } = PARAMETERS[name];
    const meaning = heard(PARAMETERS[name].meaning);
    const output = made("output", []);
    const input = made("input", [], { type: "range", min: `${min}`, max: `${max}`, step: "1", title: name });
    const reset = buttonOf("↺", () => this.onChange(name, usual));
    reset.title = `${usual}`;
    reset.setAttribute("aria-label", say("backTo", { meaning, value: usual }));
    const label = made("label", [meaning.replace(/\.$/, ""), " ", output, input]);
    parent.append(made("div", [label, reset], { class: "slider" }));
    input.addEventListener("input", () => (output.textContent = `${input.value} ${heard(PARAMETERS[name].unit)}`));
    input.addEventListener("change", () => this.onChange(name, Number(input.value)));
    return { input, output, reset };
  }
}
