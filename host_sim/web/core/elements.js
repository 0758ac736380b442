// @ts-check
/* Finding the elements of a page. */

/**
 * The element with an id.
 * @param {string} id
 * @returns {HTMLElement}
 */
export function byId(id) {
  return typedById(id, HTMLElement);
}

/**
 * The element with an id, which must be of a class.
 * @template {HTMLElement} T
 * @param {string} id
 * @param {new () => T} kind
 * @returns {T}
 */
export function typedById(id, kind) {
  const element = document.getElementById(id);
  if (!(element instanceof kind)) throw new Error(`this page has no ${kind.name} with the id ${id}`);
  return element;
}

/**
 * Writes a text, if that changes anything.
 * @param {HTMLElement} element
 * @param {string} text
 */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * The context to draw on a canvas.
 * @param {HTMLCanvasElement} canvas
 * @param {CanvasRenderingContext2DSettings} [settings]
 * @returns {CanvasRenderingContext2D}
 */
export function contextOf(canvas, settings) {
  const context = canvas.getContext("2d", settings);
  if (!context) throw new Error("this browser cannot draw on a canvas");
  return context;
}

/**
 * Whether a key event is meant for the page, not for a shortcut of the browser or for a field that takes text.
 * @param {KeyboardEvent} event
 * @param {string} fields - A selector of the elements that use such keys themselves.
 */
export function isForPage(event, fields) {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  return !(event.target instanceof Element && event.target.closest(fields));
}

/** Whether the page may move by itself. */
export function mayMove() {
  return !matchMedia("(prefers-reduced-motion: reduce)").matches;
}
