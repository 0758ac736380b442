// @ts-check
/* The obstacles and the food of an arena, and what a person may change in them: as host_sim/world/edits.py has it. */

import { clearance } from "./layouts.js";

/**
 * @typedef {import("./layouts.js").Bar} Bar
 * @typedef {import("./layouts.js").Layout} Layout
 * @typedef {import("./layouts.js").Pose} Pose
 * @typedef {import("./layouts.js").SimParams} SimParams
 * @typedef {import("./types.js").WorldEdit} WorldEdit
 *
 * Where a robot is, and whether a person holds it.
 * @typedef {{x: number, y: number, lifted: boolean}} Standing
 */

/** A change that cannot be made. */
export class EditError extends Error {}

/** As in host_sim/world/edits.py. */
const BARS_MAX = 40;

/** What stands in an arena. Obstacles have ids: 0, 1, ... in the order in which they were added. */
export class Furniture {
  /**
   * @param {Layout} layout
   * @param {SimParams} params
   */
  constructor({ bars, food }, params) {
    this.params = params;
    this.bars = new Map(bars.map((bar, id) => [id, bar]));
    this.nextId = bars.length;
    this.food = food.map(([x, y]) => /** @type {[number, number]} */ ([x, y]));
  }

  /**
   * Makes a change of the obstacles or the food.
   * @param {WorldEdit} edit
   * @param {Standing[]} robots
   */
  edit(edit, robots) {
    if (edit.do === "add_bar") this.add(barOf(edit), robots);
    else if (edit.do === "move_bar") this.move(edit.id, barOf(edit), robots);
    else if (edit.do === "remove_bar") this.remove(edit.id);
    else if (edit.do === "move_food") this.moveFood(edit.id, edit.at);
  }

  /**
   * @param {Bar} bar
   * @param {Standing[]} robots
   */
  add(bar, robots) {
    if (this.bars.size >= BARS_MAX) throw new EditError(`there are ${BARS_MAX} obstacles already`);
    this.check(bar, robots);
    this.bars.set(this.nextId, bar);
    this.nextId += 1;
  }

  /**
   * @param {number} id
   * @param {Bar} bar
   * @param {Standing[]} robots
   */
  move(id, bar, robots) {
    this.checkKnown(this.bars.has(id), id);
    this.check(bar, robots);
    this.bars.set(id, bar);
  }

  /** @param {number} id */
  remove(id) {
    this.checkKnown(this.bars.has(id), id);
    this.bars.delete(id);
  }

  /**
   * @param {number} id
   * @param {[number, number]} at
   */
  moveFood(id, at) {
    this.checkKnown(id in this.food, id);
    this.checkInside(at);
    this.food[id] = at;
  }

  /**
   * Whether a robot has room at a place.
   * @param {[number, number]} at
   * @param {Standing[]} others
   */
  hasRoom([x, y], others) {
    const { params } = this;
    const apart = others.filter(({ lifted }) => !lifted).map((other) => Math.hypot(x - other.x, y - other.y));
    const room = Math.min(clearance(x, y, [...this.bars.values()], params), ...apart.map((mm) => mm - params.body_radius_mm));
    return room >= params.body_radius_mm;
  }

  /**
   * @param {Bar} bar
   * @param {Standing[]} robots
   */
  check(bar, robots) {
    const [ax, ay, bx, by] = bar;
    this.checkInside([ax, ay]);
    this.checkInside([bx, by]);
    if (Math.hypot(bx - ax, by - ay) < this.params.bar_thickness_mm) throw new EditError("the obstacle is too short");
    const isHit = robots.some(({ x, y, lifted }) => !lifted && clearance(x, y, [bar], this.params) < this.params.body_radius_mm);
    if (isHit) throw new EditError("the robot stands there");
  }

  /** @param {[number, number]} at */
  checkInside([x, y]) {
    const { width_mm, height_mm } = this.params;
    if (!(x >= 0 && x <= width_mm && y >= 0 && y <= height_mm)) throw new EditError("that is outside of the arena");
  }

  /**
   * @param {boolean} known
   * @param {number} id
   */
  checkKnown(known, id) {
    if (!known) throw new EditError(`there is no number ${id}`);
  }
}

/**
 * @param {{a: [number, number], b: [number, number]}} edit
 * @returns {Bar}
 */
function barOf({ a, b }) {
  return [...a, ...b];
}
