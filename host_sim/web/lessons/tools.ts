/* Tools that stand in the steps of the lessons. */

import { buttonOf, byId, choiceOf, made, setText } from "../core/dom.js";
import { heard, languageCode, robotWords, say } from "../core/language.js";
import { filled } from "../core/phrases.js";
import { SENSORS } from "../core/sensors.js";
import { CELL_COUNT, PARAMETERS, SIDE } from "../generated.js";
import { makeButton as makeCellButton, pictureOf, showSide, sideName } from "../panel/cells_view.js";
import { DotPlot } from "./samples.js";
import { settingAt, ticksPerObstacle } from "./evidence.js";
import { beadsAt } from "./goals.js";
import type { Texts as AllTexts } from "../core/language.js";
import type { LabPage } from "../lab/lab_page.js";

type Texts = AllTexts["lessons"];

/** A tool in the page; `show` brings it up to date. */
export type Tool = { element: HTMLElement; show: () => void };

type Parameter = keyof typeof PARAMETERS;

const DISTRUST_DECISIONS = 32;

export type ToolName = keyof typeof MAKERS;

const MAKERS = {
  patience: makePatience,
  sensors: makeSensors,
  distrust: (lab: LabPage, { words }: Texts) => makeSwitch(lab, "distrust", DISTRUST_DECISIONS, words.distrust),
  share: (lab: LabPage, { words }: Texts) => makeSwitch(lab, "share", 1, words.share),
  score: makeScore,
  talk: makeTalk,
  teach: makeTeaching,
  boxes: (lab: LabPage) => new Boxes(lab),
  samples: (lab: LabPage, { words }: Texts) => new DotPlot(lab.course.samples, words),
  whatIf: () => makeButton(say("whatIf"), () => byId("what-if").click()),
  addPlant: () => makeButton(say("addPlant"), () => byId("add-plant").click()),
  erase: () => makeButton(say("erase"), () => byId("erase").click()),
  swap: (lab: LabPage, { words }: Texts) => makeButton(words.swap, () => swapMotors(lab)),
};

export function toolOf(name: ToolName, lab: LabPage, texts: Texts): Tool {
  return MAKERS[name](lab, texts);
}

function makeButton(text: string, onClick: () => void): Tool {
  const button = buttonOf(text, onClick);
  button.className = "main";
  return { element: button, show: () => {} };
}

/** Swaps the motors of the robots of all runs, before the tick that is shown next. */
function swapMotors(lab: LabPage) {
  const tick = Math.min(lab.tick + 1, ...lab.lanes.map(({ last }) => last));
  for (const lane of lab.lanes) {
    lane.change({ do: "body", what: "swap-motors", robot: 0, seed: 0, tick });
    lab.simulate(lane);
  }
  lab.goAhead(tick);
}

/** Sets a parameter of all robots of the selected run, from its start. */
function setForAll(lab: LabPage, name: Parameter, value: number) {
  const { lane } = lab;
  const robots = lane.experiment.robots.map((setup) => ({ ...setup, settings: { ...setup.settings, [name]: value } }));
  lane.experiment = { ...lane.experiment, robots };
  lab.simulate(lane);
}

function current({ lane, tick }: LabPage, name: Parameter) {
  return settingAt(lane, { robot: lane.robot, name }, tick);
}

/** @param on - The value that switches it on. */
function makeSwitch(lab: LabPage, name: Parameter, on: number, text: string): Tool {
  const input = made("input", [], { type: "checkbox" });
  input.addEventListener("change", () => setForAll(lab, name, input.checked ? on : 0));
  const show = () => {
    input.checked = current(lab, name) > 0;
  };
  return { element: made("label", [input, ` ${text}`], { class: "check" }), show };
}

function makePatience(lab: LabPage, { words }: Texts): Tool {
  const { min, max } = PARAMETERS.boredom_limit;
  const input = made("input", [], { type: "range", min: `${min}`, max: `${max}`, step: "1", id: "patience" });
  const label = made("label", [], { for: "patience" });
  const write = () => setText(label, filled(words.patience, { turns: input.value }));
  input.addEventListener("input", write);
  input.addEventListener("change", () => setForAll(lab, "boredom_limit", Number(input.value)));
  const show = () => {
    if (document.activeElement !== input) input.value = `${current(lab, "boredom_limit")}`;
    write();
  };
  return { element: made("div", [label, input], { class: "patience" }), show };
}

