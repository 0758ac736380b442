// @ts-check
/* A slider for each parameter of the robot. */

import { buttonOf, made } from "../core/dom.js";
import { byId } from "../core/elements.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { PARAMETERS } from "../generated.js";

/**
 * @typedef {keyof typeof PARAMETERS} Parameter
 *
 * @typedef {{input: HTMLInputElement, output: HTMLElement, reset: HTMLButtonElement}} Slider
 */

/** Fills the element panel-parameters. */
export class ParameterSliders {
  /** @param {(parameter: string, value: number) => void} onChange */
  constructor(onChange) {
    this.onChange = onChange;
    /** @type {Map<Parameter, Slider>} */
    this.sliders = new Map();
    inEachLanguage(() => this.fill(byId("panel-parameters")));
  }

  /** @param {HTMLElement} panel */
  fill(panel) {
    panel.replaceChildren();
    for (const name of /** @type {Parameter[]} */ (Object.keys(PARAMETERS))) this.sliders.set(name, this.makeSlider(panel, name));
  }

  /** @param {Record<string, number>} settings - All but the defaults. */
  show(settings) {
    for (const [name, { input, output, reset }] of this.sliders) {
      const value = settings[name] ?? PARAMETERS[name].default;
      if (document.activeElement !== input || input.value === output.dataset.value) input.value = `${value}`;
      output.dataset.value = `${value}`;
      output.textContent = `${input.value} ${heard(PARAMETERS[name].unit)}`;
      reset.disabled = value === PARAMETERS[name].default;
    }
  }

  /**
   * @param {HTMLElement} parent
   * @param {Parameter} name
   * @returns {Slider}
   */
  makeSlider(parent, name) {
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
