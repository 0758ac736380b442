/* The tab with a program for a robot, which runs beside the firmware, step by step if desired. */

import { buttonOf, byId, choiceOf, made, setText, termsOf } from "../core/dom.js";
import { heard, inEachLanguage, speak, wordsOf } from "../core/language.js";
import { filled } from "../core/phrases.js";
import { experimentFrom } from "../lab/share.js";
import { partingOf } from "../panel/divergence.js";
import { Editor } from "./editor.js";
import { linkedIn, tellFound } from "./link.js";
import { ProgramSteps } from "./program_steps.js";
import type { ShownRun } from "../lab/shown_run.js";
import type { LabPage } from "../lab/lab_page.js";
import type { ProgramState } from "../sim/native_program.js";
import type { Experiment } from "../types.js";

const FIRST = "article";
const WHEELS = ["left", "right"];

/** Fills the element panel-program. The part of the address behind # may have an experiment. */
export class ProgramTab {
  steps = new ProgramSteps(this.lab.simulator);
  editor = new Editor(() => this.onInput());
  isChanged = false;
  news = made("p", [], { id: "program-news", role: "status" });
  parting = made("p", [], { id: "program-parting", role: "status" });
  variables = made("dl", [], { id: "program-variables" });
  choice = made("select", []);
  /** The runs whose parting is shown. */
  compared: unknown[] = [];
  /** The message about a link, in the language of the page. */
  note = () => "";

  constructor(readonly lab: LabPage) {
    this.choose(FIRST); // before the editor is in the document, so that no layout is needed
    inEachLanguage(() => this.build());
    for (const event of ["click", "focus"]) byId("tab-program").addEventListener(event, () => this.show());
    this.follow(location.hash);
  }

  get texts() {
    return wordsOf("program");
  }

  /** The run of the program; undefined before the first one. */
  get own() {
    return this.lab.lanes.find(({ experiment }) => experiment.robots[0].program !== undefined);
  }

  /** The run of the firmware. */
  get octet() {
    return this.lab.lanes.find(({ experiment }) => experiment.robots[0].program === undefined);
  }

  build() {
    const { texts, choice } = this;
    const { label, select } = choiceOf(texts.choose, Object.entries(texts.names), (name) => this.choose(name));
    this.choice = select;
    select.id = "program-choice";
    select.value = choice.value || FIRST;
    const actions: [string, string, () => void][] = [
      ["run", texts.run, () => this.run()], ["step", texts.step, () => this.step()],
      ["decision", texts.decision, () => this.nextDecision()], ["link", texts.link, () => this.link()],
    ];
    const buttons = actions.map(([id, text, action]) => Object.assign(buttonOf(text, action), { id: `program-${id}` }));
    buttons[0].className = "main";
    this.editor.field.setAttribute("aria-label", texts.editor);
    this.variables.setAttribute("aria-label", texts.variables);
    const controls = made("div", [label, ...buttons], { id: "program-controls", class: "controls" });
    byId("panel-program").replaceChildren(controls, this.parting, this.news, this.editor.element, this.variables);
    this.compared = [];
  }

  choose(name: string) {
    this.choice.value = name;
    this.editor.text = this.lab.parts.programs[name];
    this.onInput();
  }

  onInput() {
    this.isChanged = true;
    this.show();
  }

  /** Runs the program from the start, beside the firmware in the same world. */
  run() {
    this.lab.whole().then(() => this.runBeside(), ({ message }) => this.lab.note.show(heard(message)));
  }

  runBeside() {
    const { lab, own } = this;
    const program = this.editor.text;
    this.isChanged = false;
    this.note = () => "";
    lab.setPlaying(false);
    if (own) {
      own.experiment = programmed(own.experiment, program);
      lab.simulate(own);
    } else {
      if (lab.isFull) lab.begin({ ...lab.lane.experiment, changes: [] });
      const { ticks_max: _, ...experiment } = lab.lane.experiment;
      lab.addLane(programmed({ ...experiment, changes: [] }, program));
    }
    lab.select(this.own as ShownRun);
    lab.go(0);
    lab.setPlaying(true);
  }

