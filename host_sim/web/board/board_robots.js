// @ts-check
/* The board's cards: each robot with its name tag, its curve, and how much it knows. */

import { VIEW_BOX } from "./board_curves.js";
import { byId, setText } from "../core/elements.js";
import { PATTERNS } from "../generated.js";

/**
 * @typedef {import("./board_curves.js").BoardCurves} BoardCurves
 * @typedef {import("./board_curves.js").CurveName} CurveName
 *
 * A robot, from host_sim/live/board_feed.py.
 * @typedef {{node: number, name: string, page: boolean, sides: number[]}} BoardRobot
 *
 * @typedef {{item: HTMLElement, name: HTMLElement, value: HTMLElement, path: Element, knows: HTMLElement}} Card
 */

const SVG = "http://www.w3.org/2000/svg";
const ALL = PATTERNS.length - 1;

/** Fills the element robots. */
export class BoardRobots {
  constructor() {
    this.list = byId("robots");
    /** @type {Card[]} */
    this.cards = [];
  }

  /**
   * @param {BoardRobot[]} robots
   * @param {BoardCurves} curves
   * @param {{curve: CurveName, tickMs: number, own: boolean}} how - `own`: whether each page has a robot of its own.
   */
  show(robots, curves, { curve, tickMs, own }) {
    while (this.cards.length < robots.length) this.cards.push(this.addCard());
    const most = curve === "cells" ? ALL : curves.most(curve);
    robots.forEach((robot, i) => {
      const { item, name, value, path, knows } = this.cards[i];
      const known = robot.sides.filter(Boolean).length;
      setText(name, robot.name || `Robot ${robot.node}`);
      setText(value, textOf(curve === "cells" ? known : curves.last(i, curve), curve, tickMs));
      setText(knows, wordsOf(known, curves.last(i, "meals")));
      path.setAttribute("d", curves.path(i, curve, most));
      item.classList.toggle("empty", own && !robot.page);
      item.classList.toggle("whole", known === ALL);
    });
  }

  addCard() {
    const item = this.list.appendChild(document.createElement("li"));
    const head = item.appendChild(document.createElement("div"));
    head.className = "name";
    const [name, value] = [0, 1].map(() => head.appendChild(document.createElement("span")));
    const drawing = item.appendChild(document.createElementNS(SVG, "svg"));
    drawing.setAttribute("viewBox", VIEW_BOX);
    drawing.setAttribute("preserveAspectRatio", "none");
    drawing.setAttribute("aria-hidden", "true");
    const path = drawing.appendChild(document.createElementNS(SVG, "path"));
    const knows = item.appendChild(document.createElement("div"));
    knows.className = "knows";
    return { item, name, value, path, knows };
  }
}

/**
 * @param {number} value
 * @param {CurveName} curve
 * @param {number} tickMs
 */
function textOf(value, curve, tickMs) {
  return curve === "blocked" ? `${((value * tickMs) / 1000).toFixed(1)} s` : `${value}`;
}

/**
 * @param {number} known
 * @param {number} meals
 */
function wordsOf(known, meals) {
  const knows = known === ALL ? `✓ knows all ${ALL} patterns` : `knows ${known} of ${ALL}`;
  return `${knows}, ate ${meals}`;
}
