// @ts-check
/* The colours of a canvas, read from the style sheet, so that one place defines light and dark. */

import { REASON } from "../generated.js";

const NAMES = /** @type {const} */ ([
  "floor", "grid", "ink", "paper", "bar", "food", "cone", "cone-dark", "beam", "select", "plant", "level",
]);

const ROBOT_COLOURS = 8;

/**
 * @typedef {Object} Palette
 * @property {Record<typeof NAMES[number], string>} of - Colour by name.
 * @property {string[]} reasons - Colour by reason.
 * @property {string[]} robots - Colours that tell robots apart.
 */

/** The style sheet's name of each reason, such as "toward-food". */
export const REASON_KEYS = Object.entries(REASON)
  .sort(([, a], [, b]) => a - b)
  .map(([name]) => name.toLowerCase().replaceAll("_", "-"));

/**
 * Reads the colours that an element has now.
 * @param {Element} element
 * @returns {Palette}
 */
export function paletteOf(element) {
  const style = getComputedStyle(element);
  const colour = (/** @type {string} */ name) => style.getPropertyValue(`--${name}`).trim();
  return {
    of: /** @type {Palette["of"]} */ (Object.fromEntries(NAMES.map((name) => [name, colour(name)]))),
    reasons: REASON_KEYS.map((key) => colour(`reason-${key}`)),
    robots: Array.from({ length: ROBOT_COLOURS }, (_, i) => colour(`robot-${i}`)),
  };
}
