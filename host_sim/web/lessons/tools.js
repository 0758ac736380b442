// @ts-check
/* Tools that stand in the steps of the lessons. */

import { byId, setText } from "../core/elements.js";
import { heard, languageCode, say } from "../core/language.js";
import { filled } from "../core/phrases.js";
import { SENSORS } from "../core/sensors.js";
import { PARAMETERS } from "../generated.js";
import { buttonOf, choiceOf, made } from "../core/dom.js";
import { Boxes } from "./boxes.js";
import { DotPlot } from "./dot_plot.js";
import { settingAt, ticksPerObstacle } from "./evidence.js";

/**
 * @typedef {import("./course.js").Lab} Lab
 * @typedef {import("../core/language.js").Texts["lessons"]} Texts
 *
 * A tool in the page; `show` brings it up to date.
 * @typedef {{element: HTMLElement, show: () => void}} Tool
 *
 * @typedef {keyof typeof PARAMETERS} Parameter
 */

const DISTRUST_DECISIONS = 32;

/** @typedef {keyof typeof MAKERS} ToolName */

/** @satisfies {Record<string, (lab: Lab, texts: Texts) => Tool>} */
const MAKERS = {
  patience: makePatience,
  sensors: makeSensors,
  distrust: (/** @type {Lab} */ lab, /** @type {Texts} */ { words }) => makeSwitch(lab, "distrust", DISTRUST_DECISIONS, words.distrust),
  share: (/** @type {Lab} */ lab, /** @type {Texts} */ { words }) => makeSwitch(lab, "share", 1, words.share),
  score: makeScore,
  talk: makeTalk,
  teach: makeTeaching,
  boxes: (/** @type {Lab} */ lab) => new Boxes(lab),
  samples: (/** @type {Lab} */ lab, /** @type {Texts} */ { words }) => new DotPlot(lab.course.samples, words),
  whatIf: () => makeButton(say("whatIf"), () => byId("what-if").click()),
  addPlant: () => makeButton(say("addPlant"), () => byId("add-plant").click()),
  erase: () => makeButton(say("erase"), () => byId("erase").click()),
  swap: (/** @type {Lab} */ lab, /** @type {Texts} */ { words }) => makeButton(words.swap, () => swapMotors(lab)),
};

/**
 * @param {ToolName} name
 * @param {Lab} lab
 * @param {Texts} texts
 * @returns {Tool}
 */
export function toolOf(name, lab, texts) {
  return MAKERS[name](lab, texts);
}

/**
 * @param {string} text
 * @param {() => void} onClick
 * @returns {Tool}
 */
function makeButton(text, onClick) {
  const button = buttonOf(text, onClick);
  button.className = "main";
  return { element: button, show: () => {} };
}

/**
 * Swaps the motors of the robots of all runs, before the tick that is shown next.
 * @param {Lab} lab
 */
function swapMotors(lab) {
  const tick = Math.min(lab.tick + 1, ...lab.lanes.map(({ last }) => last));
  for (const lane of lab.lanes) {
    lane.change({ do: "body", what: "swap-motors", robot: 0, seed: 0, tick });
    lab.simulate(lane);
  }
  lab.goAhead(tick);
}

/**
 * Sets a parameter of all robots of the selected run, from its start.
 * @param {Lab} lab
 * @param {Parameter} name
 * @param {number} value
 */
function setForAll(lab, name, value) {
  const { lane } = lab;
  const robots = lane.experiment.robots.map((setup) => ({ ...setup, settings: { ...setup.settings, [name]: value } }));
  lane.experiment = { ...lane.experiment, robots };
  lab.simulate(lane);
}

/**
 * @param {Lab} lab
 * @param {Parameter} name
 */
function current({ lane, tick }, name) {
  return settingAt(lane, { robot: lane.robot, name }, tick);
}

/**
 * @param {Lab} lab
 * @param {Parameter} name
 * @param {number} on - The value that switches it on.
 * @param {string} text
 * @returns {Tool}
 */
function makeSwitch(lab, name, on, text) {
  const input = made("input", [], { type: "checkbox" });
  input.addEventListener("change", () => setForAll(lab, name, input.checked ? on : 0));
  const show = () => {
    input.checked = current(lab, name) > 0;
  };
  return { element: made("label", [input, ` ${text}`], { class: "check" }), show };
}

/**
 * @param {Lab} lab
 * @param {Texts} texts
 * @returns {Tool}
 */
function makePatience(lab, { words }) {
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

/**
 * @param {Lab} lab
 * @param {Texts} texts
 * @returns {Tool}
 */
function makeSensors(lab, { words }) {
  /** @type {[string, string][]} */
  const states = [["sound", words.sound], ["stuck-on", words.stuckOn], ["stuck-off", words.stuckOff]];
  /** @type {ReturnType<typeof choiceOf>[]} */
  const choices = SENSORS.map((name) => choiceOf(heard(name), states, () => breakAsChosen()));
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

/**
 * @param {Lab} lab
 * @param {string[]} states - Of the sensors, from bit 0 of `feel` on.
 */
function breakSensors(lab, states) {
  const { robot } = lab.lane;
  const faults = states.flatMap((state, place) => (state === "sound" ? [] : [`${state}:${SENSORS[place]}`]));
  for (const what of ["repair", ...faults]) lab.change({ do: "body", what, robot, seed: 0 });
}

/**
 * What `breakSensors` last did to a sensor.
 * @param {Lab} lab
 * @param {string} sensor
 */
function stateOf({ lane, tick }, sensor) {
  const done = lane.experiment.changes.flatMap((change) =>
    change.do === "body" && (change.robot ?? 0) === lane.robot && change.tick <= tick ? [change.what] : []);
  const [what, which] = done.filter((it) => it === "repair" || it.endsWith(`:${sensor}`)).at(-1)?.split(":") ?? [];
  return what && which ? what : "sound";
}

/**
 * @param {Lab} lab
 * @param {Texts} texts
 * @returns {Tool}
 */
function makeScore(lab, { words }) {
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

/**
 * The box to talk in.
 * @param {Lab} lab
 * @returns {Tool}
 */
function makeTalk(lab) {
  const element = made("div", []);
  return { element, show: () => lab.talk.moveTo(element) };
}

/**
 * A form to teach a speaker a word.
 * @param {Lab} lab
 * @param {Texts} texts
 * @returns {Tool}
 */
function makeTeaching(lab, { words }) {
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

/**
 * A number as the language of the lessons writes it.
 * @param {number} number
 */
function thousandths(number) {
  return number.toLocaleString(languageCode(), { minimumFractionDigits: 3, maximumFractionDigits: 3 });
}
