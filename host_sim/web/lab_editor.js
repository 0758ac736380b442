// @ts-check
/* What a person does in the arenas: as on the live page, in the run that is selected. A plant is an obstacle that grows. */

import { ArenaEditor } from "./arena_editor.js";
import { bindArenaKeys } from "./arena_keys.js";
import { DragController } from "./drag_controller.js";
import { byId, typedById } from "./elements.js";
import { endsOf, wirePlace } from "./placement.js";

/**
 * @typedef {import("./lane.js").Lane} Lane
 * @typedef {import("./scene.js").Scene} Scene
 * @typedef {import("./types.js").Change} Change
 * @typedef {import("./types.js").Command} Command
 *
 * @typedef {{lane: Lane, change: (change: Change) => void}} Lab
 */

const PLANT_MM = 60;
const GROWTH_MM = 60;

/** An editor whose commands are changes of the selected run. */
export class LabEditor extends ArenaEditor {
  /**
   * @param {Lab} lab
   * @param {Scene} scene
   */
  constructor(lab, scene) {
    super(scene, (command) => this.pass(command));
    this.lab = lab;
    /** @type {Map<Lane, DragController>} */
    this.drags = new Map();
    byId("add-plant").addEventListener("click", () => this.addPlant());
    byId("grow").addEventListener("click", () => this.grow());
  }

  /**
   * Lets a lane's arena be touched.
   * @param {Lane} lane
   */
  watch(lane) {
    if (this.drags.has(lane)) return;
    this.drags.set(lane, new DragController(lane.renderer, this));
    bindArenaKeys(lane.canvas, this);
  }

  /** The states may have changed, and with them what can be done. */
  beforeDrawing() {
    if (this.barPending) this.onEnvironment();
    this.onStates(this.drags.get(this.lab.lane)?.robot);
    this.changed = false;
    typedById("grow", HTMLButtonElement).disabled = this.scene.item?.kind !== "bar";
  }

  /** @param {Command} command */
  pass(command) {
    const change = this.changeOf(command);
    if (change) this.lab.change(change);
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
    if (command.do === "add_bar" || command.do === "move_bar" || command.do === "remove_bar") return command;
    return command.do === "move_food" ? command : undefined;
  }

  /** Puts a plant down ahead of the robot, or in the middle. */
  addPlant() {
    const { measures } = this.scene;
    const { x, y, heading } = this.robot;
    const [dx, dy] = [Math.cos(heading / 1000), Math.sin(heading / 1000)];
    const far = measures.body + measures.reach + 2 * PLANT_MM;
    const [px, py] = [x + far * dx, y + far * dy];
    this.barPending = true;
    this.send({
      do: "add_bar",
      a: wirePlace({ x: px - PLANT_MM * dy, y: py + PLANT_MM * dx }, measures),
      b: wirePlace({ x: px + PLANT_MM * dy, y: py - PLANT_MM * dx }, measures),
    });
  }

  /** The selected obstacle becomes longer at both ends. */
  grow() {
    const { item, environment, measures } = this.scene;
    const ends = item?.kind === "bar" ? endsOf(environment, item.id) : undefined;
    if (!item || !ends) return;
    const { a, b } = ends;
    const length = Math.hypot(b.x - a.x, b.y - a.y);
    const [dx, dy] = [((b.x - a.x) / length) * GROWTH_MM, ((b.y - a.y) / length) * GROWTH_MM];
    this.send({
      do: "move_bar",
      id: item.id,
      a: wirePlace({ x: a.x - dx, y: a.y - dy }, measures),
      b: wirePlace({ x: b.x + dx, y: b.y + dy }, measures),
    });
  }
}
