// @ts-check
/* The language of the lessons: the browser's, or the one that was chosen here before. */

import { byId } from "../core/elements.js";

/**
 * The words of one language, as in texts/.
 * @typedef {typeof import("./texts/en.json")} Texts
 */

const KEPT_AS = "octet-language";
const FALLBACK = "en";

/**
 * The languages that are in the page, by their codes.
 * @type {Record<string, Texts>}
 */
const ALL = JSON.parse(byId("lesson-texts").textContent ?? "");

/** The codes and the names of all languages. */
export const LANGUAGES = Object.entries(ALL).map(([code, { language }]) => ({ code, language }));

/**
 * The words of a language.
 * @param {string} code
 */
export function textsIn(code) {
  return ALL[code];
}

/** The code of the language to begin with. */
export function firstLanguage() {
  const wanted = [kept(), ...navigator.languages.map((tag) => tag.split("-")[0])];
  return wanted.find((code) => code in ALL) ?? FALLBACK;
}

function kept() {
  try {
    return localStorage.getItem(KEPT_AS) ?? "";
  } catch {
    return ""; // a browser may forbid it to files
  }
}

/**
 * Chooses a language for this visit and the next.
 * @param {string} code
 */
export function keepLanguage(code) {
  try {
    localStorage.setItem(KEPT_AS, code);
  } catch {
    // then for this visit only
  }
}

/**
 * A text with its gaps, such as {run}, filled.
 * @param {string} text
 * @param {Record<string, string>} values
 */
export function filled(text, values) {
  return text.replace(/\{(\w+)\}/g, (gap, name) => values[name] ?? gap);
}
