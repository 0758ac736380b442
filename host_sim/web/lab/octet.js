// @ts-check
/* octet.html: runs of the real firmware in this page, side by side; each change leads to another future. */

import { SidePanel } from "./side_panel.js";
import { buttonOf } from "../core/dom.js";
import { byId, isForPage, mayMove, setText, typedById } from "../core/elements.js";
import { LANGUAGES, heard, inEachLanguage, languageCode, nameIn, say } from "../core/language.js";
import { LabEditor } from "./lab_editor.js";
import { experimentOf, inWords } from "./shown_run.js";
import { nextTick } from "./run_events.js";
import { Laboratory } from "./laboratory.js";
import { Course } from "../lessons/course.js";
import { PLANS } from "../lessons/plans.js";
import { settingAt } from "../lessons/evidence.js";
import { Panel } from "../panel/panel.js";
import { DivergenceView } from "../panel/divergence.js";
import { RobotPicker } from "../panel/robot_picker.js";
import { linkOf } from "../program/link.js";
import { ProgramTab } from "../program/program_tab.js";
import { fieldsOf } from "./share.js";
import { drawMarks } from "../panel/timeline.js";
import { Conversations } from "../talk/conversation.js";
import { TalkBox } from "../talk/talk_box.js";

/**
 * A recorded run that the page begins with: the tick and the robot that are shown.
 * @typedef {{recorded: RecordedRun, tick: number, node: number}} Begin
 */

/** Shows the laboratory's runs, and what belongs to the one that is selected. */
class LabPage extends Laboratory {
  /**
   * @param {import("./laboratory.js").Parts} parts
   * @param {Begin | null} begin - What to begin with; null for a new run.
   */
  constructor(parts, begin) {
    const first = experimentOf({ seed: 1, environments: 5, robots: 1, profile: "article" });
    super(parts, begin ? { ...first, ticks_max: 1 } : first);
    this.panel = new Panel((cell, side) => this.change({ do: "write", robot: this.lane.robot, cell, side }));
    this.desk = new SidePanel(this);
    this.conversations = new Conversations();
    this.talk = new TalkBox(byId("panel-talk"), this);
    /** @type {Course} */
    this.course = new Course(this);
    this.programTab = new ProgramTab(this);
    this.parting = new DivergenceView();
    this.share = buttonOf("", () => this.copyLink());
    this.share.id = "copy-link";
    byId("status").after(this.share);
    inEachLanguage(() => {
      setText(this.share, say("copyLink"));
      this.share.title = say("copyLinkHelp");
    });
    /** @type {RobotPicker | undefined} */
    this.picker = undefined;
    /** @type {LabEditor | undefined} */
    this.editor = undefined;
    /** Settled when a recorded run that the page begins with, and its copy, are simulated to their ends. */
    this.repeated = begin ? this.repeat(begin) : Promise.resolve();
    addEventListener("hashchange", () => location.reload()); // what follows the # is read when the page begins
    this.playsNext = !begin && !location.hash && mayMove();
  }

  /**
   * Simulates a recorded run again, and lays a copy beside it.
   * @param {Begin} begin
   */
  async repeat({ recorded, tick, node }) {
    this.begin(await this.simulator.ask("repeat", { recorded }));
    await this.lane.done;
    this.go(tick);
    this.whatIf();
    await this.lane.done;
    this.pick(node);
  }

  /** @override */
  onLanes() {
    byId("floors").dataset.lanes = `${this.lanes.length}`;
    typedById("remove-lane", HTMLButtonElement).disabled = this.lanes.length < 2;
    typedById("what-if", HTMLButtonElement).disabled = this.isFull;
    this.stale = true;
  }

  /** @override */
  onScene() {
    const { scene } = this;
    this.resize();
    if (!scene) return;
    if (this.playsNext) this.setPlaying(true);
    this.playsNext = false;
    this.picker ??= new RobotPicker(scene, (node) => this.pick(node));
    this.picker.scene = scene;
    this.editor ??= new LabEditor(this, scene);
    this.editor.scene = scene;
    for (const lane of this.lanes) this.editor.watch(lane);
  }

  /** @override */
  onRefusal() {
    this.editor?.onRefusal();
  }

  /**
   * @param {string} who
   * @param {string} sentence
   */
  async ask(who, sentence) {
    const { data, robot, experiment } = this.lane;
    if (!data) return;
    /** @type {[number, string][]} */
    const starts = [[0, experiment.robots[robot].profile]];
    for (const change of experiment.changes) {
      const told = inWords(change);
      if (told.do === "start" && told.robot === robot) starts.push([change.tick, told.profile]);
    }
    const about = { data, robot, tick: Math.min(this.tick, data.last), told: { starts, health: [] } };
    const [exchange, places] = await this.conversations.ask(who, sentence, about);
    this.talk.answer({ ...exchange, changes: experiment.changes.length }, places);
  }

