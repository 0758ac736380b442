/* The tab with the map of all memories: its colours, the ways of the robots that are shown, and a robot for each square. */

import { ARROWS, buttonOf, contextOf, made, mayMove, setText } from "../core/dom.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { currentPalette } from "../core/palette.js";
import { strokeOf } from "../draw/chart.js";
import { CoarseMap, HEIGHT, StudiedMap, WIDTH, frozenWith, isStudied, memoryAt, placeOf, places } from "./atlas_map.js";
import type { Experiment } from "../types.js";
import type { Laboratory } from "./laboratory.js";
import type { ShownRun } from "./shown_run.js";

/** Pixels of a square. */
const SQUARE = 9;
/** From fast to slow: viridis, which colour-blind people can tell apart, too. */
const COLOURS = [[253, 231, 37], [94, 201, 98], [33, 145, 140], [59, 82, 139], [68, 1, 84]];
/** The share of memories that get the darkest colour, since a few are far slower than all others. */
const SLOWEST = 0.01;

export class AtlasTab {
  studied = new StudiedMap(this.lab.parts.atlas);
  /** By world and body. */
  coarse: Map<string, CoarseMap> = new Map();
  cursor = placeOf(memoryAt(0, 0));
  /** The run of the square that was pressed. */
  lane: ShownRun | undefined;
  key = "";
  help = made("p", []);
  canvas = made("canvas", [], { id: "atlas-map", tabindex: "0", role: "application", "aria-describedby": "atlas-square" });
  square = made("output", [], { id: "atlas-square" });
  about = made("p", [], { id: "atlas-about" });
  drives = buttonOf("", () => this.drive());
  extends = buttonOf("", () => this.extend());

  constructor(parent: HTMLElement, readonly lab: Laboratory) {
    Object.assign(this.canvas, { width: WIDTH * SQUARE, height: HEIGHT * SQUARE });
    this.extends.id = "atlas-extend";
    parent.append(this.canvas, this.square, made("div", [this.drives, this.extends], { class: "controls" }), this.about, this.help);
    this.bind();
    inEachLanguage(() => {
      setText(this.help, say("atlasHelp"));
      setText(this.drives, say("atlasDrive"));
      this.canvas.setAttribute("aria-label", say("atlasOf"));
      this.key = "";
      lab.lightUp();
    });
  }

  bind() {
    const move = (x: number, y: number) => {
      this.cursor = [Math.min(WIDTH - 1, Math.max(0, x)), Math.min(HEIGHT - 1, Math.max(0, y))];
      this.lab.lightUp();
    };
    const moveTo = ({ offsetX, offsetY }: MouseEvent) =>
      move(Math.floor((offsetX / this.canvas.clientWidth) * WIDTH), Math.floor((offsetY / this.canvas.clientHeight) * HEIGHT));
    this.canvas.addEventListener("pointermove", moveTo);
    this.canvas.addEventListener("click", (event) => {
      moveTo(event);
      this.drive();
    });
    this.canvas.addEventListener("keydown", (event) => {
      const step = ARROWS[event.key];
      if (step) move(this.cursor[0] + step.x, this.cursor[1] + step.y);
      else if (event.key === "Enter") this.drive();
      else return;
      event.preventDefault();
    });
  }

  /** The map of the world and body that are shown. */
  get map() {
    const { experiment } = this.lab.lane;
    return isStudied(experiment) ? this.studied : this.coarseOf(experiment);
  }

  coarseOf({ world, body }: Experiment) {
    const key = JSON.stringify([world, body]);
    const map = this.coarse.get(key) ?? new CoarseMap({ world, body });
    this.coarse.set(key, map);
    return map;
  }

  /** The memory of the square that is selected. */
  get memory() {
    return this.map.nearest(memoryAt(this.cursor[0], this.cursor[1]));
  }

  /** Lets a robot with the selected memory drive beside the run that is shown, from its start. */
  drive() {
    const { lab, memory } = this;
    const isThere = this.lane && lab.lanes.includes(this.lane);
    if (!isThere && lab.isFull) return lab.note.show(say("atlasFull"));
    const before = lab.lanes.length;
    lab.inCopy(() => {
      if (this.lane && isThere) lab.select(this.lane);
      else if (lab.lanes.length === before) lab.copy();
      const { lane } = lab;
      this.lane = lane;
      lane.experiment = frozenWith(memory, lane.experiment, lane.robot);
      lab.simulate(lane);
      lab.go(lab.first);
      lab.setPlaying(mayMove());
    });
  }

