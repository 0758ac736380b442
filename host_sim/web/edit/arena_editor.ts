/* What a person does to the world in the selected run: selects items, moves obstacles, plants, food and robots, adds and
   removes obstacles; with the pointer, with buttons and with keys. */

import { ARROWS, byId, isForPage, setText, typedById } from "../core/dom.js";
import { say } from "../core/language.js";
import { allItems, endsOf, insideWalls, isInside, movedBar, plantOf, turnedBar, whole, wirePlace } from "./items.js";
import { PLANT_GROWTH_MM, PLANT_RADIUS_MM } from "../generated.js";
import { DragController } from "./drag_controller.js";
import type { Ghost, Item, Scene } from "../draw/scene.js";
import type { LabPage } from "../lab/lab_page.js";
import type { ShownRun } from "../lab/shown_run.js";
import type { Place, WorldEdit } from "../types.js";

/** Beyond the reach of the robot's sensors. */
const PLANT_GAP_MM = 20;
/** Ahead, right, left, behind. */
const BEARINGS = [0, 0.5, -0.5, 1].map((half) => half * Math.PI);
const NEW_BAR_MM = 250;
/** A new obstacle lies in the middle, or higher up if the robot is about there. */
const NEW_BAR_ROOM_MM = 300;
const NUDGE_MM = 50;
const SMALL_NUDGE_MM = 10;
const TURN = Math.PI / 12;

/** Makes changes of the selected run. */
export class ArenaEditor {
  /** By the lane that is touched; closed lanes are not kept. */
  drags: WeakMap<ShownRun, DragController> = new WeakMap();
  barPending = false;
  plantPending = false;
  /** The value of `ids` when an obstacle or a plant was put down that is not there yet. */
  idsBefore = 0;
  /** Robots that were asked to be lifted, and are not lifted yet. */
  lifting: Set<number> = new Set();

  /** @param scene - The editor sets its `item`, `node` and `ghosts`. */
  constructor(readonly lab: LabPage, public scene: Scene) {
    byId("lift").addEventListener("click", () => this.liftOrPut());
    byId("add-bar").addEventListener("click", () => this.addBar());
    byId("add-plant").addEventListener("click", () => this.addPlant());
    byId("grow").addEventListener("click", () => this.grow());
    byId("remove-bar").addEventListener("click", () => this.removeBar());
  }

  /** Makes the arena of a run editable. */
  watch(lane: ShownRun) {
    if (this.drags.has(lane)) return;
    this.drags.set(lane, new DragController(lane.renderer, this));
    lane.canvas.addEventListener("keydown", (event) => {
      const action = isForPage(event, "select") ? this.actionOf(event) : undefined;
      if (!action) return;
      event.preventDefault();
      action();
    });
  }

  send(change: WorldEdit) {
    this.idsBefore = this.ids;
    this.lab.change(change);
  }

  /** The highest ids of obstacles and plants, added up: this grows with each that is put down. */
  get ids() {
    const { bars, plants = [] } = this.scene.environment;
    const [bar, plant] = [bars, plants].map((things) => Math.max(-1, ...things.map(([id]) => id)));
    return bar + plant;
  }

  /** The states may have changed, and with them what can be done. */
  beforeDrawing() {
    if ((this.barPending || this.plantPending) && this.ids > this.idsBefore) this.onEnvironment();
    this.onStates(this.drags.get(this.lab.lane)?.robot);
  }

  /** Called when the arena has changed: the selected item may be gone, and a requested obstacle may be there. */
  onEnvironment() {
    const { environment, item } = this.scene;
    if (this.barPending) this.select(whole("bar", Math.max(...environment.bars.map(([id]) => id))));
    else if (this.plantPending) this.select(whole("plant", Math.max(...(environment.plants ?? []).map(([id]) => id))));
    else if (item?.kind === "bar" && !endsOf(environment, item.id)) this.select(undefined);
    else if (item?.kind === "plant" && !plantOf(environment, item.id)) this.select(undefined);
    this.barPending = this.plantPending = false;
  }

  /**
   * Shows robots where their states say, except those that a person holds.
   * @param dragged - The robot that is being dragged.
   */
  onStates(dragged?: number) {
    const { states, ghosts, item } = this.scene;
    for (const { node, lifted } of states) {
      if (lifted) this.lifting.delete(node);
      else if (node !== dragged && !this.lifting.has(node)) ghosts.delete(node);
    }
    const { node, lifted } = this.robot;
    const several = states.length > 1;
    typedById("remove-bar", HTMLButtonElement).disabled = item?.kind !== "bar" && item?.kind !== "plant";
    typedById("grow", HTMLButtonElement).disabled = item?.kind !== "plant";
    setText(byId("lift"), say(lifted ? (several ? "putDownNumber" : "putDown") : several ? "pickUpNumber" : "pickUp", { node }));
  }

  /** Called when a command was refused: stops waiting for robots to be lifted and for a new obstacle. */
  onRefusal() {
    this.lifting.clear();
    this.barPending = this.plantPending = false;
    this.lab.lightUp();
  }

  /** The state of the robot that the buttons act on: that of the panel. */
  get robot() {
    return this.scene.state;
  }

  select(item: Item | undefined) {
    this.scene.item = item;
    if (item?.kind === "robot") this.scene.node = item.id;
    this.lab.lightUp();
  }

