/* Finding and making the elements of a page. */

import type { Place } from "../types.js";

/** The element with an id. */
export function byId(id: string): HTMLElement {
  return typedById(id, HTMLElement);
}

/** The element with an id, which must be an instance of a class. */
export function typedById<T extends HTMLElement>(id: string, kind: new () => T): T {
  const element = document.getElementById(id);
  if (!(element instanceof kind)) throw new Error(`this page has no ${kind.name} with the id ${id}`);
  return element;
}

/** Writes a text, if that changes anything. */
export function setText(element: HTMLElement, text: string) {
  if (element.textContent !== text) element.textContent = text;
}

/** The context to draw on a canvas. */
export function contextOf(canvas: HTMLCanvasElement, settings?: CanvasRenderingContext2DSettings) {
  const context = canvas.getContext("2d", settings);
  if (!context) throw new Error("this browser cannot draw on a canvas");
  return context;
}

/** The same for a canvas of the style sheet's size, with the pixels of the screen and the page's own as its unit. */
export function sizedContext(canvas: HTMLCanvasElement) {
  canvas.width = Math.round(canvas.clientWidth * devicePixelRatio);
  canvas.height = Math.round(canvas.clientHeight * devicePixelRatio);
  const context = contextOf(canvas);
  context.scale(devicePixelRatio, devicePixelRatio);
  return context;
}

/**
 * Whether a key event is meant for the page, not for a shortcut of the browser or for a field that takes text.
 * @param fields - A selector of the elements that use such keys themselves.
 */
export function isForPage(event: KeyboardEvent, fields: string) {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  return !(event.target instanceof Element && event.target.closest(fields));
}

/** The direction of each arrow key: steps to the right and down. */
export const ARROWS: Record<string, Place | undefined> = {
  ArrowLeft: { x: -1, y: 0 }, ArrowRight: { x: 1, y: 0 }, ArrowUp: { x: 0, y: -1 }, ArrowDown: { x: 0, y: 1 },
};

/** Whether the page may move by itself. */
export function mayMove() {
  return !matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** An element with a text or children. */
export function made<K extends keyof HTMLElementTagNameMap>(
  kind: K,
  children: (string | Node)[],
  attributes: Record<string, string> = {},
): HTMLElementTagNameMap[K] {
  const element = document.createElement(kind);
  element.append(...children);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

export function buttonOf(text: string, onClick: () => void) {
  const button = made("button", [text], { type: "button" });
  button.addEventListener("click", onClick);
  return button;
}

/**
 * A field to choose from.
 * @param options - Their values and texts.
 */
export function choiceOf(label: string, options: [string, string][], onChange: (value: string) => void) {
  const select = made("select", options.map(([value, text]) => made("option", [text], { value })));
  select.addEventListener("change", () => onChange(select.value));
  return { label: made("label", [`${label} `, select]), select };
}

/** @param entries - Terms and what they mean; they become the rows of a `dl`. */
export function termsOf(entries: string[][]) {
  return entries.map(([term, meaning]) => made("div", [made("dt", [term]), made("dd", [meaning])]));
}
