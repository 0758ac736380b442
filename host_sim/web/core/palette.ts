/* The colours of a canvas, read from the style sheet, so that one place defines light and dark. */

import { REASON } from "../generated.js";

const NAMES = [
  "floor", "grid", "ink", "paper", "bar", "food", "cone", "cone-dark", "beam", "select", "plant", "level",
] as const;

const ROBOT_COLOURS = 8;

export interface Palette {
  /** Colour by name. */
  of: Record<typeof NAMES[number], string>;
  /** Colour by reason. */
  reasons: string[];
  /** Colours that tell robots apart. */
  robots: string[];
}

/** The style sheet's name of each reason, such as "toward-food". */
export const REASON_KEYS = Object.entries(REASON)
  .sort(([, a], [, b]) => a - b)
  .map(([name]) => name.toLowerCase().replaceAll("_", "-"));

const known: Map<boolean, Palette> = new Map();

/** The colours that the page has now. */
export function currentPalette(): Palette {
  const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  const palette = known.get(isDark) ?? readPalette();
  known.set(isDark, palette);
  return palette;
}

function readPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    of: Object.fromEntries(NAMES.map((name) => [name, colour(name)])) as Palette["of"],
    reasons: REASON_KEYS.map((key) => colour(`reason-${key}`)),
    robots: Array.from({ length: ROBOT_COLOURS }, (_, i) => colour(`robot-${i}`)),
  };
}
