/* What a page shows: the world, its robots, and what a person has selected or holds. */

import { heard, robotWords } from "../core/language.js";
import { minutes } from "../core/phrases.js";
import { trailsFor } from "./trail.js";
import type { EnvironmentScene, Measures, State } from "../generated_types.js";
import type { News, WirePlace } from "../types.js";

/**
 * What a person can select or drag. id: a robot's node, a food's index, a bar's or plant's id. part: "a" or "b" for one end of a
 * bar, else "whole".
 */
export type Item = { kind: "robot" | "food" | "bar" | "plant"; id: number; part: "a" | "b" | "whole" };

/** What an answer is about: cells; in the environment that begins at `first_tick`, food by index and places in mm. */
export type Meant = { cells: number[]; first_tick: number; food: number[]; places: WirePlace[] };

/** Where a person holds a robot: mm and mrad. */
export type Ghost = { x: number; y: number; heading: number };

/**
 * `states` and `trails` have one entry per robot, in the same order; `node` is the robot that the panel shows,
 * `item` what is selected in the arena, `ghosts` has the robots that are held, by node, `shown` the states that words
 * and colours tell of, by node.
 */
export class Scene {
  trails = trailsFor(this.states.length);
  node = this.states[0].node;
  news: News[] = [];
  item: Item | undefined;
  /** What an answer is about; it is highlighted. */
  meant: Meant | undefined;
  ghosts: Map<number, Ghost> = new Map();
  shown: Map<number, State> = new Map();

  /** @param states - Of at least one robot. */
  constructor(public measures: Measures, public environment: EnvironmentScene, public states: State[]) {}

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

  /** Where a robot is drawn: where a person holds it, or where it is. */
  poseOf(state: State): Ghost {
    return this.ghosts.get(state.node) ?? state;
  }

  /** The reason whose colour a robot has: what it does, or did a moment ago. */
  reasonOf({ node, reason }: State) {
    return this.shown.get(node)?.reason ?? reason;
  }

  /** What last changed in this environment, with its time; empty if nothing did. */
  get lastNews() {
    const { environment, news, state } = this;
    const known = news.filter(([tick]) => tick >= environment.first_tick && tick <= state.tick);
    return known.slice(-1).map(([tick, sentence]) => `${this.clock(tick)} ${heard(sentence)}`).join("");
  }

  /** Robot time since the run was started over. */
  clock(tick: number) {
    const passed = Math.max(0, tick - this.environment.start_tick);
    return minutes((passed * this.measures.tick_ms) / 1000, robotWords().point);
  }

  /** @param state - Of a robot that may be off the floor. */
  isHeld(state: State) {
    return Boolean(state.lifted) || this.ghosts.has(state.node);
  }
}
