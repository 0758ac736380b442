/* Where the robot's five proximity sensors look. */

import { CELL_COUNT, FEEL } from "../generated.js";

/** The names of the sensors in changes of a body, from bit 0 of `feel` on. */
export const SENSORS = Object.keys(FEEL).map((name) => name.toLowerCase().replace("_", "-"));

/** The bit of each sensor in `feel`, and the bearing of its cone's middle in degrees to the right of the heading. */
export const CONES = [
  { bit: FEEL.RIGHT, bearing: 90 },
  { bit: FEEL.FRONT_RIGHT, bearing: 45 },
  { bit: FEEL.FRONT, bearing: 0 },
  { bit: FEEL.FRONT_LEFT, bearing: -45 },
  { bit: FEEL.LEFT, bearing: -90 },
];

/** The bit of a sensor in a pattern, by its bit in `feel`; 0 for a sensor that is not part of patterns. */
export function patternBit(bit: number) {
  return (bit >> 1) & (CELL_COUNT - 1);
}
