// @ts-check
/* The arena of a run: what stands in it, where the robots' bodies are, and what is wrong with them. */

import { EditError, Furniture } from "./world_edits.js";

/**
 * @typedef {import("../types.js").Layout} Layout
 * @typedef {import("../types.js").Pose} Pose
 * @typedef {import("../types.js").SimParams} SimParams
 * @typedef {import("../types.js").WorldEdit} WorldEdit
 */

/** The order of the dimensions in native/page.h. */
const DIMENSIONS = /** @type {const} */ ([
  "width_mm", "height_mm", "body_radius_mm", "wheel_track_mm", "sensor_reach_mm", "front_extra_mm", "beam_width_mm",
  "eat_reach_mm", "tick_s", "max_wheel_speed_mm_s",
]);

/** Keeps the C code's arena as it is changed here. */
export class Arena {
  /**
   * @param {import("./native_run.js").NativeRun} native
   * @param {SimParams} params
   * @param {number} robots - Number of robots.
   */
  constructor(native, params, robots) {
    this.native = native;
    this.params = params;
    this.furniture = new Furniture({ bars: [], food: [], starts: [] }, params);
    this.bodies = Array.from({ length: robots }, () => ({ x: 0, y: 0, heading: 0, lifted: false }));
    native.build(DIMENSIONS.map((name) => params[name]));
  }

  /** For each piece of food, 1 if it was eaten. */
  get eaten() {
    return this.furniture.food.map((_, i) => this.native.c.page_is_eaten(i));
  }

  /** What stands in it, for a drawing: to a tenth of a mm. */
  get drawn() {
    const tenths = (/** @type {number[]} */ places) => places.map((mm) => Math.round(mm * 10) / 10);
    const bars = [...this.furniture.bars].map(([id, bar]) => [id, ...tenths(bar)]);
    const plants = [...this.furniture.plants].map(([id, plant]) => [id, ...tenths(plant)]);
    return { bars, food: this.furniture.food.map(tenths), plants };
  }

  /**
   * Furnishes it for an environment, and puts the robots at its starts.
   * @param {Layout} layout
   */
  furnish(layout) {
    this.furniture = new Furniture(layout, this.params);
    layout.starts.forEach((start, robot) => this.putDown(robot, start));
    this.placeFurniture();
    this.native.c.page_enter(layout.bars.length, layout.food.length);
  }

  /**
   * Makes a change of it, or of a body.
   * @param {WorldEdit} edit
   */
  edit(edit) {
    if ("robot" in edit && !this.bodies[edit.robot ?? 0]) throw new EditError(`there is no such robot; there are ${this.bodies.length}`);
    if (edit.do === "lift") this.lift(edit.robot ?? 0);
    else if (edit.do === "put") this.put(edit.robot ?? 0, edit);
    else if (edit.do === "body") this.breakBody(edit.robot ?? 0, edit);
    else this.furniture.edit(edit, this.bodies);
    this.placeFurniture();
    this.native.c.page_settle(this.furniture.capsules.length);
  }

  placeFurniture() {
    const { c } = this.native;
    this.furniture.capsules.forEach((capsule, i) => c.page_put_obstacle(i, ...capsule));
    this.furniture.food.forEach((at, i) => c.page_put_food(i, ...at));
  }

  /**
   * @param {number} robot
   * @param {Pose} pose
   */
  putDown(robot, [x, y, heading]) {
    this.native.c.page_put_body(robot, x, y, heading);
    this.bodies[robot] = { x, y, heading, lifted: false };
  }

  /**
   * A robot has moved.
   * @param {number} robot
   * @param {Iterable<number>} pose
   */
  moved(robot, pose) {
    const [x, y, heading] = pose;
    Object.assign(this.bodies[robot], { x, y, heading });
  }

  /** @param {number} robot */
  lift(robot) {
    if (this.bodies[robot].lifted) throw new EditError("the robot is in the air already");
    this.native.c.page_lift(robot);
    this.bodies[robot].lifted = true;
  }

  /**
   * @param {number} robot
   * @param {{at: [number, number], heading: number}} where
   */
  put(robot, { at, heading }) {
    const others = this.bodies.filter((_, i) => i !== robot);
    if (!this.bodies[robot].lifted) throw new EditError("the robot is not in the air");
    if (!this.furniture.hasRoom(at, others)) throw new EditError("there is no room for the robot");
    this.putDown(robot, [...at, heading / 1000]);
  }

  /**
   * @param {number} robot
   * @param {{what: string, seed?: number}} edit
   */
  breakBody(robot, { what, seed = 0 }) {
    const why = this.native.breakBody(robot, what, seed);
    if (why) throw new EditError(`'${what}' cannot happen to a body: ${why}`);
  }
}
