/* Editing of the arenas, as on the live page, in the selected run. */

import { ArenaEditor } from "../edit/arena_editor.js";
import { DragController } from "../edit/drag_controller.js";
import { isWorldEdit } from "../sim/arena.js";
import { isForPage } from "../core/dom.js";
import type { Scene } from "../draw/scene.js";
import type { Change, Command } from "../types.js";
import type { Laboratory } from "./laboratory.js";
import type { ShownRun } from "./shown_run.js";

/** An editor whose commands are changes of the selected run. */
export class LabEditor extends ArenaEditor {
  /** By the lane that is touched; closed lanes are not kept. */
  drags: WeakMap<ShownRun, DragController> = new WeakMap();
  /** The value of `ids` when an obstacle or a plant was put down that is not there yet. */
  idsBefore = 0;

  constructor(readonly lab: Laboratory, scene: Scene) {
    super(scene, (command) => this.pass(command), () => (lab.stale = true));
  }

  /** Makes the arena of a run editable. */
  watch(lane: ShownRun) {
    if (this.drags.has(lane)) return;
    this.drags.set(lane, new DragController(lane.renderer, this));
    bindArenaKeys(lane.canvas, this);
  }

  /** The states may have changed, and with them what can be done. */
  beforeDrawing() {
    if ((this.barPending || this.plantPending) && this.ids > this.idsBefore) this.onEnvironment();
    this.onStates(this.drags.get(this.lab.lane)?.robot);
  }

  pass(command: Command) {
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

  /** A command of the live page as a change of a run. */
  changeOf(command: Command): Change | undefined {
    const robot = "node" in command ? this.scene.states.findIndex(({ node }) => node === command.node) : 0;
    if (command.do === "lift") return { do: "lift", robot };
    if (command.do === "put") return { do: "put", robot, at: command.at, heading: command.heading };
    return isWorldEdit(command) ? command : undefined;
  }
}

const NUDGE_MM = 50;
const SMALL_NUDGE_MM = 10;
const TURN = Math.PI / 12;
const ARROWS = new Map([
  ["arrowleft", { x: -1, y: 0 }], ["arrowright", { x: 1, y: 0 }],
  ["arrowup", { x: 0, y: -1 }], ["arrowdown", { x: 0, y: 1 }],
]);

/** Lets the keys that a canvas gets act on what is selected. */
function bindArenaKeys(canvas: HTMLCanvasElement, editor: ArenaEditor) {
  canvas.addEventListener("keydown", (event) => {
    if (!isForPage(event, "select")) return;
    const action = arrowAction(event, editor) ?? actionOf(event, editor);
    if (!action) return;
    event.preventDefault();
    action();
  });
}

function arrowAction({ key, shiftKey }: KeyboardEvent, editor: ArenaEditor): (() => void) | undefined {
  const arrow = ARROWS.get(key.toLowerCase());
  const step = shiftKey ? SMALL_NUDGE_MM : NUDGE_MM;
  return arrow && (() => editor.nudge({ x: arrow.x * step, y: arrow.y * step }));
}

function actionOf({ key, shiftKey }: KeyboardEvent, editor: ArenaEditor): (() => void) | undefined {
  const actions: Record<string, () => void> = {
    q: () => editor.selectNext(-1),
    e: () => editor.selectNext(1),
    r: () => editor.turn(shiftKey ? -TURN : TURN),
    p: () => editor.liftOrPut(),
    a: () => editor.addBar(),
    delete: () => editor.removeBar(),
    backspace: () => editor.removeBar(),
    escape: () => editor.select(undefined),
  };
  return actions[key.toLowerCase()];
}
