// @ts-check
/* Finds what lies at a place in the arena, and the order in which the keyboard visits all items. */

const BAR_END_MM = 70;
const BAR_SIDE_MM = 60;
const FOOD_REACH_MM = 90;
const END_SHARE = 0.25;

/**
 * The item at a place, if there is one.
 * @param {Scene} scene
 * @param {Place} at - mm
 * @param {number} [slack] - For a finger: if nothing lies there, the nearest item within these mm.
 * @returns {Item | undefined}
 */
export function itemAt(scene, at, slack = 0) {
  return robotAt(scene, at) ?? foodAt(scene, at) ?? plantAt(scene, at) ?? barAt(scene, at) ?? nearest(scene, at, slack);
}

/**
 * @param {Scene} scene
 * @param {Place} at
 * @param {number} slack
 * @returns {Item | undefined}
 */
function nearest(scene, at, slack) {
  const found = [
    ...scene.states.map((state) => ({ item: whole("robot", state.node), away: distance(at, scene.poseOf(state)) })),
    ...scene.environment.food.map(([x, y], id) => ({ item: whole("food", id), away: distance(at, { x, y }) })),
    ...plantsOf(scene).map(([id, x, y, radius]) => ({ item: whole("plant", id), away: distance(at, { x, y }) - radius })),
    ...scene.environment.bars.map((bar) => nearBar(bar, at)),
  ];
  return found.filter(({ away }) => away <= slack).sort((p, q) => p.away - q.away)[0]?.item;
}

/**
 * A bar for a finger: its outer quarters are its ends.
 * @param {number[]} bar
 * @param {Place} at
 * @returns {{item: Item, away: number}}
 */
function nearBar(bar, at) {
  const { along, away } = besideBar(bar, at);
  const part = along < END_SHARE ? "a" : along > 1 - END_SHARE ? "b" : "whole";
  return { item: { kind: "bar", id: bar[0], part }, away };
}

/**
 * @param {Scene} scene
 * @returns {Item[]}
 */
export function allItems(scene) {
  const { states, environment } = scene;
  return [
    ...states.map(({ node }) => whole("robot", node)),
    ...environment.food.map((_, id) => whole("food", id)),
    ...environment.bars.map(([id]) => whole("bar", id)),
    ...plantsOf(scene).map(([id]) => whole("plant", id)),
  ];
}

/** @param {Scene} scene */
function plantsOf({ environment }) {
  return environment.plants ?? [];
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
 */
function plantAt(scene, at) {
  const plant = plantsOf(scene).find(([, x, y, radius]) => distance(at, { x, y }) < radius);
  return plant && whole("plant", plant[0]);
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
function partAt(bar, at) {
  const [, ax, ay, bx, by] = bar;
  if (distance(at, { x: ax, y: ay }) < BAR_END_MM) return "a";
  if (distance(at, { x: bx, y: by }) < BAR_END_MM) return "b";
  return besideBar(bar, at).away < BAR_SIDE_MM ? "whole" : undefined;
}

/**
 * The nearest point of a bar, which may be as short as a point: how far along it, 0..1, and how far away, mm.
 * @param {number[]} bar
 * @param {Place} at
 */
export function besideBar([, ax, ay, bx, by], at) {
  const [dx, dy] = [bx - ax, by - ay];
  const along = Math.min(1, Math.max(0, ((at.x - ax) * dx + (at.y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return { along, away: distance(at, { x: ax + along * dx, y: ay + along * dy }) };
}

/**
 * @param {Place} p
 * @param {Place} q
 */
export function distance(p, q) {
  return Math.hypot(p.x - q.x, p.y - q.y);
}
