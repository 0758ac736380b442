// @ts-check
/* Editing of the arenas, as on the live page, in the selected run. Plants can be added and grown. */

import { ArenaEditor } from "../edit/arena_editor.js";
import { bindArenaKeys } from "../edit/arena_keys.js";
import { DragController } from "../edit/drag_controller.js";
import { byId, typedById } from "../core/elements.js";
import { isInside, plantOf, wirePlace } from "../edit/placement.js";
import { PLANT_GROWTH_MM, PLANT_RADIUS_MM } from "../generated.js";
import { isWorldEdit } from "../sim/arena.js";

/** Beyond the reach of the robot's sensors. */
const PLANT_GAP_MM = 20;
/** Ahead, right, left, behind. */
const BEARINGS = [0, 0.5, -0.5, 1].map((half) => half * Math.PI);

/** An editor whose commands are changes of the selected run. */
export class LabEditor extends ArenaEditor {
  /**
   * @param {Laboratory} lab
   * @param {Scene} scene
   */
  constructor(lab, scene) {
    super(scene, (command) => this.pass(command), () => (lab.stale = true));
    this.lab = lab;
    /** @type {WeakMap<ShownRun, DragController>} - By the lane that is touched; closed lanes are not kept. */
    this.drags = new WeakMap();
    /** What `ids` was when an obstacle or a plant was put down that is not there yet. */
    this.idsBefore = 0;
    byId("add-plant").addEventListener("click", () => this.addPlant());
    byId("grow").addEventListener("click", () => this.grow());
  }

  /** @param {ShownRun} lane - Its arena can be touched from now on. */
  watch(lane) {
    if (this.drags.has(lane)) return;
    this.drags.set(lane, new DragController(lane.renderer, this));
    bindArenaKeys(lane.canvas, this);
  }

  /** The states may have changed, and with them what can be done. */
  beforeDrawing() {
    if ((this.barPending || this.plantPending) && this.ids > this.idsBefore) this.onEnvironment();
    this.onStates(this.drags.get(this.lab.lane)?.robot);
    typedById("grow", HTMLButtonElement).disabled = this.scene.item?.kind !== "plant";
  }

  /** @param {Command} command */
  pass(command) {
    const change = this.changeOf(command);
    this.idsBefore = this.ids;
    if (change) this.lab.change(change);
  }

  /** The highest ids of obstacles and plants, added up: this grows with each that is put down. */
  get ids() {
    const { bars, plants = [] } = this.scene.environment;
    const [bar, plant] = [bars, plants].map((things) => Math.max(-1, ...things.map(([id]) => id)));
    return bar + plant;
  }

  /**
   * What the live page would be told, as a change of a run.
   * @param {Command} command
   * @returns {Change | undefined}
   */
  changeOf(command) {
    const robot = "node" in command ? this.scene.states.findIndex(({ node }) => node === command.node) : 0;
    if (command.do === "lift") return { do: "lift", robot };
    if (command.do === "put") return { do: "put", robot, at: command.at, heading: command.heading };
    return isWorldEdit(command) ? command : undefined;
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
    this.idsBefore = this.ids;
    this.lab.change({ do: "plant", at: wirePlace(at, measures), radius: PLANT_RADIUS_MM });
  }

  /** The selected plant grows to all sides. */
  grow() {
    const { item, environment } = this.scene;
    const plant = item?.kind === "plant" && plantOf(environment, item.id);
    if (plant) this.lab.change({ do: "grow_plant", id: item.id, radius: Math.round(plant.radius) + PLANT_GROWTH_MM });
  }
}
