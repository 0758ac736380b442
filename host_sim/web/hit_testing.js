// @ts-check
/* What lies at a place in the arena, and in which order the keyboard goes through it all. */

/**
 * @typedef {import("./scene.js").Item} Item
 * @typedef {import("./scene.js").Scene} Scene
 * @typedef {import("./types.js").Place} Place
 */

const BAR_END_MM = 70;
const BAR_SIDE_MM = 60;
const FOOD_REACH_MM = 90;

/**
 * The item at a place, if there is one.
 * @param {Scene} scene
 * @param {Place} at - mm
 * @returns {Item | undefined}
 */
export function itemAt(scene, at) {
  return robotAt(scene, at) ?? foodAt(scene, at) ?? barAt(scene, at);
}

/**
 * @param {Scene} scene
 * @returns {Item[]}
 */
export function allItems({ states, environment }) {
  return [
    ...states.map(({ node }) => whole("robot", node)),
    ...environment.food.map((_, id) => whole("food", id)),
    ...environment.bars.map(([id]) => whole("bar", id)),
  ];
}

/**
 * An item, all of it.
 * @param {Item["kind"]} kind
 * @param {number} id
 * @returns {Item}
 */
export function whole(kind, id) {
  return { kind, id, part: "whole" };
}

/**
 * @param {Scene} scene
 * @param {Place} at
 */
function robotAt(scene, at) {
  const topFirst = [scene.state, ...scene.states];
  const state = topFirst.find((robot) => distance(at, scene.poseOf(robot)) < scene.measures.body);
  return state && whole("robot", state.node);
}

/**
 * @param {Scene} scene
 * @param {Place} at
 */
function foodAt({ environment }, at) {
  const id = environment.food.findIndex(([x, y]) => distance(at, { x, y }) < FOOD_REACH_MM);
  return id < 0 ? undefined : whole("food", id);
}

/**
 * @param {Scene} scene
 * @param {Place} at
 * @returns {Item | undefined}
 */
function barAt({ environment }, at) {
  for (const bar of environment.bars) {
    const part = partAt(bar, at);
    if (part) return { kind: "bar", id: bar[0], part };
  }
  return undefined;
}

/**
 * @param {number[]} bar
 * @param {Place} at
 * @returns {Item["part"] | undefined}
 */
function partAt([, ax, ay, bx, by], at) {
  if (distance(at, { x: ax, y: ay }) < BAR_END_MM) return "a";
  if (distance(at, { x: bx, y: by }) < BAR_END_MM) return "b";
  const [dx, dy] = [bx - ax, by - ay];
  const along = Math.min(1, Math.max(0, ((at.x - ax) * dx + (at.y - ay) * dy) / (dx * dx + dy * dy)));
  return distance(at, { x: ax + along * dx, y: ay + along * dy }) < BAR_SIDE_MM ? "whole" : undefined;
}

/**
 * @param {Place} p
 * @param {Place} q
 */
export function distance(p, q) {
  return Math.hypot(p.x - q.x, p.y - q.y);
}
