// @ts-check
/* What can be let happen to a body, and what it is called. docs/worlds.md has all that there is. */

import { SENSORS } from "../sim/body_faults.js";
import { bodySentence } from "../core/phrases.js";

/** As `tools/run --change` has them. */
export const FAULTS = [
  ...[...SENSORS.keys()].flatMap((sensor) => [`stuck-on:${sensor}`, `stuck-off:${sensor}`]),
  "mirror", "noise:10/1000", "noise:100/1000", "swap-motors", "weak-motor:left:60%", "weak-motor:right:60%",
  "swap-odometers", "odometer:left:0%", "odometer:right:0%", "false-beacon:100", "repair",
];

/** @param {string} what */
export function faultName(what) {
  return bodySentence(what).replace(/\.$/, "");
}
