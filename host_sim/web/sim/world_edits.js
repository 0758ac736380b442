// @ts-check
/* The obstacles, plants and the food of an arena, and what a person may change in them: as host_sim/world/edits.py has it. */

/**
 * @typedef {import("../types.js").Bar} Bar
 * @typedef {import("../types.js").Layout} Layout
 * @typedef {import("../types.js").Plant} Plant
 * @typedef {import("../types.js").Pose} Pose
 * @typedef {import("../types.js").SimParams} SimParams
 * @typedef {import("../types.js").WorldEdit} WorldEdit
 *
 * A straight thing with round ends: ax, ay, bx, by and its radius, mm.
 * @typedef {[number, number, number, number, number]} Capsule
 *
 * Where a robot is, and whether a person holds it.
 * @typedef {{x: number, y: number, lifted: boolean}} Standing
 */

/** A change that cannot be made. */
export class EditError extends Error {}

/** As in host_sim/world/edits.py. */
const BARS_MAX = 40;
const PLANTS_MAX = 20;
const PLANT_MM = /** @type {const} */ ([20, 500]);

/** What stands in an arena. Bars have ids: 0, 1, ... in the order in which they were added; so do plants. */
export class Furniture {
  /**
   * @param {Layout} layout
   * @param {SimParams} params
   */
  constructor({ bars, food }, params) {
    this.params = params;
    this.bars = new Map(bars.map((bar, id) => [id, bar]));
    this.nextId = bars.length;
    /** @type {Map<number, Plant>} */
    this.plants = new Map();
    this.nextPlantId = 0;
    this.food = food.map(([x, y]) => /** @type {[number, number]} */ ([x, y]));
  }

  /**
   * Makes a change of the obstacles, the plants or the food.
   * @param {WorldEdit} edit
   * @param {Standing[]} robots
   */
  edit(edit, robots) {
    if (edit.do === "add_bar") this.add(barOf(edit), robots);
    else if (edit.do === "move_bar") this.move(edit.id, barOf(edit), robots);
    else if (edit.do === "remove_bar") this.remove(edit.id);
    else if (edit.do === "move_food") this.moveFood(edit.id, edit.at);
    else this.editPlant(edit, robots);
  }

  /**
   * @param {WorldEdit} edit
   * @param {Standing[]} robots
   */
  editPlant(edit, robots) {
    if (edit.do === "plant") {
      if (this.plants.size >= PLANTS_MAX) throw new EditError(`there are ${PLANTS_MAX} plants already`);
      this.putPlant(this.nextPlantId, [...edit.at, edit.radius], robots);
      this.nextPlantId += 1;
    } else if (edit.do === "move_plant") this.putPlant(edit.id, [...edit.at, this.plant(edit.id)[2]], robots);
    else if (edit.do === "grow_plant") this.putPlant(edit.id, [...middleOf(this.plant(edit.id)), edit.radius], robots);
    else if (edit.do === "remove_plant") this.plants.delete(this.plant(edit.id) && edit.id);
  }

  /** @param {number} id */
  plant(id) {
    this.checkKnown(this.plants.has(id), id);
    return /** @type {Plant} */ (this.plants.get(id));
  }

  /**
   * @param {number} id
   * @param {Plant} plant
   * @param {Standing[]} robots
   */
  putPlant(id, plant, robots) {
    const [x, y, radius] = plant;
    const [low, high] = PLANT_MM;
    this.checkInside([x, y]);
    if (radius < low || radius > high) throw new EditError(`a plant has a radius of ${low} to ${high} mm, not ${radius}`);
    const room = radius + this.params.body_radius_mm;
    const isHit = robots.some((robot) => !robot.lifted && Math.hypot(x - robot.x, y - robot.y) < room);
    if (isHit) throw new EditError("the robot stands there");
    this.plants.set(id, plant);
  }

  /** All obstacles: both ends, and half their thickness. */
  get capsules() {
    const radius = this.params.bar_thickness_mm / 2;
    const bars = [...this.bars.values()].map((bar) => /** @type {Capsule} */ ([...bar, radius]));
    return [...bars, ...[...this.plants.values()].map(([x, y, r]) => /** @type {Capsule} */ ([x, y, x, y, r]))];
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
    const room = Math.min(clearance(x, y, [...this.bars.values()], params, [...this.plants.values()]), ...apart.map((mm) => mm - params.body_radius_mm));
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
 * @param {Plant} plant
 * @returns {[number, number]}
 */
function middleOf([x, y]) {
  return [x, y];
}

/**
 * @param {{a: [number, number], b: [number, number]}} edit
 * @returns {Bar}
 */
function barOf({ a, b }) {
  return [...a, ...b];
}

/**
 * Distance from a point to the nearest obstacle or wall, mm; negative inside one.
 * @param {number} x
 * @param {number} y
 * @param {Bar[]} bars
 * @param {SimParams} params
 * @param {Plant[]} [plants]
 */
function clearance(x, y, bars, params, plants = []) {
  const walls = Math.min(x, params.width_mm - x, y, params.height_mm - y);
  const room = bars.reduce((least, bar) => Math.min(least, toLine(x, y, bar) - params.bar_thickness_mm / 2), walls);
  return plants.reduce((least, [px, py, radius]) => Math.min(least, Math.hypot(x - px, y - py) - radius), room);
}

/**
 * @param {number} x
 * @param {number} y
 * @param {Bar} bar
 */
function toLine(x, y, [ax, ay, bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const along = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
  return Math.hypot(x - ax - along * dx, y - ay - along * dy);
}
