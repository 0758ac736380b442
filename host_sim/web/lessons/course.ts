/* The course: the open lesson and its goals, which are checked against the runs. */

import { byId } from "../core/dom.js";
import { keep, kept } from "../core/storage.js";
import { LessonView } from "./lesson_view.js";
import { inEachLanguage, wordsOf } from "../core/language.js";
import { PLANS } from "./plans.js";
import { Samples } from "./samples.js";
import { Worksheet } from "./worksheet.js";
import { Classroom } from "../lab/classroom.js";
import type { LabPage } from "../lab/lab_page.js";
import type { Goal } from "./plans.js";

/** Shows lessons in the element panel-lessons. The part of the address behind # may name the one to open. */
export class Course {
  /** By lesson, the indices of the goals reached and of the steps done; the browser keeps them. */
  progress: Record<string, { goals: number[]; steps: number[] }> = progressIn(kept("lessons"));
  plan = PLANS.find(({ id }) => `#${id}` === location.hash) ?? PLANS.find(({ id }) => id === kept("lesson")) ?? PLANS[0];
  begun = false;
  samples = new Samples(this.lab.simulator, () => this.lab.lightUp());
  sheet = new Worksheet();
  classroom = new Classroom(this);
  view = new LessonView(this);

  constructor(readonly lab: LabPage) {
    inEachLanguage(() => this.renew());
    byId("tab-lessons").addEventListener("click", () => this.view.reveal());
    addEventListener("beforeprint", () => this.onPrint());
    if (`#${this.plan.id}` === location.hash) byId("tab-lessons").click();
  }

  /** The indices of the goals that are reached. */
  get reached() {
    return new Set(this.progress[this.plan.id]?.goals);
  }

  /** The indices of the steps that are done. */
  get done() {
    return new Set(this.progress[this.plan.id]?.steps);
  }

  get next() {
    return PLANS[PLANS.indexOf(this.plan) + 1];
  }

  note(goals: Iterable<number>, steps: Iterable<number>) {
    this.progress = { ...this.progress, ...progressIn(kept("lessons")) }; // another tab may be at another lesson
    this.progress[this.plan.id] = { goals: [...goals], steps: [...steps] };
    keep("lessons", JSON.stringify(this.progress));
  }

  /** Marks a step as done. */
  tick(step: number) {
    this.note(this.reached, this.done.add(step));
    this.show();
  }

  get texts() {
    return wordsOf("lessons");
  }

  choose(id: string) {
    this.plan = PLANS.find((plan) => plan.id === id) ?? this.plan;
    keep("lesson", id);
    this.begun = false;
    this.renew();
    byId("lesson").focus();
    this.view.reveal();
  }

  /** Continues a lesson whose run is shown already, as a link does. */
  resume(id: string, step: number) {
    this.choose(id);
    this.view.go(Math.min(step, this.view.steps.length - 1));
    this.begun = true;
    byId("tab-lessons").click();
  }

  renew() {
    this.view = new LessonView(this);
    if (this.lab.lane) this.show();
  }

  /** Sets up the runs of the lesson. */
  begin() {
    const [first, ...others] = this.plan.begin();
    this.note([], []);
    this.view.go(0);
    this.begun = true;
    this.lab.begin(first);
    this.lab.restartTalk();
    this.samples.forget();
    for (const experiment of others) this.lab.select(this.lab.addLane(experiment));
    this.lab.lanes.forEach((lane, i) => (lane.called = this.plan.names?.[i] ?? ""));
  }

  /** Checks which goals the runs shown now have reached, and shows it. */
  show() {
    if (this.begun) this.check();
    if (!byId("panel-lessons").hidden) this.view.show();
  }

  /** Notes the goals that are reached now, and the steps that the page has seen done. */
  check() {
    const { lanes, tick, talk } = this.lab;
    const runs = lanes.flatMap((lane) => (lane.data ? [{ lane, data: lane.data }] : []));
    if (runs.length < lanes.length) return;
    const { reached, done, samples, plan } = this;
    const found = (checks: (Goal | undefined)[], known: Set<number>) => checks.flatMap((check, i) => (known.has(i) || !check?.(runs, tick, { talk, samples }) ? [] : [i]));
    const goals = found(plan.goals, reached);
    const steps = found(plan.steps.map(({ seen }) => seen), done);
    if (goals.length || steps.length) this.note([...reached, ...goals], [...done, ...steps]);
    if (goals.length && this.reached.size === plan.goals.length) this.lab.note.show(this.texts.words.allReached);
  }

  /** @param notes - Whether to print those for teachers, and not the worksheet. */
  print(notes: boolean) {
    this.sheet.fill(this.plan, this.texts, notes);
    print();
  }

  /** Printing the page while a lesson is open prints its worksheet. */
  onPrint() {
    if (!byId("panel-lessons").hidden && this.sheet.isEmpty) this.sheet.fill(this.plan, this.texts, false);
  }
}

/** The progress in a kept text; none if it is not one of ours. */
function progressIn(text: string): Record<string, { goals: number[]; steps: number[] }> {
  try {
    const read = JSON.parse(text || "{}");
    return Object.fromEntries(PLANS.flatMap(({ id }) => {
      const { goals, steps } = read[id] ?? {};
      return Array.isArray(goals) && Array.isArray(steps) ? [[id, { goals, steps }]] : [];
    }));
  } catch {
    return {};
  }
}
