/* The desk beside the arena: the run, the parameters, the listing, the curves and the files, one at a time. */

import { ParameterSliders } from "./parameter_sliders.js";
import { Curves, csvOf } from "./curves.js";
import { byId, made, setText, typedById } from "../core/dom.js";
import { heard, inEachLanguage, languageCode, robotWords, say } from "../core/language.js";
import { bodySentence, lessonSentence } from "../core/phrases.js";
import { SENSORS } from "../core/sensors.js";
import { memoryIn, save, worldText } from "./files.js";
import { PROFILES } from "../generated.js";
import { experimentOf } from "./shown_run.js";
import { actionStart } from "./run_events.js";
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
  lessons = new LessonsView();
  behaviour = typedById("behaviour", HTMLSelectElement);
  /** The worlds to choose from, by name. */
  worlds: Map<string, World>;
  pictures: WorldPictures;
  body: HTMLSelectElement;
  faults: FaultMenu;
  robotSeed: HTMLInputElement;
  frozen = 0;
  /** The last message about files, in the language of the page. */
  fileNews = () => "";

  constructor(readonly lab: Laboratory) {
    this.worlds = new Map(Object.keys(lab.worlds).map((name) => [name, name as World]));
    this.pictures = new WorldPictures(lab.simulator);
    this.body = typedById("body", HTMLSelectElement);
    this.faults = new FaultMenu((what) => {
      const { robot, experiment } = lab.lane;
      lab.change({ do: "body", what, robot, seed: experiment.seed });
    });
    this.robotSeed = typedById("robot-seed", HTMLInputElement);
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
    byId("new-run").addEventListener("submit", (event) => this.newRun(event));
    this.behaviour.addEventListener("change", () => this.choose(this.behaviour.value));
    this.robotSeed.addEventListener("change", () => this.reseed());
    byId("curve").addEventListener("change", () => this.show());
    on("erase", () => lab.change({ do: "erase", robot: lab.lane.robot }));
    on("freeze", () => lab.change({ do: "freeze", robot: lab.lane.robot, on: 1 - this.frozen }));
    on("copy-debugger", () => this.copyDebugger());
    on("remove-lane", () => lab.removeLane(lab.lane));
    on("undo", () => {
      if (lab.lane.undo()) lab.simulate(lab.lane);
    });
  }

  bindFiles() {
    const on = (id: string, action: () => Promise<void>) =>
      byId(id).addEventListener("click", () => this.tell(this.lab.whole().then(action)));
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

  /** @param done - Fails with the reason if something cannot be done with a file. */
  tell(done: Promise<void>) {
    done.catch((error) => this.report(() => heard(error instanceof Error ? error.message : `${error}`)));
  }

  report(news: () => string) {
    this.fileNews = news;
    setText(byId("file-news"), news());
  }

  newRun(event: SubmitEvent) {
    event.preventDefault();
    this.lab.renew(this.wanted);
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
    const { debugger: command, lane, recorded, scene } = this.lab;
    const log = lane.isRecorded ? recorded?.run.log ?? "RUN.LOG" : "run.log";
    return `${command} ${log} --node ${scene?.state.node} --tick ${scene?.state.tick}`;
  }

  /** Puts that command into the clipboard, or says why there is none. */
  copyDebugger() {
    const { lane, note } = this.lab;
    if (lane.setup.program !== undefined) return note.show(say("debuggerNeedsC"));
    const words = say(!lane.isRecorded ? "debuggerNeedsLog" : "debuggerCopied");
    navigator.clipboard?.writeText(this.debugger).then(() => note.show(words), () => {});
  }

  async openFiles(files: File[]) {
    const named = (...ends: string[]) => files.find(({ name }) => ends.some((end) => name.endsWith(end)));
    const [memory, log, world] = [named(".mem"), named(".log"), named(".json", ".toml")];
    const strange = files.find((file) => ![memory, log, world].includes(file));
    if (strange) throw new Error(`${strange.name}: a log ends with .log, a world with .toml or .json, a memory with .mem`);
    if (log) await this.openLog(log, world);
    else if (world) await this.openWorld(world);
    if (memory) await this.openMemory(memory);
  }

  async openMemory(file: File) {
    const { lane, simulator } = this.lab;
    const memory = await memoryIn(file);
    const robots = lane.experiment.robots.map((it, robot) => (robot === lane.robot ? { ...it, memory } : it));
    const experiment = { ...lane.experiment, robots };
    await simulator.ask("memory", { experiment, robot: lane.robot, tick: 0 }); // it throws if they are not a memory
    this.lab.setUp({ memory });
    this.report(() => say("memoryBegins", { file: file.name }));
  }

  async openWorld(file: File) {
    this.begin(await this.lab.simulator.ask("world", { file: { name: file.name, text: await file.text() }, base: this.wanted }));
    this.report(() => say("worldBegins", { file: file.name }));
  }

  async openLog(log: File, world: File | undefined) {
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
    if (this.tab === "listing") {
      this.listing.show(state, actionStart(robot, state.tick));
      setText(byId("debugger"), this.debugger);
    }
    if (this.tab === "curves") this.curves.show(lanes, tick);
  }
}

/** Fills the element `lessons`. */
class LessonsView {
  list = byId("lessons");
  key = "";

  constructor() {}

  /** @param lessons - Those of the robot that the panel shows, the oldest first. */
  show(scene: Scene, lessons: Lesson[]) {
    const key = JSON.stringify([languageCode(), scene.environment.start_tick, lessons]);
    if (this.key === key) return;
    this.key = key;
    this.list.replaceChildren(...lessons.map((lesson) => itemFor(lesson, scene)).reverse());
    if (!lessons.length) this.list.append(made("li", [say("nothingLearned")]));
  }
}

function itemFor(lesson: Lesson, scene: Scene) {
  return made("li", [`${scene.clock(lesson.tick)} ${lessonSentence(lesson, robotWords())}`]);
}

/** Fills the element `fault`; the button `break` injects what is chosen there. */
class FaultMenu {
  constructor(onBreak: (what: string) => void) {
    const menu = typedById("fault", HTMLSelectElement);
    inEachLanguage(() => offer(menu, FAULTS.map((what) => [what, faultName(what)])));
    byId("break").addEventListener("click", () => onBreak(menu.value));
  }
}

function faultName(what: string) {
  return heard(bodySentence(what)).replace(/\.$/, "");
}

/**
 * Fills a field, and keeps the choice that was made.
 * @param options - Their values and names.
 */
function offer(select: HTMLSelectElement, options: [string, string][]) {
  const chosen = select.value || options[0][0];
  select.replaceChildren(...options.map(([value, name]) => new Option(name, value, false, value === chosen)));
}
