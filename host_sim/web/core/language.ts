/* The texts of the page in the reader's language: the browser's, or the one chosen here before. */

import { byId, made, typedById } from "./dom.js";
import { ENGLISH, filled } from "./phrases.js";
import { keep, kept } from "./storage.js";
import type { Words } from "./phrases.js";

/**
 * The words of one language, as in texts/: those of the page, and its translations of English texts from the
 * firmware, the worker or the server.
 */
export type Texts = typeof import("../texts/en.json");

export type Key = keyof Texts["page"] | keyof Texts["wall"];

type Group = "kinds" | "reasons";

const FALLBACK = "en";
const CHANGED = "octet-language";

/** The languages of the page, by code. */
const ALL: Record<string, Texts> = JSON.parse(byId("texts").textContent ?? "");

/** The texts of all pages, and of the board on a wall. */
const SAID: Record<string, Record<string, string>> = Object.fromEntries(
  Object.entries(ALL).map(([code, { page, wall }]) => [code, { ...page, ...wall }]),
);

/** The codes and the names of all languages. */
export const LANGUAGES: [string, string][] = Object.entries(ALL).map(([code, { language }]) => [code, language]);

let spoken = [kept("language"), ...navigator.languages.map((tag) => tag.split("-")[0])].find((code) => code in ALL) ?? FALLBACK;
let robot = readRobot();

/** The code of the page's language. */
export function languageCode() {
  return spoken;
}

/** A part of the words of the page's language. */
export function wordsOf<P extends keyof Texts>(part: P): Texts[P] {
  return ALL[spoken][part];
}

/** A text of the page, with its placeholders filled in. */
export function say(key: Key, values: Record<string, string | number> = {}) {
  return filled(SAID[spoken][key] ?? SAID[FALLBACK][key] ?? key, values);
}

/** The name of something in the language of the page. */
export function nameIn(group: Group, name: string) {
  const names = (ALL[spoken][group] ?? ALL[FALLBACK][group]) as Record<string, string>;
  return names[name] ?? name;
}

/** The robot's own words. */
export function robotWords() {
  return robot;
}

function readRobot(): Words {
  const own = (ALL[spoken].robot ?? {}) as Partial<Words>;
  return { ...ENGLISH, ...own, sentences: { ...ENGLISH.sentences, ...own.sentences } };
}

/**
 * Translates an English name or sentence into the page's language; returns it unchanged if there is no translation.
 */
export function heard(text: string): string {
  const known = { ...ALL[spoken].heard, ...ALL[spoken].refused } as Record<string, string>;
  if (text in known) return known[text];
  for (const [english, own] of Object.entries(known)) {
    const gaps = english.includes("{") && new RegExp(`^${english.replace(/[.?*+()|[\]$^]/g, "\\$&").replace(/\{\d\}/g, "(.+?)")}$`).exec(text);
    if (gaps) return filled(own, gaps.slice(1).map(heard));
  }
  return text;
}

/** Chooses a language for this visit and the next. */
export function speak(code: string) {
  spoken = code;
  robot = readRobot();
  keep("language", code);
  sayAll();
  dispatchEvent(new Event(CHANGED));
}

/** Calls a function now and whenever another language is chosen. */
export function inEachLanguage(write: () => void) {
  addEventListener(CHANGED, write);
  write();
}

/** Writes the fixed texts of elements: `data-say` names an element's text, `data-say-title` its title. */
function sayAll() {
  document.documentElement.lang = spoken;
  const write = (name: string, into: (element: Element, text: string) => void) => {
    for (const element of document.querySelectorAll(`[${name}]`)) {
      const [key, value = ""] = (element.getAttribute(name) ?? "").split(":");
      into(element, say(key as Key, { key: value }));
    }
  };
  write("data-say", (element, text) => (element.textContent = text));
  write("data-say-label", (element, text) => element.setAttribute("aria-label", text));
  write("data-say-title", (element, text) => element.setAttribute("title", text));
  for (const field of document.querySelectorAll<HTMLInputElement>("input[pattern]")) explain(field);
  for (const option of document.querySelectorAll<HTMLOptionElement>("[data-kinds] option")) option.text = nameIn("kinds", option.value);
}

/** Lets a field for a whole number say so in the language of the page, not in that of the browser. */
function explain(field: HTMLInputElement) {
  field.oninput = () => {
    field.setCustomValidity("");
    if (field.validity.patternMismatch) field.setCustomValidity(say("wholeNumber"));
  };
}

/** Fills the element `language`. */
function offerLanguages() {
  const field = typedById("language", HTMLSelectElement);
  field.append(...LANGUAGES.map(([value, name]) => made("option", [name], { value, lang: value })));
  field.value = spoken;
  field.addEventListener("change", () => speak(field.value));
}

sayAll();
offerLanguages();
