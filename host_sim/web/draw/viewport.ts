/* Which part of the arena a page shows: zoomed and moved by wheel, fingers, buttons and keys, or following the robot. */

import { ARROWS, byId, isForPage, typedById } from "../core/dom.js";
import { itemAt } from "../edit/items.js";
import type { Place } from "../types.js";
import type { Renderer } from "./renderer.js";
import type { Scene } from "./scene.js";

const ZOOM_MAX = 10;
const ZOOM_STEP = 1.5;
/** The zoom for following a robot, if all of the arena was in view. */
const FOLLOW_ZOOM = 2.5;
const WHEEL_PX = 400;
/** How far an arrow key moves the view, as a fraction of its size. */
const ARROW_SHARE = 0.15;

/** Serves all arenas of a page; its buttons are zoom-in, zoom-out and follow. */
export class Viewport {
  zoom = 1;
  follows = false;
  /** The middle of what is in view, mm; undefined for that of the arena. */
  middle: Place | undefined;
  /** Where each finger is, by the number of its pointer. */
  fingers: Map<number, PointerEvent> = new Map();

  /** @param onChange - Called when the arenas are to be drawn anew. */
  constructor(readonly onChange: () => void) {
    byId("zoom-in").addEventListener("click", () => this.magnify(ZOOM_STEP));
    byId("zoom-out").addEventListener("click", () => this.magnify(1 / ZOOM_STEP));
    byId("follow").addEventListener("click", () => this.follow(!this.follows));
    document.addEventListener("keydown", (event) => this.onKey(event));
    this.show();
  }

  /**
   * The middle of what is to be in view of a scene.
   * @returns mm
   */
  middleOf(scene: Scene): Place {
    const { width, height } = scene.measures;
    return this.follows ? scene.poseOf(scene.state) : (this.middle ?? { x: width / 2, y: height / 2 });
  }

  /**
   * @param renderer - The arena in which a place stays where it is.
   * @param at - That place, mm.
   * @returns Whether there is anything left to zoom.
   */
  magnify(factor: number, renderer?: Renderer, at?: Place): boolean {
    const zoom = Math.min(ZOOM_MAX, Math.max(1, this.zoom * factor));
    if (zoom === this.zoom) return false;
    const part = this.zoom / zoom;
    if (renderer && at) {
      const { x, y } = renderer.middle;
      this.middle = renderer.middle = { x: at.x + (x - at.x) * part, y: at.y + (y - at.y) * part };
    }
    this.zoom = zoom;
    if (zoom === 1) [this.follows, this.middle] = [false, undefined];
    this.show();
    return true;
  }

  follow(follows: boolean) {
    this.follows = follows;
    if (follows && this.zoom === 1) this.zoom = FOLLOW_ZOOM;
    this.show();
  }

  /**
   * Moves what is in view; several calls before the next drawing add up.
   * @param by - mm
   */
  move(renderer: Renderer, by: Place) {
    const { x, y } = renderer.middle;
    this.follows = false;
    this.middle = renderer.middle = { x: x + by.x, y: y + by.y };
    this.show();
  }

  show() {
    typedById("zoom-out", HTMLButtonElement).disabled = this.zoom === 1;
    typedById("zoom-in", HTMLButtonElement).disabled = this.zoom === ZOOM_MAX;
    byId("follow").setAttribute("aria-pressed", `${this.follows}`);
    document.body.classList.toggle("zoomed", this.zoom > 1);
    this.onChange();
  }

  onKey(event: KeyboardEvent) {
    if (!isForPage(event, "select, input, textarea")) return;
    const { key } = event;
    if (key === "+" || key === "=") this.magnify(ZOOM_STEP);
    else if (key === "-") this.magnify(1 / ZOOM_STEP);
    else if (key.toLowerCase() === "f") this.follow(!this.follows);
  }

  /** Makes a renderer's arena zoomable and movable. */
  watch(renderer: Renderer) {
    const { canvas } = renderer;
    canvas.addEventListener("wheel", (event) => {
      const zooms = this.magnify(Math.exp(-event.deltaY / WHEEL_PX), renderer, renderer.placeOf(event));
      if (zooms || this.zoom > 1) event.preventDefault();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.onArrow(event, renderer));
    canvas.addEventListener("pointerdown", (event) => this.press(event, renderer));
    canvas.addEventListener("pointermove", (event) => this.drag(event, renderer));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => this.fingers.delete((event as PointerEvent).pointerId));
    }
  }

  /** Arrow keys move what is in view, unless they move an item. */
  onArrow(event: KeyboardEvent, renderer: Renderer) {
    const arrow = ARROWS[event.key];
    if (!arrow || this.zoom === 1 || renderer.scene?.item || !isForPage(event, "select")) return;
    const far = ARROW_SHARE * renderer.lengthOf(renderer.canvas.clientWidth);
    event.preventDefault();
    event.stopPropagation();
    this.move(renderer, { x: far * arrow.x, y: far * arrow.y });
  }

  press(event: PointerEvent, renderer: Renderer) {
    const hits = renderer.scene && itemAt(renderer.scene, renderer.placeOf(event));
    if (hits && event.isPrimary) return;
    this.fingers.set(event.pointerId, event);
    renderer.canvas.setPointerCapture(event.pointerId);
  }

  /** One finger moves what is in view, two zoom it, too. */
  drag(event: PointerEvent, renderer: Renderer) {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const [from, to] = [renderer.placeOf(before), renderer.placeOf(event)];
    const other = [...this.fingers.values()].find(({ pointerId }) => pointerId !== event.pointerId);
    this.fingers.set(event.pointerId, event);
    if (other) {
      const apart = (it: PointerEvent) => Math.hypot(it.clientX - other.clientX, it.clientY - other.clientY);
      this.magnify(apart(event) / Math.max(1, apart(before)), renderer, renderer.placeOf(other));
    } else if (this.zoom > 1) this.move(renderer, { x: from.x - to.x, y: from.y - to.y });
  }
}
