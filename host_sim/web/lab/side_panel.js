// @ts-check
/* The desk beside the arena: the run, the parameters, the listing, the curves and the files, one at a time. */

import { ParameterSliders } from "./parameter_sliders.js";
import { Curves, csvOf } from "./curves.js";
import { byId, mayMove, setText, typedById } from "../core/elements.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { memoryIn, save, worldText } from "./files.js";
import { PROFILES } from "../generated.js";
import { experimentOf } from "./shown_run.js";
import { actionStart } from "./run_events.js";
import { WorldPictures } from "./world_pictures.js";
import { FaultMenu, offer } from "../panel/fault_menu.js";
import { LessonsView } from "../panel/lessons_view.js";
import { ListingView } from "../panel/listing_view.js";
import { RANDOM, nameOf } from "../core/world_names.js";

/** @typedef {NonNullable<Experiment["world"]>} World */

const TABS = ["run", "parameters", "listing", "program", "curves", "files", "talk", "lessons"];

/** Shows and changes the selected run. */
export class SidePanel {
  /** @param {Laboratory} lab */
  constructor(lab) {
    this.lab = lab;
    this.tab = TABS[0];
    this.bench = new ParameterSliders((parameter, value) => this.set(parameter, value));
    this.listing = new ListingView();
    this.curves = new Curves();
    this.lessons = new LessonsView();
    this.behaviour = typedById("behaviour", HTMLSelectElement);
    /** The worlds to choose from, by name. */
    this.worlds = new Map(Object.keys(lab.worlds).map((name) => [name, /** @type {World} */ (name)]));
    this.pictures = new WorldPictures(lab.simulator);
    this.body = typedById("body", HTMLSelectElement);
    this.faults = new FaultMenu((what) => {
      const { robot, experiment } = lab.lane;
      lab.change({ do: "body", what, robot, seed: experiment.seed });
    });
    this.robotSeed = typedById("robot-seed", HTMLInputElement);
    this.frozen = 0;
    /** What was last told of files, in the language of the page. */
    this.fileNews = () => "";
    inEachLanguage(() => this.offer());
    this.bindTabs();
    this.bindRun();
    this.bindFiles();
  }