function makeSensors(lab: LabPage, { words }: Texts): Tool {
  const states: [string, string][] = [["sound", words.sound], ["stuck-on", words.stuckOn], ["stuck-off", words.stuckOff]];
  const choices: ReturnType<typeof choiceOf>[] = SENSORS.map((name) => choiceOf(heard(name), states, () => breakAsChosen()));
  const breakAsChosen = () => breakSensors(lab, choices.map(({ select }) => select.value));
  const fields = made("fieldset", [made("legend", [words.sensors]), ...choices.map(({ label }) => label).reverse()]);
  const show = () => {
    choices.forEach(({ select }, place) => {
      if (document.activeElement !== select) select.value = stateOf(lab, SENSORS[place]);
    });
  };
  fields.className = "sensors";
  return { element: fields, show };
}

/** @param states - Of the sensors, from bit 0 of `feel` on. */
function breakSensors(lab: LabPage, states: string[]) {
  const { robot } = lab.lane;
  const faults = states.flatMap((state, place) => (state === "sound" ? [] : [`${state}:${SENSORS[place]}`]));
  for (const what of ["repair", ...faults]) lab.change({ do: "body", what, robot, seed: 0 });
}

/** What `breakSensors` last did to a sensor. */
function stateOf({ lane, tick }: LabPage, sensor: string) {
  const done = lane.experiment.changes.flatMap((change) =>
    change.do === "body" && (change.robot ?? 0) === lane.robot && change.tick <= tick ? [change.what] : []);
  const [what, which] = done.filter((it) => it === "repair" || it.endsWith(`:${sensor}`)).at(-1)?.split(":") ?? [];
  return what && which ? what : "sound";
}

function makeScore(lab: LabPage, { words }: Texts): Tool {
  const element = made("p", [], { class: "score" });
  const show = () => {
    const scores = lab.lanes.flatMap(({ data, name }) => {
      const ticks = data ? ticksPerObstacle(data.robots[0], lab.tick) : NaN;
      if (!data || Number.isNaN(ticks)) return [];
      return [filled(words.score, { run: name, seconds: thousandths((ticks * data.measures.tick_ms) / 1000) })];
    });
    setText(element, scores.join("\n") || words.noScore);
  };
  return { element, show };
}

/** The box to talk in. */
function makeTalk(lab: LabPage): Tool {
  const element = made("div", []);
  return { element, show: () => lab.talk.moveTo(element) };
}

/** A form to teach a speaker a word. */
function makeTeaching(lab: LabPage, { words }: Texts): Tool {
  const [word, answer] = ["teach-word", "teach-answer"].map((id) => made("input", [], { id, maxlength: "60", required: "" }));
  const fields = [made("label", [`${words.word} `, word]), made("label", [`${words.answer} `, answer])];
  const form = made("form", [...fields, made("button", [words.teach])], { class: "teach" });
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    lab.teach(lab.talk.who.value, word.value, answer.value);
    form.reset();
  });
  return { element: form, show: () => {} };
}

/** A number as the language of the lessons writes it. */
function thousandths(number: number) {
  return number.toLocaleString(languageCode(), { minimumFractionDigits: 3, maximumFractionDigits: 3 });
}

const ARROWS = ["–", "↰", "↱"];
const BEAD = "●";

/**
 * Seven boxes, one for each pattern with something in the way: the turn that the robot knows, and how many beads are in it.
 * Pressing a box changes what the selected robot knows.
 */
class Boxes {
  boxes = Array.from({ length: CELL_COUNT - 1 }, (_, i) => this.makeBox(i + 1));
  element = made("ol", this.boxes.map(({ button }) => made("li", [button])), { class: "boxes" });

  constructor(readonly lab: LabPage) {}

  makeBox(cell: number) {
    const { lab } = this;
    const button = makeCellButton(cell, (_, side) => lab.change({ do: "write", robot: lab.lane.robot, cell, side }));
    const [side, beads] = ["side", "beads"].map((name) => made("span", [], { class: name }));
    button.append(pictureOf(cell), side, beads);
    return { cell, button, side, beads };
  }

  show() {
    const { lane, tick } = this.lab;
    const known = lane.scene?.states[lane.robot].memory ?? [];
    const counts = beadsAt(lane, tick, lane.robot);
    for (const { cell, button, side, beads } of this.boxes) {
      const is = known[cell] ?? SIDE.NOTHING;
      showSide(button, is);
      side.textContent = ARROWS[is];
      beads.textContent = BEAD.repeat(counts[cell]);
      const words = [robotWords().patterns[cell], sideName(is), ...(counts[cell] ? [BEAD.repeat(counts[cell])] : [])];
      button.setAttribute("aria-label", say("cell", { cell, words: words.join(", ") }));
    }
  }
}