  /** Goes to the next line or, after a decision's last one, to the first line of the next decision. */
  step() {
    this.lab.setPlaying(false);
    if (this.own && !this.steps.advance()) this.nextDecision();
    else this.show();
  }

  nextDecision() {
    const { lab, own } = this;
    lab.setPlaying(false);
    if (!own?.data) return;
    const tick = own.data.robots[0].nextTick("decision", lab.tick, 1);
    if (tick === undefined) return;
    this.steps.beginAt(tick);
    lab.go(tick);
  }

  /** What the page shows, as a link with this program. */
  link() {
    this.lab.copyLink((this.octet ?? this.lab.lane).experiment, { program: this.editor.text });
  }

  /** Shows the experiment of a link; ignores any other hash. */
  follow(hash: string) {
    const { lab } = this;
    const found = linkedIn(hash, lab.known);
    if (!found) return;
    const { program, language, tick, lesson, step } = found.taken;
    if (language) speak(language);
    const experiment = experimentFrom(found.taken);
    lab.begin(experiment);
    this.note = () => tellFound(found, this.texts);
    if (lesson) lab.course.resume(lesson, step ?? 0);
    if (program !== undefined) {
      this.editor.text = program;
      this.isChanged = false;
      lab.select(lab.addLane(programmed(experiment, program)));
      byId("tab-program").click();
    }
    if (tick) lab.lane.done.then(() => lab.seek(tick));
  }

  show() {
    if (byId("panel-program").hidden) return;
    const { own, lab } = this;
    if (own) this.steps.look(own, lab.tick, () => this.show());
    const state = this.isChanged ? undefined : this.steps.state;
    const mistake = state?.mistake ?? null;
    this.editor.show(state && !state.ended && !mistake ? this.steps.line : 0, mistake?.line ?? 0);
    this.showNews(state);
    this.showVariables(state ? this.steps.values : []);
    this.showParting();
  }

  showNews(state: ProgramState | undefined) {
    const { texts } = this;
    const mistake = state?.mistake;
    const expected = mistake ? (texts.expected[mistake.expected] ?? mistake.words) : "";
    const word = mistake?.word ? filled(texts.quoted, { word: mistake.word }) : texts.lineEnds;
    const now = [
      this.isChanged ? texts.changed : "",
      mistake ? filled(texts.mistake, { line: `${mistake.line}`, word, expected }) : "",
      state?.ended ? texts.ended : "",
      state && !mistake && !state.ended && this.steps.line ? filled(texts.running, { line: `${this.steps.line}` }) : "",
      state?.shown.length ? filled(texts.shows, { shown: state.shown.join(" | ") }) : "",
      state?.printed.length ? filled(texts.prints, { printed: state.printed.join(" | ") }) : "",
    ];
    this.news.dataset.kind = mistake ? "mistake" : "";
    setText(this.news, [this.note(), ...now].filter(Boolean).join(" "));
  }

  showVariables(values: [string, string][]) {
    const key = JSON.stringify(values);
    if (this.variables.dataset.key === key) return;
    this.variables.dataset.key = key;
    this.variables.replaceChildren(...termsOf(values));
  }

  showParting() {
    const { texts, own, octet } = this;
    const compared = own && octet && !this.isChanged ? [octet.data, own.data, own.isRunning, octet.isRunning] : [];
    if (compared.length === this.compared.length && compared.every((it, i) => it === this.compared[i])) return;
    this.compared = compared;
    if (!own?.data || !octet?.data || this.isChanged || own.isRunning || octet.isRunning) setText(this.parting, "");
    else {
      const parting = partingOf(octet.data, own.data, WHEELS);
      setText(this.parting, parting ? filled(texts.parts, { time: own.scene?.clock(parting.tick) ?? "" }) : texts.same);
    }
  }
}

/** An experiment whose robots have a program for their brain. */
function programmed(experiment: Experiment, program: string): Experiment {
  return { ...experiment, robots: experiment.robots.map((it) => ({ ...it, profile: "article", program })) };
}
