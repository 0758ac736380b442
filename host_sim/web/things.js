/* What lies where in the arena: finding things, and moving them as whole numbers of mm within the walls. */

const BAR_END_MM = 70;
const BAR_SIDE_MM = 60;
const FOOD_REACH_MM = 90;

/**
 * A thing that a person can take hold of. part: "a" or "b" for one end of a bar, else "whole".
 * @typedef {{kind: "robot"|"food"|"bar", id: number, part: string}} Thing
 */

/**
 * The thing at a place, or undefined.
 * @param {import("./renderer.js").Scene} scene
 * @param {{x: number, y: number}} at - mm
 * @returns {Thing|undefined}
 */
export function thingAt({ environment, state, measures, ghost }, at) {
  const robot = ghost ?? state;
  if (distance(at, robot) < measures.body) return { kind: "robot", id: 0, part: "whole" };
  const food = environment.food.findIndex(([x, y]) => distance(at, { x, y }) < FOOD_REACH_MM);
  if (food >= 0) return { kind: "food", id: food, part: "whole" };
  for (const bar of environment.bars) {
    const part = partAt(bar, at);
    if (part) return { kind: "bar", id: bar[0], part };
  }
  return undefined;
}

/** All things, in the order in which the keyboard goes through them. */
export function allThings({ environment }) {
  return [
    { kind: "robot", id: 0, part: "whole" },
    ...environment.food.map((_, id) => ({ kind: "food", id, part: "whole" })),
    ...environment.bars.map(([id]) => ({ kind: "bar", id, part: "whole" })),
  ];
}

/** The two ends of a bar by its id, or undefined. */
export function endsOf(environment, id) {
  const bar = environment.bars.find(([barId]) => barId === id);
  return bar && { a: { x: bar[1], y: bar[2] }, b: { x: bar[3], y: bar[4] } };
}

/** A bar's ends moved, both or one; it keeps its length at a wall. */
export function movedBar(ends, part, dx, dy, measures) {
  const way = part === "whole" ? roomFor(ends, dx, dy, measures) : { dx, dy };
  const moved = (name) => {
    if (part !== "whole" && part !== name) return whole(ends[name], measures);
    return whole({ x: ends[name].x + way.dx, y: ends[name].y + way.dy }, measures);
  };
  return { a: moved("a"), b: moved("b") };
}

/** A bar's ends turned about its middle. */
export function turnedBar({ a, b }, radians, measures) {
  const middle = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  const turned = ({ x, y }) => {
    const [dx, dy] = [x - middle.x, y - middle.y];
    const [cos, sin] = [Math.cos(radians), Math.sin(radians)];
    return whole({ x: middle.x + dx * cos - dy * sin, y: middle.y + dx * sin + dy * cos }, measures);
  };
  return { a: turned(a), b: turned(b) };
}

/** A place as the wire has it: [x, y], whole mm within the walls. */
export function whole({ x, y }, measures) {
  return [clamp(Math.round(x), measures.width), clamp(Math.round(y), measures.height)];
}

function roomFor({ a, b }, dx, dy, measures) {
  const within = (d, low, high, size) => Math.min(Math.max(d, -Math.min(low, high)), size - Math.max(low, high));
  return { dx: within(dx, a.x, b.x, measures.width), dy: within(dy, a.y, b.y, measures.height) };
}

function partAt([, ax, ay, bx, by], at) {
  if (distance(at, { x: ax, y: ay }) < BAR_END_MM) return "a";
  if (distance(at, { x: bx, y: by }) < BAR_END_MM) return "b";
  const [dx, dy] = [bx - ax, by - ay];
  const along = Math.min(1, Math.max(0, ((at.x - ax) * dx + (at.y - ay) * dy) / (dx * dx + dy * dy)));
  return distance(at, { x: ax + along * dx, y: ay + along * dy }) < BAR_SIDE_MM ? "whole" : undefined;
}

function distance(p, q) {
  return Math.hypot(p.x - q.x, p.y - q.y);
}

function clamp(value, high) {
  return Math.min(high, Math.max(0, value));
}