  /** Adds environments to the coarse map, or stops that. */
  extend() {
    const { map } = this;
    if (!(map instanceof CoarseMap)) return;
    if (map.isGrowing) map.isGrowing = false;
    else map.extend(this.lab.simulator, () => this.lab.lightUp()).catch(({ message }) => this.lab.note.show(heard(message)));
    this.lab.lightUp();
  }

  show() {
    const { map, memory, cursor } = this;
    const ways = this.lab.lanes.map((lane) => this.wayOf(lane));
    const known = map instanceof CoarseMap ? [...map.counts] : [];
    const key = JSON.stringify([cursor, ways, known, this.lab.lane.number, map instanceof CoarseMap && map.isGrowing]);
    if (key === this.key) return;
    this.key = key;
    this.draw(ways);
    const seconds = map.meanOf(memory);
    const digits = memory.join("");
    setText(this.square, seconds === undefined ? say("atlasUnknown", { memory: digits })
      : say("atlasSquare", { memory: digits, seconds: Math.round(seconds) }));
    this.extends.hidden = !(map instanceof CoarseMap);
    if (!(map instanceof CoarseMap)) return setText(this.about, say("atlasStudied"));
    setText(this.extends, say(map.isGrowing ? "atlasStop" : map.environments ? "atlasMore" : "atlasMake"));
    setText(this.about, say("atlasCoarse", { count: map.environments }));
  }

  /** The memories that the selected robot of a run had up to the tick that is shown, as places. */
  wayOf({ data, robot }: ShownRun) {
    const had = data?.robots[robot].run.memory ?? [];
    return had.filter(([tick]) => tick <= this.lab.tick).map(([, memory]) => placeOf(memory));
  }

  /** @param ways - For each run, the places of its memories. */
  draw(ways: number[][][]) {
    const context = contextOf(this.canvas);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    const times = places().map(([x, y]) => this.map.meanOf(this.map.nearest(memoryAt(x, y))) ?? NaN);
    const sorted = times.filter((time) => !Number.isNaN(time)).sort((a, b) => a - b);
    const [low, high] = [sorted[0], sorted[Math.floor((1 - SLOWEST) * (sorted.length - 1))]];
    for (const [i, [x, y]] of places().entries()) {
      if (Number.isNaN(times[i])) continue;
      context.fillStyle = colourOf(high > low ? (times[i] - low) / (high - low) : 0);
      context.fillRect(x * SQUARE, y * SQUARE, SQUARE, SQUARE);
    }
    this.drawThirds(context);
    const { robots } = currentPalette();
    for (const [i, way] of ways.entries()) drawWay(context, way, strokeOf(i, robots).colour);
    context.strokeStyle = "#000";
    context.strokeRect(this.cursor[0] * SQUARE - 1, this.cursor[1] * SQUARE - 1, SQUARE + 2, SQUARE + 2);
  }

  /** Draws lines between the contents of cells 1 and 4. */
  drawThirds(context: CanvasRenderingContext2D) {
    context.fillStyle = "#fff";
    for (const part of [1, 2]) {
      context.fillRect((part * WIDTH * SQUARE) / 3 - 1, 0, 2, HEIGHT * SQUARE);
      context.fillRect(0, (part * HEIGHT * SQUARE) / 3 - 1, WIDTH * SQUARE, 2);
    }
  }
}

function drawWay(context: CanvasRenderingContext2D, way: number[][], colour: string) {
  const last = way.at(-1);
  if (!last) return;
  const middle = (place: number) => (place + 0.5) * SQUARE;
  for (const [width, style] of [[5, "#fff"], [2.5, colour]] as [number, string][]) {
    Object.assign(context, { lineWidth: width, strokeStyle: style, fillStyle: style, lineJoin: "round" });
    context.beginPath();
    for (const [x, y] of way) context.lineTo(middle(x), middle(y));
    context.stroke();
    context.beginPath();
    context.arc(middle(last[0]), middle(last[1]), SQUARE / 2 + width / 2, 0, 2 * Math.PI);
    context.fill();
  }
}

/** @param part - From 0, the fastest, to 1, the slowest; more counts as 1. */
function colourOf(part: number) {
  const place = Math.min(Math.max(part, 0), 1) * (COLOURS.length - 1);
  const from = Math.min(Math.floor(place), COLOURS.length - 2);
  const mixed = COLOURS[from].map((value, i) => Math.round(value + (COLOURS[from + 1][i] - value) * (place - from)));
  return `rgb(${mixed.join(" ")})`;
}
