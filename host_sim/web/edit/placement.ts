/* Places items at whole mm within the walls. */

import type { Item } from "../draw/scene.js";
import type { EnvironmentScene, Measures } from "../generated_types.js";
import type { Place, WirePlace } from "../types.js";

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
