// @ts-check
/* The page: a recorded run, or runs of the real firmware, side by side; each change leads to another future. */

import { SidePanel } from "./side_panel.js";
import { buttonOf } from "../core/dom.js";
import { byId, isForPage, mayMove, setText, typedById } from "../core/elements.js";
import { LANGUAGES, heard, inEachLanguage, languageCode, nameIn, say } from "../core/language.js";
import { LabEditor } from "./lab_editor.js";
import { experimentOf, inWords } from "./shown_run.js";
import { nextTick } from "./run_events.js";
import { ENDED, Laboratory } from "./laboratory.js";
import { Course } from "../lessons/course.js";
import { PLANS } from "../lessons/plans.js";
import { settingAt } from "../lessons/evidence.js";
import { Panel } from "../panel/panel.js";
import { DivergenceView } from "../panel/divergence.js";
import { RobotPicker } from "../panel/robot_picker.js";
import { RunData } from "../core/run_data.js";
import { linkOf } from "../program/link.js";
import { ProgramTab } from "../program/program_tab.js";
import { fieldsOf } from "./share.js";
import { drawMarks } from "../panel/timeline.js";
import { Conversations } from "../talk/conversation.js";
import { TalkBox } from "../talk/talk_box.js";

/** What a page that simulates nothing does not have. */
const SIMULATED = "#lift, #add-bar, #add-plant, #erase, #freeze, #break, #behaviour, #robot-seed, #when, #new-run :is(button, input, select), "
  + "#tab-parameters, #tab-program, #tab-files, #tab-lessons";

/** Shows the laboratory's runs, and what belongs to the one that is selected. */
class LabPage extends Laboratory {
  /**
   * @param {import("./laboratory.js").Parts} parts
   * @param {RunData} [recorded] - The run to show; a new one by default.
   */
  constructor(parts, recorded) {
    const { seed, of } = recorded?.sceneAt(recorded.first) ?? { seed: 1, of: 5 };
    const robots = recorded?.robots.length ?? 1;
    super(parts, experimentOf({ seed, environments: of, robots, profile: recorded ? "" : "article" }), recorded);
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
    /** @type {number | undefined} - The tick that the memory is compared with. */
    this.pinned = undefined;
    byId("pin").addEventListener("click", () => this.pin());
    byId("back").addEventListener("click", () => location.reload());
    inEachLanguage(() => {
      setText(this.share, say("copyLink"));
      this.share.title = say("copyLinkHelp");
      this.showPin();
    });
    /** @type {RobotPicker | undefined} */
    this.picker = undefined;
    /** @type {LabEditor | undefined} */
    this.editor = undefined;
    addEventListener("hashchange", () => location.reload()); // what follows the # is read when the page begins
    this.playsNext = !recorded && !location.hash && mayMove();
    if (parts.why) withhold(SIMULATED, parts.why, this.note);
    this.onScene();
    if (recorded) this.followAddress();
  }

  /** Shows the tick that the run names; of a live run, does what the address asks for: the tick before which it was left, or its end. */
  followAddress() {
    if (!location.protocol.startsWith("http")) {
      this.go(this.recorded?.run.shown ?? this.first);
      return;
    }
    const asked = new URLSearchParams(location.hash.slice(1));
    byId("to-live").hidden = location.hash === ENDED;
    byId("to-live").addEventListener("click", () => location.assign("/"));
    this.go(Number(asked.get("tick") ?? this.last));
    if (asked.has("what-if")) this.whatIf();
  }

  /** Begins to compare the present memory with that of other times; called again, ends it. */
  pin() {
    this.pinned = this.pinned === undefined ? this.tick : undefined;
    this.showPin();
    this.stale = true;
  }

  showPin() {
    const { pinned, scene } = this;
    byId("pin").setAttribute("aria-pressed", `${pinned !== undefined}`);
    setText(byId("pin"), pinned === undefined ? say("compareNow") : say("comparedWith", { time: scene?.clock(pinned) ?? "" }));
  }

  /** @override */
  onLanes() {
    byId("back").hidden = !this.recorded || this.lanes.some(({ isRecorded }) => isRecorded);
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
    const { profile } = experiment.robots[robot];
    /** @type {[number, string][]} */
    const starts = profile ? [[0, profile]] : []; // of a recorded run it may not be known
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
    if (!lane.isRecorded) {
      const boredom = settingAt(lane, { robot: lane.robot, name: "boredom_limit" }, tick);
      scene.measures = { ...scene.measures, boredom };
    }
    this.panel.show(scene, { exact: !this.playing, ...this.otherMemory(data) });
    this.picker?.show();
    this.desk.show();
    setText(byId("news"), scene.lastNews);
    if (!byId("panel-talk").hidden) this.talk.moveTo(byId("panel-talk"));
    this.course.show();
    this.programTab.show();
    this.parting.show(lanes, lane);
    this.showTime(scene.clock(tick));
  }

  /**
   * The memory at another time, or in the first other run, to compare with.
   * @param {RunData} data
   */
  otherMemory(data) {
    if (this.pinned !== undefined) return { then: data.robots[this.lane.robot].memoryAt(this.pinned) };
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
    const fields = event.key === " " ? "select, button, input:not(#scrub), summary, textarea" : "select, input:not(#scrub), [role=tab], textarea";
    return isForPage(event, fields) && !event.defaultPrevented && !(inArena && event.key.startsWith("Arrow"));
  }

  /**
   * @override
   * @param {number} step
   */
  actions(step) {
    return { ...super.actions(step), p: () => this.jump(-1), w: () => this.whatIf() };
  }
}

/**
 * Controls of which this page cannot do what they are for say why, when they are looked at or pressed.
 * @param {string} selector
 * @param {string} why
 * @param {import("../core/toast.js").Toast} note
 */
function withhold(selector, why, note) {
  const controls = [...document.querySelectorAll(selector)];
  inEachLanguage(() => controls.forEach((control) => control.setAttribute("title", heard(why))));
  for (const control of controls) {
    control.setAttribute("aria-disabled", "true");
    if (control instanceof HTMLInputElement || control instanceof HTMLSelectElement) control.disabled = true;
  }
  document.addEventListener("click", (event) => {
    if (!(event.target instanceof Element && event.target.closest("[aria-disabled=true]"))) return;
    event.preventDefault();
    event.stopPropagation();
    note.show(heard(why));
  }, { capture: true });
}

async function start() {
  const [parts, run] = ["parts", "run"].map((id) => JSON.parse(byId(id).textContent || "null"));
  Object.assign(window, { octet: new LabPage(parts, run ? await RunData.from(run) : undefined) });
}

start().catch((error) => setText(byId("status"), heard(error.message)));
