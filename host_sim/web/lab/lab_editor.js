// @ts-check
/* Editing of the arenas, as on the live page, in the selected run. */

import { ArenaEditor } from "../edit/arena_editor.js";
import { bindArenaKeys } from "../edit/arena_keys.js";
import { DragController } from "../edit/drag_controller.js";
import { isWorldEdit } from "../sim/arena.js";

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
}
