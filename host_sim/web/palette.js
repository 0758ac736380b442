/* The colours of a canvas: those of the style sheet, so that light and dark are decided in one place. */

const NAMES = ["floor", "grid", "ink", "paper", "bar", "food", "cone", "cone-dark", "beam", "select"];
const REASONS = 8;

/**
 * @typedef {Object} Palette
 * @property {Object<string, string>} of - Colour by name.
 * @property {string[]} reasons - Colour by reason.
 */

/**
 * Reads the colours that hold for an element now.
 * @param {Element} element
 * @returns {Palette}
 */
export function paletteOf(element) {
  const style = getComputedStyle(element);
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    of: Object.fromEntries(NAMES.map((name) => [name, colour(name)])),
    reasons: Array.from({ length: REASONS }, (_, reason) => colour(`reason-${reason}`)),
  };
}
