// @ts-check
/* The faults of a body that a person can inject. */

import { byId, typedById } from "../core/elements.js";
import { heard, inEachLanguage } from "../core/language.js";
import { bodySentence } from "../core/phrases.js";
import { SENSORS } from "../core/sensors.js";

/** The changes of a body that the page offers, as for `tools/run --change`; docs/worlds.md explains each. */
const FAULTS = [
  ...SENSORS.flatMap((sensor) => [`stuck-on:${sensor}`, `stuck-off:${sensor}`]),
  "mirror", "noise:10/1000", "noise:100/1000", "swap-motors", "weak-motor:left:60%", "weak-motor:right:60%",
  "swap-odometers", "odometer:left:0%", "odometer:right:0%", "false-beacon:100", "lag:60ms", "slack:3deg",
  "slip:5%", "latency:1", "dark-wall", "weak-battery", "repair",
];

/** Fills the element `fault`; the button `break` injects what is chosen there. */
export class FaultMenu {
  /** @param {(what: string) => void} onBreak */
  constructor(onBreak) {
    const menu = typedById("fault", HTMLSelectElement);
    inEachLanguage(() => offer(menu, FAULTS.map((what) => [what, faultName(what)])));
    byId("break").addEventListener("click", () => onBreak(menu.value));
  }
}

/** @param {string} what */
function faultName(what) {
  return heard(bodySentence(what)).replace(/\.$/, "");
}

/**
 * Fills a field; what was chosen stays so.
 * @param {HTMLSelectElement} select
 * @param {[string, string][]} options - Their values and names.
 */
export function offer(select, options) {
  const chosen = select.value || options[0][0];
  select.replaceChildren(...options.map(([value, name]) => new Option(name, value, false, value === chosen)));
}
