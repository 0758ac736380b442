// @ts-check
/* A slider for each parameter of the robot. */

import { byId } from "../core/elements.js";
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
    const names = /** @type {Parameter[]} */ (Object.keys(PARAMETERS));
    for (const name of names) this.sliders.set(name, this.makeSlider(byId("panel-parameters"), name));
  }

  /** @param {Record<string, number>} settings - All but the defaults. */
  show(settings) {
    for (const [name, { input, output, reset }] of this.sliders) {
      const value = settings[name] ?? PARAMETERS[name].default;
      if (document.activeElement !== input || input.value === output.dataset.value) input.value = `${value}`;
      output.dataset.value = `${value}`;
      output.textContent = `${input.value} ${PARAMETERS[name].unit}`;
      reset.disabled = value === PARAMETERS[name].default;
    }
  }

  /**
   * @param {HTMLElement} parent
   * @param {Parameter} name
   * @returns {Slider}
   */
  makeSlider(parent, name) {
    const { min, max, meaning } = PARAMETERS[name];
    const row = parent.appendChild(document.createElement("div"));
    row.className = "slider";
    const label = row.appendChild(document.createElement("label"));
    label.append(meaning.replace(/\.$/, ""), " ");
    const output = label.appendChild(document.createElement("output"));
    const input = label.appendChild(document.createElement("input"));
    Object.assign(input, { type: "range", min: `${min}`, max: `${max}`, step: "1", title: name });
    const reset = row.appendChild(document.createElement("button"));
    Object.assign(reset, { type: "button", textContent: "↺", title: `${PARAMETERS[name].default}` });
    reset.setAttribute("aria-label", `${meaning} Back to ${PARAMETERS[name].default}`);
    input.addEventListener("input", () => (output.textContent = `${input.value} ${PARAMETERS[name].unit}`));
    input.addEventListener("change", () => this.onChange(name, Number(input.value)));
    reset.addEventListener("click", () => this.onChange(name, PARAMETERS[name].default));
    return { input, output, reset };
  }
}