  /**
   * Teaches a speaker what to say to a word.
   * @param {string} who
   * @param {string} word
   * @param {string} answer
   */
  async teach(who, word, answer) {
    (await this.conversations.all)[who].teach(word, answer);
    this.talk.taught.add(answer.toUpperCase());
  }

  /** All that was said and taught is forgotten. */
  restartTalk() {
    this.conversations = new Conversations();
    this.talk.forget();
  }

  /** What a link can name. */
  get known() {
    const lessons = PLANS.map(({ id }) => id);
    return { programs: this.programs, worlds: Object.keys(this.worlds), lessons, languages: LANGUAGES.map(([code]) => code) };
  }

  /**
   * The part of an address behind the page's own, with its #, that shows a run as it is shown now.
   * @param {Experiment} experiment
   * @param {Partial<import("../program/link.js").Linked>} [others] - Fields that are not those of the experiment.
   */
  link(experiment, others = {}) {
    const { course, tick } = this;
    const lesson = course.begun ? { lesson: course.plan.id, step: course.view.place } : {};
    return linkOf({ ...fieldsOf(experiment), tick: Math.round(tick), ...lesson, language: languageCode(), ...others }, this.known);
  }

  /** Puts all that is shown into the address, and into the clipboard. */
  copyLink() {
    const { experiment } = this.lane;
    history.replaceState(null, "", this.link(experiment));
    const where = typeof (experiment.world ?? "") === "string" ? "linkCopied" : "linkWithoutWorld";
    const tell = (/** @type {"linkCopied" | "linkInAddress" | "linkWithoutWorld"} */ words) => this.note.show(say(words));
    tell("linkInAddress");
    navigator.clipboard?.writeText(location.href).then(() => tell(where), () => {});
  }

  /** @param {number} node */
  pick(node) {
    if (this.scene) this.scene.node = node;
    this.onScene();
  }

  /** @override */
  drawMarks() {
    const { data, robot } = this.lane;
    if (data) drawMarks(this.marks, data.robots[robot], { first: this.first, last: this.last });
  }

  /**
   * @override
   * @param {number} step
   */
  jump(step) {
    const { data, robot } = this.lane;
    if (!data) return;
    const kind = typedById("kind", HTMLSelectElement).value;
    const tick = nextTick(data.robots[robot], kind, this.tick, step);
    if (tick === undefined) this.note.show(say(step > 0 ? "noLater" : "noEarlier", { kind: nameIn("kinds", kind) }));
    else this.seek(tick);
  }

  /** @override */
  draw() {
    const { lane, lanes, tick } = this;
    const { scene, data } = lane;
    if (!scene || !data) return;
    this.editor?.beforeDrawing();
    for (const each of lanes) {
      if (each.scene) this.panel.settle(each.scene, !this.playing);
      each.draw(tick);
      each.figure.classList.toggle("selected", each === lane);
    }
    this.panel.settle(scene, !this.playing);
    const boredom = settingAt(lane, { robot: lane.robot, name: "boredom_limit" }, tick);
    scene.measures = { ...scene.measures, boredom };
    this.panel.show(scene, { exact: !this.playing, ...this.otherMemory() });
    this.picker?.show();
    this.desk.show();
    setText(byId("news"), scene.lastNews);
    if (!byId("panel-talk").hidden) this.talk.moveTo(byId("panel-talk"));
    this.course.show();
    this.programTab.show();
    this.parting.show(lanes, lane);
    this.showTime(scene.clock(tick));
  }

  /** The memory in the first other run, to compare with. */
  otherMemory() {
    const other = this.lanes.find((lane) => lane !== this.lane && lane.scene);
    const states = other?.scene?.states ?? [];
    return { then: states[Math.min(this.lane.robot, states.length - 1)]?.memory, where: say("inRun") };
  }

  /**
   * @override
   * @param {KeyboardEvent} event
   */
  takesKey(event) {
    const inArena = event.target instanceof HTMLCanvasElement;
    const fields = event.key === " " ? "select, button, input, summary, textarea" : "select, input:not(#scrub), [role=tab], textarea";
    return isForPage(event, fields) && !event.defaultPrevented && !(inArena && event.key.startsWith("Arrow"));
  }

  /**
   * @override
   * @param {number} step
   */
  actions(step) {
    return { ...super.actions(step), b: () => this.jump(-1) };
  }
}

try {
  const [parts, begin] = ["parts", "begin"].map((id) => JSON.parse(byId(id).textContent || "null"));
  Object.assign(window, { octet: new LabPage(parts, begin) });
} catch (error) {
  setText(byId("status"), heard(error instanceof Error ? error.message : `${error}`));
}
