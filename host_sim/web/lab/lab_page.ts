/* The page of a source: a recorded run, or runs of the real firmware, side by side; each change leads to another future. */

import { AtlasTab } from "./atlas_tab.js";
import { SidePanel } from "./side_panel.js";
import { byId, isForPage, mayMove, setText, typedById } from "../core/dom.js";
import { LANGUAGES, heard, inEachLanguage, languageCode, nameIn, say } from "../core/language.js";
import { ArenaEditor } from "../edit/arena_editor.js";
import { experimentOf, inWords } from "./shown_run.js";
import { Laboratory } from "./laboratory.js";
import { Course } from "../lessons/course.js";
import { PLANS } from "../lessons/plans.js";
import { settingAt } from "../lessons/evidence.js";
import { Panel, RobotPicker } from "../panel/panel.js";
import { DivergenceView } from "../panel/divergence.js";
import { linkOf } from "../program/link.js";
import { ProgramTab } from "../program/program_tab.js";
import { LinkCode, fieldsOf } from "./share.js";
import { drawMarks } from "../panel/timeline.js";
import { Conversations } from "../talk/conversation.js";
import { TalkBox } from "../talk/talk_box.js";
import type { RunData } from "../core/run_data.js";
import type { Toast } from "../core/toast.js";
import type { Linked } from "../program/link.js";
import type { Experiment } from "../types.js";
import type { Parts } from "./laboratory.js";

/** Controls that a page without simulation cannot offer, in two parts; a live run has the second. */
const SIMULATED = "#behaviour, #robot-seed, #when, #tab-parameters, #tab-program, #tab-atlas, #tab-files, #tab-lessons";
const CHANGES = "#lift, #add-bar, #add-plant, #erase, #freeze, #break, #new-run :is(button, input, select)";

/** Shows the laboratory's runs, and what belongs to the one that is selected. */
export class LabPage extends Laboratory {
  panel = new Panel((cell, side) => this.change({ do: "write", robot: this.lane.robot, cell, side }));
  desk = new SidePanel(this);
  atlas = new AtlasTab(byId("panel-atlas"), this);
  conversations = new Conversations();
  talk = new TalkBox(byId("panel-talk"), this);
  course = new Course(this);
  programTab = new ProgramTab(this);
  parting = new DivergenceView();
  /** The tick that the memory is compared with. */
  pinned: number | undefined;
  picker: RobotPicker | undefined;
  editor: ArenaEditor | undefined;

  /** @param recorded - The run to show; a new one by default. */
  constructor(parts: Parts, recorded?: RunData) {
    const { seed, of } = recorded?.sceneAt(recorded.first) ?? { seed: 1, of: 5 };
    const robots = recorded?.robots.length ?? 1;
    const { profile, settings } = parts.live ?? { profile: recorded ? "" : "article", settings: {} };
    const experiment = experimentOf({ seed, environments: of, robots, profile });
    experiment.robots.forEach((it) => Object.assign(it.settings, settings));
    super(parts, experiment, recorded);
    const code = new LinkCode();
    byId("copy-link").addEventListener("click", () => this.copyLink(this.lane.experiment));
    byId("show-link-code").addEventListener("click", () => code.show(new URL(this.link(this.lane.experiment), location.href).href));
    byId("pin").addEventListener("click", () => this.pin());
    byId("back").addEventListener("click", () => this.goBack());
    inEachLanguage(() => this.showPin());
    addEventListener("hashchange", () => location.reload()); // what follows the # is read when the page begins
    this.playsNext = !recorded && !location.hash && mayMove();
    const { why, live } = parts;
    if (why) withhold(live ? SIMULATED : `${SIMULATED}, ${CHANGES}`, () => heard(why), this.note);
    this.onScene();
    if (recorded) this.go(recorded.run.shown ?? this.first);
  }

  /** Shows the recorded run again, after others. */
  goBack() {
    location.reload();
  }

