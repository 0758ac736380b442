// @ts-check
/* Keyboard control of the arena, so that everything works without a pointer. */

import { isForPage } from "../core/elements.js";

const NUDGE_MM = 50;
const SMALL_NUDGE_MM = 10;
const TURN = Math.PI / 12;
const ARROWS = new Map([
  ["arrowleft", { x: -1, y: 0 }], ["arrowright", { x: 1, y: 0 }],
  ["arrowup", { x: 0, y: -1 }], ["arrowdown", { x: 0, y: 1 }],
]);

/**
 * Lets the keys that a canvas gets act on what is selected.
 * @param {HTMLCanvasElement} canvas
 * @param {ArenaEditor} editor
 */
export function bindArenaKeys(canvas, editor) {
  canvas.addEventListener("keydown", (event) => {
    if (!isForPage(event, "select")) return;
    const action = arrowAction(event, editor) ?? actionOf(event, editor);
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/**
 * @param {KeyboardEvent} event
 * @param {ArenaEditor} editor
 * @returns {(() => void) | undefined}
 */
function arrowAction({ key, shiftKey }, editor) {
  const arrow = ARROWS.get(key.toLowerCase());
  const step = shiftKey ? SMALL_NUDGE_MM : NUDGE_MM;
  return arrow && (() => editor.nudge({ x: arrow.x * step, y: arrow.y * step }));
}

/**
 * @param {KeyboardEvent} event
 * @param {ArenaEditor} editor
 * @returns {(() => void) | undefined}
 */
function actionOf({ key, shiftKey }, editor) {
  /** @type {Record<string, () => void>} */
  const actions = {
    q: () => editor.selectNext(-1),
    e: () => editor.selectNext(1),
    r: () => editor.turn(shiftKey ? -TURN : TURN),
    p: () => editor.liftOrPut(),
    a: () => editor.addBar(),
    delete: () => editor.removeBar(),
    backspace: () => editor.removeBar(),
    escape: () => editor.select(undefined),
  };
  return actions[key.toLowerCase()];
}
