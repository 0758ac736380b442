/* A slider for each parameter of the robot. */

import { buttonOf, byId, made } from "../core/dom.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { PARAMETERS } from "../generated.js";

type Parameter = keyof typeof PARAMETERS;

type Slider = { input: HTMLInputElement; output: HTMLElement; reset: HTMLButtonElement };

/** Fills the element panel-parameters. */
export class ParameterSliders {
  sliders: Map<Parameter, Slider> = new Map();

  constructor(readonly onChange: (parameter: string, value: number) => void) {
    inEachLanguage(() => this.fill(byId("panel-parameters")));
  }

  fill(panel: HTMLElement) {
    panel.replaceChildren();
    for (const name of Object.keys(PARAMETERS) as Parameter[]) this.sliders.set(name, this.makeSlider(panel, name));
  }

  /** @param settings - All but the defaults. */
  show(settings: Record<string, number>) {
    for (const [name, { input, output, reset }] of this.sliders) {
      const value = settings[name] ?? PARAMETERS[name].default;
      if (document.activeElement !== input || input.value === output.dataset.value) input.value = `${value}`;
      output.dataset.value = `${value}`;
      output.textContent = `${input.value} ${heard(PARAMETERS[name].unit)}`;
      reset.disabled = value === PARAMETERS[name].default;
    }
  }

  makeSlider(parent: HTMLElement, name: Parameter): Slider {
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
