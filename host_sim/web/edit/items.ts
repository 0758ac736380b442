/* Finds what lies at a place in the arena, and the order in which the keyboard visits all items; and where these may be put: at
   whole mm within the walls. */

import type { Item, Scene } from "../draw/scene.js";
import type { EnvironmentScene, Measures } from "../generated_types.js";
import type { Place, WirePlace } from "../types.js";

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

/** The two ends of a bar. */
export type Ends = { a: Place; b: Place };

const WALL_GAP_MM = 2;

/** The two ends of a bar by its id, if it is there. */
export function endsOf(environment: EnvironmentScene, id: number): Ends | undefined {
  const bar = environment.bars.find(([barId]) => barId === id);
  return bar && { a: { x: bar[1], y: bar[2] }, b: { x: bar[3], y: bar[4] } };
}

/** A plant by its id, if it is there. */
export function plantOf(environment: EnvironmentScene, id: number) {
  const plant = environment.plants?.find(([plantId]) => plantId === id);
  return plant && { x: plant[1], y: plant[2], radius: plant[3] };
}

/**
 * A bar moved as a whole, or turned about one end so that the other follows a pointer. It keeps its length.
 * @param part - The end that follows, or "whole".
 */
export function movedBar(ends: Ends, part: Item["part"], by: Place, measures: Measures) {
  const moved = part === "whole" ? shifted(ends, roomFor(ends, by, measures)) : swung(ends, part, by);
  const fits = isInside(moved.a, measures) && isInside(moved.b, measures);
  const { a, b } = fits ? moved : ends;
  return { a: wirePlace(a, measures), b: wirePlace(b, measures) };
}

function shifted({ a, b }: Ends, by: Place): Ends {
  return { a: { x: a.x + by.x, y: a.y + by.y }, b: { x: b.x + by.x, y: b.y + by.y } };
}

function swung(ends: Ends, part: "a" | "b", by: Place): Ends {
  const [end, pivot] = part === "a" ? [ends.a, ends.b] : [ends.b, ends.a];
  const length = Math.hypot(end.x - pivot.x, end.y - pivot.y);
  const [dx, dy] = [end.x + by.x - pivot.x, end.y + by.y - pivot.y];
  const scale = length / (Math.hypot(dx, dy) || 1);
  return { ...ends, [part]: { x: pivot.x + dx * scale, y: pivot.y + dy * scale } };
}

/** The nearest place where a robot does not touch a wall. */
export function insideWalls<P extends Place>(at: P, { width, height, body }: Measures): P {
  const room = (value: number, size: number) =>
    Math.min(size - body - WALL_GAP_MM, Math.max(body + WALL_GAP_MM, value));
  return { ...at, x: room(at.x, width), y: room(at.y, height) };
}

/** Whether a place is within the walls. */
export function isInside({ x, y }: Place, { width, height }: Measures) {
  return x >= 0 && y >= 0 && x <= width && y <= height;
}

/** A bar's ends turned about its middle. */
export function turnedBar({ a, b }: Ends, radians: number, measures: Measures) {
  const middle = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  const [cos, sin] = [Math.cos(radians), Math.sin(radians)];
  const turned = ({ x, y }: Place) => {
    const [dx, dy] = [x - middle.x, y - middle.y];
    return wirePlace({ x: middle.x + dx * cos - dy * sin, y: middle.y + dx * sin + dy * cos }, measures);
  };
  return { a: turned(a), b: turned(b) };
}

/** A place as commands have it. */
export function wirePlace({ x, y }: Place, measures: Measures): WirePlace {
  return [clamp(Math.round(x), measures.width), clamp(Math.round(y), measures.height)];
}

/** The part of a step for which both ends have room. */
function roomFor({ a, b }: Ends, by: Place, measures: Measures): Place {
  return { x: roomWithin(by.x, [a.x, b.x], measures.width), y: roomWithin(by.y, [a.y, b.y], measures.height) };
}

function roomWithin(step: number, values: number[], size: number) {
  return Math.min(Math.max(step, -Math.min(...values)), size - Math.max(...values));
}

function clamp(value: number, high: number) {
  return Math.min(high, Math.max(0, value));
}
