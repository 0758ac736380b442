/* Finds what lies at a place in the arena, and the order in which the keyboard visits all items. */

import type { Item, Scene } from "../draw/scene.js";
import type { Place } from "../types.js";

const BAR_END_MM = 70;
const BAR_SIDE_MM = 60;
const FOOD_REACH_MM = 90;
const END_SHARE = 0.25;

/**
 * The item at a place, if there is one.
 * @param at - mm
 * @param slack - For a finger: if nothing lies there, the nearest item within these mm.
 */
export function itemAt(scene: Scene, at: Place, slack = 0): Item | undefined {
  return robotAt(scene, at) ?? foodAt(scene, at) ?? plantAt(scene, at) ?? barAt(scene, at) ?? nearest(scene, at, slack);
}

function nearest(scene: Scene, at: Place, slack: number): Item | undefined {
  const found = [
    ...scene.states.map((state) => ({ item: whole("robot", state.node), away: distance(at, scene.poseOf(state)) })),
    ...scene.environment.food.map(([x, y], id) => ({ item: whole("food", id), away: distance(at, { x, y }) })),
    ...plantsOf(scene).map(([id, x, y, radius]) => ({ item: whole("plant", id), away: distance(at, { x, y }) - radius })),
    ...scene.environment.bars.map((bar) => nearBar(bar, at)),
  ];
  return found.filter(({ away }) => away <= slack).sort((p, q) => p.away - q.away)[0]?.item;
}

/** A bar for a finger: its outer quarters are its ends. */
function nearBar(bar: number[], at: Place): { item: Item; away: number } {
  const { along, away } = besideBar(bar, at);
  const part = along < END_SHARE ? "a" : along > 1 - END_SHARE ? "b" : "whole";
  return { item: { kind: "bar", id: bar[0], part }, away };
}

export function allItems(scene: Scene): Item[] {
  const { states, environment } = scene;
  return [
    ...states.map(({ node }) => whole("robot", node)),
    ...environment.food.map((_, id) => whole("food", id)),
    ...environment.bars.map(([id]) => whole("bar", id)),
    ...plantsOf(scene).map(([id]) => whole("plant", id)),
  ];
}

function plantsOf({ environment }: Scene) {
  return environment.plants ?? [];
}

/** An item as a whole. */
export function whole(kind: Item["kind"], id: number): Item {
  return { kind, id, part: "whole" };
}

function robotAt(scene: Scene, at: Place) {
  const topFirst = [scene.state, ...scene.states];
  const state = topFirst.find((robot) => distance(at, scene.poseOf(robot)) < scene.measures.body);
  return state && whole("robot", state.node);
}

function foodAt({ environment }: Scene, at: Place) {
  const id = environment.food.findIndex(([x, y]) => distance(at, { x, y }) < FOOD_REACH_MM);
  return id < 0 ? undefined : whole("food", id);
}

function plantAt(scene: Scene, at: Place) {
  const plant = plantsOf(scene).find(([, x, y, radius]) => distance(at, { x, y }) < radius);
  return plant && whole("plant", plant[0]);
}

function barAt({ environment }: Scene, at: Place): Item | undefined {
  for (const bar of environment.bars) {
    const part = partAt(bar, at);
    if (part) return { kind: "bar", id: bar[0], part };
  }
  return undefined;
}

function partAt(bar: number[], at: Place): Item["part"] | undefined {
  const [, ax, ay, bx, by] = bar;
  if (distance(at, { x: ax, y: ay }) < BAR_END_MM) return "a";
  if (distance(at, { x: bx, y: by }) < BAR_END_MM) return "b";
  return besideBar(bar, at).away < BAR_SIDE_MM ? "whole" : undefined;
}

/** The nearest point of a bar, which may be as short as a point: how far along it, 0..1, and how far away, mm. */
export function besideBar([, ax, ay, bx, by]: number[], at: Place) {
  const [dx, dy] = [bx - ax, by - ay];
  const along = Math.min(1, Math.max(0, ((at.x - ax) * dx + (at.y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return { along, away: distance(at, { x: ax + along * dx, y: ay + along * dy }) };
}

export function distance(p: Place, q: Place) {
  return Math.hypot(p.x - q.x, p.y - q.y);
}