  /** Whether the recorded run is no longer shown. */
  get isAway() {
    return this.recorded !== undefined && !this.lanes.some(({ isRecorded }) => isRecorded);
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

  onLanes() {
    byId("back").hidden = !this.isAway;
    byId("floors").dataset.lanes = `${this.lanes.length}`;
    typedById("remove-lane", HTMLButtonElement).disabled = this.lanes.length < 2;
    typedById("what-if", HTMLButtonElement).disabled = this.isFull;
    this.stale = true;
  }

  onScene() {
    const { scene } = this;
    this.resize();
    if (!scene) return;
    if (this.playsNext) this.setPlaying(true);
    this.playsNext = false;
    this.picker ??= new RobotPicker(scene, (node) => this.pick(node));
    this.picker.scene = scene;
    this.editor ??= new ArenaEditor(this, scene);
    this.editor.scene = scene;
    for (const lane of this.lanes) this.editor.watch(lane);
  }

  onRefusal() {
    this.editor?.onRefusal();
  }

  async ask(who: string, sentence: string) {
    const { data, robot, experiment } = this.lane;
    if (!data) return;
    const { profile } = experiment.robots[robot];
    const starts: [number, string][] = profile ? [[0, profile]] : []; // it may be unknown for a recorded run
    for (const change of experiment.changes) {
      const told = inWords(change);
      if (told.do === "start" && told.robot === robot) starts.push([change.tick, told.profile]);
    }
    const about = { data, robot, tick: Math.min(this.tick, data.last), told: { starts, health: [] } };
    const [exchange, places] = await this.conversations.ask(who, sentence, about);
    this.talk.answer({ ...exchange, changes: experiment.changes.length }, places);
  }

  /** Teaches a speaker what to say to a word. */
  async teach(who: string, word: string, answer: string) {
    (await this.conversations.all)[who].teach(word, answer);
    this.talk.taught.add(answer.toUpperCase());
  }

  /** Forgets all that was said and taught. */
  restartTalk() {
    this.conversations = new Conversations();
    this.talk.forget();
  }

  /** What a link can name. */
  get known() {
    const lessons = PLANS.map(({ id }) => id);
    const { programs, worlds } = this.parts;
    return { programs, worlds: Object.keys(worlds), lessons, languages: LANGUAGES.map(([code]) => code) };
  }

  /**
   * The part of an address behind the page's own, with its #, that shows a run as it is shown now.
   * @param others - Fields that are not those of the experiment.
   */
  link(experiment: Experiment, others: Partial<Linked> = {}) {
    const { course, tick } = this;
    const lesson = course.begun ? { lesson: course.plan.id, step: course.view.place } : {};
    return linkOf({ ...fieldsOf(experiment), tick: Math.round(tick), ...lesson, language: languageCode(), ...others }, this.known);
  }

  /** Puts all that is shown into the address, and into the clipboard. The parameters are those of `link`. */
  copyLink(experiment: Experiment, others: Partial<Linked> = {}) {
    history.replaceState(null, "", this.link(experiment, others));
    this.note.show(say("linkInAddress"));
    const words = typeof (experiment.world ?? "") === "string" ? "linkCopied" : "linkWithoutWorld";
    navigator.clipboard?.writeText(location.href).then(() => this.note.show(say(words)), () => {});
  }

  pick(node: number) {
    if (this.scene) this.scene.node = node;
    this.onScene();
  }

  drawMarks() {
    const { data, robot } = this.lane;
    if (data) drawMarks(this.marks, data.eventsOf(robot), { first: this.first, last: this.last });
  }

  jump(step: number) {
    const { data, robot } = this.lane;
    if (!data) return;
    const kind = typedById("kind", HTMLSelectElement).value;
    const tick = data.robots[robot].nextTick(kind, this.tick, step);
    if (tick === undefined) this.note.show(say(step > 0 ? "noLater" : "noEarlier", { kind: nameIn("kinds", kind) }));
    else this.seek(tick);
  }

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
    if (!byId("panel-atlas").hidden) this.atlas.show();
    if (!byId("panel-talk").hidden) this.talk.moveTo(byId("panel-talk"));
    this.course.show();
    this.programTab.show();
    this.parting.show(lanes, lane);
    this.showTime(scene.clock(tick));
  }

  /** The memory at another time, or in the first other run, to compare with. */
  otherMemory(data: RunData) {
    if (this.pinned !== undefined) return { then: data.robots[this.lane.robot].memoryAt(this.pinned) };
    const other = this.lanes.find((lane) => lane !== this.lane && lane.scene);
    const states = other?.scene?.states ?? [];
    return { then: states[Math.min(this.lane.robot, states.length - 1)]?.memory, where: say("inRun") };
  }

  takesKey(event: KeyboardEvent) {
    const inArena = event.target instanceof HTMLCanvasElement;
    const fields = event.key === " " ? "select, button, input:not(#scrub), summary, textarea" : "select, input:not(#scrub), [role=tab], textarea";
    return isForPage(event, fields) && !event.defaultPrevented && !(inArena && event.key.startsWith("Arrow"));
  }

  override actions(step: number) {
    return { ...super.actions(step), p: () => this.jump(-1), w: () => this.whatIf() };
  }
}

/** Makes controls that do not work on this page say why, when they are hovered over or pressed. */
export function withhold(selector: string, why: () => string, note: Toast) {
  const controls = [...document.querySelectorAll(selector)];
  inEachLanguage(() => controls.forEach((control) => control.setAttribute("title", why())));
  for (const control of controls) {
    control.setAttribute("aria-disabled", "true");
    if (control instanceof HTMLInputElement || control instanceof HTMLSelectElement) control.disabled = true;
  }
  document.addEventListener("click", (event) => {
    const { target } = event;
    if (!(target instanceof Node && controls.some((control) => control.contains(target)))) return;
    event.preventDefault();
    event.stopPropagation();
    note.show(why());
  }, { capture: true });
}