  /** Fills the fields with their choices. */
  offer() {
    offer(this.behaviour, PROFILES.map((name) => [name, heard(name)]));
    this.pictures.offer(this.worlds, this.pictures.chosen);
    this.report(this.fileNews);
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

  /** @param {string} tab */
  open(tab) {
    this.tab = tab;
    for (const name of TABS) {
      byId(`tab-${name}`).setAttribute("aria-selected", `${name === tab}`);
      byId(`tab-${name}`).tabIndex = name === tab ? 0 : -1;
      byId(`panel-${name}`).hidden = name !== tab;
    }
    this.show();
    this.lab.lightUp(); // what other modules write into the tab is written with the next picture
  }

  bindRun() {
    const { lab } = this;
    const on = (/** @type {string} */ id, /** @type {() => void} */ action) => byId(id).addEventListener("click", action);
    byId("new-run").addEventListener("submit", (event) => this.newRun(event));
    this.behaviour.addEventListener("change", () => this.choose(this.behaviour.value));
    this.robotSeed.addEventListener("change", () => this.reseed());
    byId("curve").addEventListener("change", () => this.show());
    on("erase", () => lab.change({ do: "erase", robot: lab.lane.robot }));
    on("freeze", () => lab.change({ do: "freeze", robot: lab.lane.robot, on: 1 - this.frozen }));
    on("remove-lane", () => lab.removeLane(lab.lane));
    on("undo", () => {
      if (lab.lane.undo()) lab.simulate(lab.lane);
    });
  }

  bindFiles() {
    const on = (/** @type {string} */ id, /** @type {() => Promise<void>} */ action) =>
      byId(id).addEventListener("click", () => this.tell(action()));
    on("save-csv", async () => save("octet.csv", [csvOf(this.lab.lanes)]));
    on("save-log", async () => save("run.log", await this.lab.simulator.ask("log", { experiment: this.lab.lane.experiment })));
    on("save-world", async () => {
      const { experiment, data } = this.lab.lane;
      if (data) save("run.world.json", [worldText(experiment, data, this.lab.params.front_extra_mm)]);
    });
    on("save-memory", async () => {
      const { lane, simulator, tick } = this.lab;
      const { experiment, robot, last } = lane;
      save("robot.mem", [Uint8Array.from(await simulator.ask("memory", { experiment, robot, tick: Math.min(tick, last) }))]);
    });
    const input = typedById("open", HTMLInputElement);
    input.addEventListener("change", () => {
      this.tell(this.openFiles([...(input.files ?? [])]));
      input.value = "";
    });
  }

  /** @param {Promise<void>} done - If something cannot be done with a file, this tells why. */
  tell(done) {
    done.catch((error) => this.report(() => heard(error instanceof Error ? error.message : `${error}`)));
  }

  /** @param {() => string} news */
  report(news) {
    this.fileNews = news;
    setText(byId("file-news"), news());
  }

  /** @param {SubmitEvent} event */
  newRun(event) {
    event.preventDefault();
    this.lab.begin(this.wanted);
    this.lab.playsNext = mayMove();
  }

  /** The experiment that the form describes. */
  get wanted() {
    const number = (/** @type {string} */ id) => {
      const field = typedById(id, HTMLInputElement);
      return Number(field.checkValidity() ? field.value : field.defaultValue);
    };
    const wanted = { seed: number("seed"), environments: number("environments"), robots: number("robot-count") };
    const body = this.body.value;
    return experimentOf({ ...wanted, profile: this.behaviour.value, world: this.worlds.get(this.pictures.chosen), body });
  }

  /**
   * Begins anew with the run of a file; its world can be chosen from then on.
   * @param {Experiment} experiment
   */
  begin(experiment) {
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

  /** @param {string} profile */
  choose(profile) {
    const { lane } = this.lab;
    if (!this.fromStart && lane.setup.program === undefined) this.lab.change({ do: "start", robot: lane.robot, profile });
    else this.lab.setUp({ profile, program: undefined });
  }

  /**
   * @param {string} parameter
   * @param {number} value
   */
  set(parameter, value) {
    const { lane } = this.lab;
    if (!this.fromStart) this.lab.change({ do: "set", robot: lane.robot, parameter, value });
    else this.lab.setUp({ settings: { ...lane.setup.settings, [parameter]: value } });
  }

  /** @param {File[]} files */
  async openFiles(files) {
    const named = (/** @type {string[]} */ ...ends) => files.find(({ name }) => ends.some((end) => name.endsWith(end)));
    const [memory, log, world] = [named(".mem"), named(".log"), named(".json", ".toml")];
    const strange = files.find((file) => ![memory, log, world].includes(file));
    if (strange) throw new Error(`${strange.name}: a log ends with .log, a world with .toml or .json, a memory with .mem`);
    if (log) await this.openLog(log, world);
    else if (world) await this.openWorld(world);
    if (memory) await this.openMemory(memory);
  }

  /** @param {File} file */
  async openMemory(file) {
    const { lane, simulator } = this.lab;
    const memory = await memoryIn(file);
    const robots = lane.experiment.robots.map((it, robot) => (robot === lane.robot ? { ...it, memory } : it));
    const experiment = { ...lane.experiment, robots };
    await simulator.ask("memory", { experiment, robot: lane.robot, tick: 0 }); // it throws if they are not a memory
    this.lab.setUp({ memory });
    this.report(() => say("memoryBegins", { file: file.name }));
  }

  /** @param {File} file */
  async openWorld(file) {
    this.begin(await this.lab.simulator.ask("world", { file: { name: file.name, text: await file.text() }, base: this.wanted }));
    this.report(() => say("worldBegins", { file: file.name }));
  }

  /**
   * @param {File} log
   * @param {File | undefined} world
   */
  async openLog(log, world) {
    this.report(() => say("reading", { file: log.name }));
    const files = { text: await log.text(), world: world ? await world.text() : "" };
    const { experiment, news } = await this.lab.simulator.ask("open", files);
    this.begin(experiment);
    this.report(() => heard(news));
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
      this.lessons.show(scene, robot.lessonsUpTo(state.tick, scene.environment.start_tick));
      this.pictures.show();
    }
    if (this.tab === "parameters") this.bench.show(setup.settings);
    if (this.tab === "listing") this.listing.show(state, actionStart(robot, state.tick));
    if (this.tab === "curves") this.curves.show(lanes, tick);
  }
}
