// @ts-check
/* What a page shows: the world, its robots, and what a person has selected or holds. */

import { heard, robotWords } from "../core/language.js";
import { clock } from "../core/phrases.js";
import { trailsFor } from "./trail.js";

/**
 * What a person can select or drag. id: a robot's node, a food's index, a bar's or plant's id. part: "a" or "b" for one end of a
 * bar, else "whole".
 * @typedef {{kind: "robot" | "food" | "bar" | "plant", id: number, part: "a" | "b" | "whole"}} Item
 */

/**
 * Cells; and, in the environment that begins with a tick, pieces of food by their index, and places in mm.
 * @typedef {{cells: number[], first_tick: number, food: number[], places: WirePlace[]}} Meant
 */

/**
 * @typedef {{name: string, colour: string}} Tag
 */

/** @typedef {{x: number, y: number, heading: number}} Ghost - Where a person holds a robot: mm and mrad. */

/**
 * `states` and `trails` have one entry per robot, in the same order; `node` is the robot that the panel shows,
 * `item` what is selected in the arena, `ghosts` has the robots that are held, by node, `shown` the states that words
 * and colours tell of, by node.
 */
export class Scene {
  /**
   * @param {Measures} measures
   * @param {EnvironmentScene} environment
   * @param {State[]} states - Of at least one robot.
   */
  constructor(measures, environment, states) {
    this.measures = measures;
    this.environment = environment;
    this.states = states;
    this.trails = trailsFor(states.length);
    this.node = states[0].node;
    /** @type {News[]} */
    this.news = [];
    /** @type {Item | undefined} */
    this.item = undefined;
    /** @type {Meant | undefined} - What an answer speaks of, and is lit up. */
    this.meant = undefined;
    /** @type {Tag[]} - What each robot wears in place of its number, in the order of the states; or empty. */
    this.tags = [];
    /** @type {Map<number, Ghost>} */
    this.ghosts = new Map();
    /** @type {Map<number, State>} */
    this.shown = new Map();
  }

  /** The state of the robot that the panel shows. */
  get state() {
    return this.states[this.index];
  }

  /** The trail of the robot that the panel shows. */
  get trail() {
    return this.trails[this.index];
  }

  /** Where the robot that the panel shows is in `states` and `trails`. */
  get index() {
    return Math.max(0, this.states.findIndex(({ node }) => node === this.node));
  }

  /**
   * Where a robot is drawn: where a person holds it, or where it is.
   * @param {State} state
   * @returns {Ghost}
   */
  poseOf(state) {
    return this.ghosts.get(state.node) ?? state;
  }

  /**
   * The reason whose colour a robot has: what it does, or did a moment ago.
   * @param {State} state
   */
  reasonOf({ node, reason }) {
    return this.shown.get(node)?.reason ?? reason;
  }

  /** What last changed in this environment, with its time; empty if nothing did. */
  get lastNews() {
    const { environment, news, state } = this;
    const known = news.filter(([tick]) => tick >= environment.first_tick && tick <= state.tick);
    return known.slice(-1).map(([tick, sentence]) => `${this.clock(tick)} ${heard(sentence)}`).join("");
  }

  /**
   * Robot time since the run was started over.
   * @param {number} tick
   */
  clock(tick) {
    return clock(tick - this.environment.start_tick, this.measures, robotWords().point);
  }

  /** @param {State} state - Of a robot that may be off the floor. */
  isHeld(state) {
    return Boolean(state.lifted) || this.ghosts.has(state.node);
  }
}
