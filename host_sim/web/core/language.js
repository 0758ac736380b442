// @ts-check
/* The texts of the page in the reader's language: the browser's, or the one chosen here before. */

import { made } from "./dom.js";
import { byId } from "./elements.js";
import { ENGLISH, filled } from "./phrases.js";
import { keep, kept } from "./storage.js";

/**
 * The words of one language, as in texts/: those of the page, and those in which it says what it hears in English from
 * the firmware, the worker or the server.
 * @typedef {typeof import("../texts/en.json")} Texts
 * @typedef {keyof Texts["page"] | keyof Texts["wall"]} Key
 * @typedef {"kinds" | "reasons" | "columns"} Group
 */

const FALLBACK = "en";
const CHANGED = "octet-language";

/** @type {Record<string, Texts>} - The languages of the page, by code. */
const ALL = JSON.parse(byId("texts").textContent ?? "");

/** @type {[string, string][]} - The codes and the names of all languages. */
export const LANGUAGES = Object.entries(ALL).map(([code, { language }]) => [code, language]);

let spoken = [kept("language"), ...navigator.languages.map((tag) => tag.split("-")[0])].find((code) => code in ALL) ?? FALLBACK;
let robot = readRobot();

/** The code of the page's language. */
export function languageCode() {
  return spoken;
}

/**
 * A part of the words of the page's language.
 * @template {keyof Texts} P
 * @param {P} part
 * @returns {Texts[P]}
 */
export function wordsOf(part) {
  return ALL[spoken][part];
}

/**
 * A text of the page, with its placeholders filled in.
 * @param {Key} key
 * @param {Record<string, string | number>} [values]
 */
export function say(key, values = {}) {
  return filled(textIn(spoken, key) ?? textIn(FALLBACK, key) ?? key, values);
}

/**
 * A text of all pages, or of the board on a wall.
 * @param {string} code - Of the language.
 * @param {Key} key
 */
function textIn(code, key) {
  const { page, wall } = ALL[code];
  return /** @type {Record<string, string>} */ ({ ...page, ...wall })[key];
}

/**
 * What something is called.
 * @param {Group} group
 * @param {string} name
 */
export function nameIn(group, name) {
  const names = /** @type {Record<string, string>} */ (ALL[spoken][group] ?? ALL[FALLBACK][group]);
  return names[name] ?? name;
}

/** The robot's own words. */
export function robotWords() {
  return robot;
}

/** @returns {import("./phrases.js").Words} */
function readRobot() {
  const own = /** @type {Partial<import("./phrases.js").Words>} */ (ALL[spoken].robot ?? {});
  return { ...ENGLISH, ...own, sentences: { ...ENGLISH.sentences, ...own.sentences } };
}

/**
 * Translates an English name or sentence into the page's language; returns it unchanged if there is no translation.
 * @param {string} text
 * @returns {string}
 */
export function heard(text) {
  const known = /** @type {Record<string, string>} */ ({ ...ALL[spoken].heard, ...ALL[spoken].refused });
  if (text in known) return known[text];
  for (const [english, own] of Object.entries(known)) {
    const gaps = english.includes("{") && new RegExp(`^${english.replace(/[.?*+()|[\]$^]/g, "\\$&").replace(/\{\d\}/g, "(.+?)")}$`).exec(text);
    if (gaps) return filled(own, gaps.slice(1).map(heard));
  }
  return text;
}

/**
 * Chooses a language for this visit and the next.
 * @param {string} code
 */
export function speak(code) {
  spoken = code;
  robot = readRobot();
  keep("language", code);
  sayAll();
  dispatchEvent(new Event(CHANGED));
}

/**
 * Calls a function now and whenever another language is chosen.
 * @param {() => void} write
 */
export function inEachLanguage(write) {
  addEventListener(CHANGED, write);
  write();
}

/** Writes the fixed texts of elements: `data-say` names an element's text, `data-say-title` its title. */
function sayAll() {
  document.documentElement.lang = spoken;
  const write = (/** @type {string} */ name, /** @type {(element: Element, text: string) => void} */ into) => {
    for (const element of document.querySelectorAll(`[${name}]`)) {
      const [key, value = ""] = (element.getAttribute(name) ?? "").split(":");
      into(element, say(/** @type {Key} */ (key), { key: value }));
    }
  };
  write("data-say", (element, text) => (element.textContent = text));
  write("data-say-label", (element, text) => element.setAttribute("aria-label", text));
  write("data-say-title", (element, text) => element.setAttribute("title", text));
  for (const field of document.querySelectorAll("input[pattern]")) explain(field);
  for (const option of document.querySelectorAll("[data-kinds] option")) option.textContent = nameIn("kinds", option.getAttribute("value") ?? "");
}

/**
 * A field for a whole number says so, in the language of the page and not of the browser.
 * @param {Element} field
 */
function explain(field) {
  if (!(field instanceof HTMLInputElement)) return;
  field.oninput = () => {
    field.setCustomValidity("");
    if (field.validity.patternMismatch) field.setCustomValidity(say("wholeNumber"));
  };
}

/** Fills the element `language`, if the page has one. */
function offerLanguages() {
  const field = document.getElementById("language");
  if (!(field instanceof HTMLSelectElement)) return;
  field.append(...LANGUAGES.map(([value, name]) => made("option", [name], { value, lang: value })));
  field.value = spoken;
  field.addEventListener("change", () => speak(field.value));
}

sayAll();
offerLanguages();
