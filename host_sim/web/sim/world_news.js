// @ts-check
/* What changed in the world and the bodies during a run, in plain sentences. */

import { bodySentence } from "../core/phrases.js";
import { SENTENCES } from "../generated.js";

/** @typedef {WorldEdit & {tick: number}} Edited */

/** @type {Record<string, string>} */
const SAID = SENTENCES;
const SHOWN = ["plant", "move_plant", "grow_plant", "remove_plant", "body"];

/**
 * All that changed, in order; what a person moved by hand is not among it.
 * @param {Edited[]} edits - That were made.
 * @param {number} robots
 * @returns {News[]}
 */
export function newsOf(edits, robots) {
  const shown = edits.filter((edit) => SHOWN.includes(edit.do));
  const news = shown.map((edit) => /** @type {News} */ ([edit.tick, sentenceOf(edit, shown, robots)]));
  return news.filter(([tick, sentence], i) => tick !== news[i - 1]?.[0] || sentence !== news[i - 1][1]);
}

/**
 * @param {Edited} edit
 * @param {Edited[]} edits
 * @param {number} robots
 */
function sentenceOf(edit, edits, robots) {
  if (edit.do !== "body") return SAID[edit.do];
  const { tick, what, robot = 0 } = edit;
  const alike = edits.filter((it) => it.do === "body" && it.tick === tick && it.what === what).length;
  return `${alike === robots ? "" : `Robot ${robot + 1}: `}${bodySentence(what)}`;
}