  /** @param step - 1 for the next item, -1 for the one before. */
  selectNext(step: number) {
    const items = allItems(this.scene);
    const { item } = this.scene;
    const now = items.findIndex(({ kind, id }) => kind === item?.kind && id === item.id);
    const first = step > 0 ? 0 : items.length - 1;
    this.select(items[now < 0 ? first : (now + step + items.length) % items.length]);
  }

  liftOrPut() {
    const { robot, scene } = this;
    const { x, y, heading } = scene.poseOf(robot);
    this.hold(robot.node, { x, y, heading });
    if (robot.lifted) this.put(robot.node);
    else this.lift(robot.node);
    this.select(whole("robot", robot.node));
  }

  lift(node: number) {
    this.lifting.add(node);
    this.send({ do: "lift", robot: this.indexOf(node) });
  }

  /** Puts a robot down where a person holds it. */
  put(node: number) {
    const ghost = this.scene.ghosts.get(node);
    if (!ghost) return;
    this.send({ do: "put", robot: this.indexOf(node), at: wirePlace(ghost, this.scene.measures), heading: ghost.heading });
  }

  indexOf(wanted: number) {
    return this.scene.states.findIndex(({ node }) => node === wanted);
  }

  /** Draws a robot where a person holds it, which is never beyond the walls. */
  hold(node: number, ghost: Ghost) {
    this.scene.ghosts.set(node, insideWalls(ghost, this.scene.measures));
    this.lab.lightUp();
  }

  addBar() {
    const { width, height } = this.scene.measures;
    const isFree = this.scene.states.every(({ y }) => Math.abs(y - height / 2) > NEW_BAR_ROOM_MM);
    const x = Math.round(width / 2);
    const y = Math.round(height * (isFree ? 0.5 : 0.2));
    this.barPending = true;
    this.send({ do: "add_bar", a: [x - NEW_BAR_MM, y], b: [x + NEW_BAR_MM, y] });
  }

  /** Puts a plant down ahead of the robot or, if a wall is there, beside it. */
  addPlant() {
    const { measures } = this.scene;
    const { x, y, heading } = this.robot;
    const far = measures.body + measures.reach + PLANT_GAP_MM + PLANT_RADIUS_MM;
    const places = BEARINGS.map((bearing) => {
      const angle = heading / 1000 + bearing;
      return { x: x + far * Math.cos(angle), y: y + far * Math.sin(angle) };
    });
    const at = places.find((place) => isInside(place, measures)) ?? places[0];
    this.plantPending = true;
    this.send({ do: "plant", at: wirePlace(at, measures), radius: PLANT_RADIUS_MM });
  }

  /** Makes the selected plant grow to all sides. */
  grow() {
    const { item, environment } = this.scene;
    const plant = item?.kind === "plant" && plantOf(environment, item.id);
    if (plant) this.send({ do: "grow_plant", id: item.id, radius: Math.round(plant.radius) + PLANT_GROWTH_MM });
  }

  removeBar() {
    const { item } = this.scene;
    if (item?.kind === "bar") this.send({ do: "remove_bar", id: item.id });
    if (item?.kind === "plant") this.send({ do: "remove_plant", id: item.id });
  }

  /** @param by - mm */
  nudge(by: Place) {
    const { item, environment, measures, ghosts } = this.scene;
    if (!item) return;
    const ghost = item.kind === "robot" && ghosts.get(item.id);
    if (ghost) this.hold(item.id, { ...ghost, x: ghost.x + by.x, y: ghost.y + by.y });
    if (item.kind === "food") {
      const [x, y] = environment.food[item.id];
      this.send({ do: "move_food", id: item.id, at: wirePlace({ x: x + by.x, y: y + by.y }, measures) });
    }
    const ends = item.kind === "bar" && endsOf(environment, item.id);
    if (ends) this.send({ do: "move_bar", id: item.id, ...movedBar(ends, "whole", by, measures) });
    const plant = item.kind === "plant" && plantOf(environment, item.id);
    if (plant) this.send({ do: "move_plant", id: item.id, at: wirePlace({ x: plant.x + by.x, y: plant.y + by.y }, measures) });
  }

  /** Turns the selected item to the right. */
  turn(radians: number) {
    const { item, environment, measures, ghosts } = this.scene;
    const ghost = item?.kind === "robot" && ghosts.get(item.id);
    if (ghost) this.hold(item.id, { ...ghost, heading: Math.round(1000 * wrap(ghost.heading / 1000 + radians)) });
    const ends = item?.kind === "bar" && endsOf(environment, item.id);
    if (ends) this.send({ do: "move_bar", id: item.id, ...turnedBar(ends, radians, measures) });
  }

  /** What a key does to what is selected. */
  actionOf({ key, shiftKey }: KeyboardEvent): (() => void) | undefined {
    const arrow = ARROWS[key];
    const step = shiftKey ? SMALL_NUDGE_MM : NUDGE_MM;
    if (arrow) return () => this.nudge({ x: arrow.x * step, y: arrow.y * step });
    const actions: Record<string, () => void> = {
      q: () => this.selectNext(-1),
      e: () => this.selectNext(1),
      r: () => this.turn(shiftKey ? -TURN : TURN),
      p: () => this.liftOrPut(),
      a: () => this.addBar(),
      delete: () => this.removeBar(),
      backspace: () => this.removeBar(),
      escape: () => this.select(undefined),
    };
    return actions[key.toLowerCase()];
  }
}

/** The same angle in -pi..pi. */
function wrap(radians: number) {
  return Math.atan2(Math.sin(radians), Math.cos(radians));
}
