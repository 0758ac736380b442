/* Dragging in the arena: what the pointer does to obstacles, plants, food and robots. */

import { distance, endsOf, itemAt, movedBar, wirePlace } from "./items.js";
import type { Renderer } from "../draw/renderer.js";
import type { Item } from "../draw/scene.js";
import type { Place } from "../types.js";
import type { ArenaEditor } from "./arena_editor.js";
import type { Ends } from "./items.js";

/** What is dragged, where the drag began, and for a bar its ends at that time. */
type Drag = { item: Item; from: Place; ends: Ends | undefined };

const LIFT_AFTER_MM = 30;
const CLICK_MM = 1;
const SEND_EVERY_MS = 30;
/** Half the size of what a finger can hit. */
const FINGER_PX = 22;

/** Selects what is pressed, and moves it with the pointer. */
export class DragController {
  drag: Drag | undefined;
  sentAt = 0;

  constructor(readonly renderer: Renderer, readonly editor: ArenaEditor) {
    const { canvas } = renderer;
    canvas.addEventListener("pointerdown", (event) => this.begin(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.end(event));
    canvas.addEventListener("pointercancel", (event) => this.end(event));
  }

  /** The robot that is being dragged, if one is. */
  get robot() {
    return this.drag?.item.kind === "robot" ? this.drag.item.id : undefined;
  }

  begin(event: PointerEvent) {
    if (!event.isPrimary) return this.drop();
    if (event.button !== 0) return;
    const { scene } = this.editor;
    const from = this.renderer.placeOf(event);
    const slack = event.pointerType === "touch" ? this.renderer.lengthOf(FINGER_PX) : 0;
    const item = itemAt(scene, from, slack);
    this.editor.select(item);
    if (!item) return;
    this.renderer.canvas.setPointerCapture(event.pointerId);
    this.drag = { item, from, ends: item.kind === "bar" ? endsOf(scene.environment, item.id) : undefined };
  }

  move(event: PointerEvent) {
    if (!this.drag) return;
    const at = this.renderer.placeOf(event);
    if (this.drag.item.kind === "robot") this.moveRobot(this.drag, at);
    else if (event.timeStamp - this.sentAt > SEND_EVERY_MS) {
      this.sentAt = event.timeStamp;
      this.moveItem(this.drag, at);
    }
  }

  end(event: PointerEvent) {
    const drag = this.drag;
    this.drag = undefined;
    if (!drag) return;
    const at = this.renderer.placeOf(event);
    if (drag.item.kind === "robot") this.editor.put(drag.item.id);
    else if (distance(at, drag.from) > CLICK_MM) this.moveItem(drag, at);
  }

  /** With a second finger, what is dragged stays where it is. */
  drop() {
    const robot = this.robot;
    this.drag = undefined;
    if (robot !== undefined) this.editor.put(robot);
  }

  moveItem({ item, from, ends }: Drag, at: Place) {
    const { measures } = this.editor.scene;
    const by = { x: at.x - from.x, y: at.y - from.y };
    if (item.kind === "food") this.editor.send({ do: "move_food", id: item.id, at: wirePlace(at, measures) });
    else if (item.kind === "plant") this.editor.send({ do: "move_plant", id: item.id, at: wirePlace(at, measures) });
    else if (ends) this.editor.send({ do: "move_bar", id: item.id, ...movedBar(ends, item.part, by, measures) });
  }

  moveRobot({ item, from }: Drag, at: Place) {
    const { scene } = this.editor;
    const state = scene.states.find(({ node }) => node === item.id);
    const held = scene.ghosts.has(item.id);
    if (!state || (!held && distance(at, from) < LIFT_AFTER_MM)) return;
    if (!state.lifted && !held) this.editor.lift(item.id);
    this.editor.hold(item.id, { ...at, heading: scene.poseOf(state).heading });
  }
}
