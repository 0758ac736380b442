/* Draws a scene on a canvas: the arena to scale, the trails, the robots. */

import { contextOf } from "../core/dom.js";
import { currentPalette } from "../core/palette.js";
import { RobotView } from "./robot_view.js";
import { circle, drawPlant } from "./shapes.js";
import { TrailLayer } from "./trail.js";
import type { Measures } from "../generated_types.js";
import type { Place } from "../types.js";
import type { Item, Meant, Scene } from "./scene.js";
import type { Viewport } from "./viewport.js";

/** Room around the arena, for its walls. */
const MARGIN_MM = 40;
const GRID_MM = 500;
const FOOD_MM = 50;

/** Keeps its canvas as sharp as the screen. */
export class Renderer {
  /** The scene that was drawn last. */
  scene: Scene | undefined;
  /** The upper left corner of what is in view, and its middle, mm. */
  corner = { x: -MARGIN_MM, y: -MARGIN_MM };
  middle = { x: 0, y: 0 };
  context = contextOf(this.canvas, { alpha: false });
  palette = currentPalette();
  trailLayer = new TrailLayer();
  scale = 1;
  size = { width: this.canvas.clientWidth, height: this.canvas.clientHeight };

  /** @param viewport - Says which part of the arena to show; without one, all of it. */
  constructor(readonly canvas: HTMLCanvasElement, readonly viewport?: Viewport) {
    viewport?.watch(this);
    this.context.fillStyle = this.palette.of.floor; // until there is a scene; without alpha, a canvas begins black
    this.context.fillRect(0, 0, canvas.width, canvas.height);
    new ResizeObserver(() => this.measure()).observe(canvas);
  }

  draw(scene: Scene) {
    this.palette = currentPalette();
    const { context, palette } = this;
    const robots = new RobotView(context, scene, palette);
    const states = [...scene.states].sort((a, b) => Number(a === scene.state) - Number(b === scene.state));
    this.scene = scene;
    this.fit(scene);
    this.drawFloor(scene.measures);
    this.trailLayer.draw(context, scene.trails, palette.reasons, scene.trail);
    for (const state of states) robots.drawLook(state);
    this.drawFood(scene);
    this.drawBars(scene);
    this.drawPlants(scene);
    for (const state of states) robots.draw(state);
    if (scene.meant?.first_tick === scene.environment.first_tick) this.drawMeant(scene.meant, scene);
  }

  /**
   * Converts a place on the page to one in the arena.
   * @returns mm
   */
  placeOf(at: { clientX: number; clientY: number }): Place {
    const box = this.canvas.getBoundingClientRect();
    const perMm = (this.scale * box.width) / this.canvas.width;
    return { x: (at.clientX - box.left) / perMm + this.corner.x, y: (at.clientY - box.top) / perMm + this.corner.y };
  }

  /**
   * Converts a length on the page to one in the arena.
   * @returns mm
   */
  lengthOf(px: number): number {
    return (px * this.canvas.width) / (this.scale * this.canvas.getBoundingClientRect().width);
  }

  /** Notes the size that the canvas has on the page. */
  measure() {
    this.size = { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }

  /** Gives the canvas the pixels of the screen, with mm as its unit, and moves it to the part in view. */
  fit(scene: Scene) {
    const { measures } = scene;
    const width = Math.max(1, Math.round(this.size.width * devicePixelRatio));
    const height = Math.max(1, Math.round(this.size.height * devicePixelRatio));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const whole = Math.min(width / (measures.width + 2 * MARGIN_MM), height / (measures.height + 2 * MARGIN_MM));
    this.scale = whole * (this.viewport?.zoom ?? 1);
    const middle = this.viewport?.middleOf(scene) ?? { x: 0, y: 0 };
    const [across, down] = [width / this.scale, height / this.scale];
    const { corner, scale } = this;
    corner.x = Math.max(-MARGIN_MM, Math.min(middle.x - across / 2, measures.width + MARGIN_MM - across));
    corner.y = Math.max(-MARGIN_MM, Math.min(middle.y - down / 2, measures.height + MARGIN_MM - down));
    this.middle = { x: corner.x + across / 2, y: corner.y + down / 2 };
    this.context.setTransform(scale, 0, 0, scale, -corner.x * scale, -corner.y * scale);
  }

  drawFloor(measures: Measures) {
    const { context, palette, corner } = this;
    context.fillStyle = palette.of.bar;
    context.fillRect(corner.x, corner.y, this.canvas.width / this.scale, this.canvas.height / this.scale);
    context.fillStyle = palette.of.floor;
    context.fillRect(0, 0, measures.width, measures.height);
    context.fillStyle = palette.of.grid;
    for (let x = GRID_MM; x < measures.width; x += GRID_MM) context.fillRect(x - 2, 0, 4, measures.height);
    for (let y = GRID_MM; y < measures.height; y += GRID_MM) context.fillRect(0, y - 2, measures.width, 4);
  }

  /** @param scene - Its food is drawn as full discs, and as empty rings once it is eaten. */
  drawFood({ environment, state, item }: Scene) {
    const { context, palette } = this;
    environment.food.forEach(([x, y], id) => {
      circle(context, x, y, FOOD_MM);
      context.fillStyle = palette.of[state.eaten[id] ? "floor" : "food"];
      context.fill();
      context.strokeStyle = palette.of[isSelected(item, "food", id) ? "select" : "food"];
      context.lineWidth = 14;
      context.stroke();
    });
  }

  /** Draws rings around what an answer is about. */
  drawMeant({ food, places }: Meant, { environment, measures }: Scene) {
    const { context, palette } = this;
    context.strokeStyle = palette.of.select;
    context.lineWidth = 14;
    const pieces = food.map((id) => environment.food[id]).filter(Boolean).map(([x, y]) => [x, y, 2 * FOOD_MM]);
    for (const [x, y, radius] of [...pieces, ...places.map(([px, py]) => [px, py, measures.body + 30])]) {
      circle(context, x, y, radius);
      context.stroke();
    }
  }

  drawBars({ environment, measures, item }: Scene) {
    const { palette } = this;
    this.context.lineCap = "round";
    for (const bar of environment.bars) {
      if (isSelected(item, "bar", bar[0])) this.drawBar(bar, measures.bar + 40, palette.of.select);
      this.drawBar(bar, measures.bar, palette.of.bar);
    }
  }

  drawPlants({ environment, item }: Scene) {
    const { context, palette } = this;
    for (const plant of environment.plants ?? []) {
      const [id, x, y, radius] = plant;
      drawPlant(context, plant, palette.of);
      if (!isSelected(item, "plant", id)) continue;
      context.strokeStyle = palette.of.select;
      context.lineWidth = 20;
      circle(context, x, y, radius);
      context.stroke();
    }
  }

  drawBar([, ax, ay, bx, by]: number[], width: number, colour: string) {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(ax, ay);
    context.lineTo(bx, by);
    context.stroke();
  }
}

function isSelected(item: Item | undefined, kind: Item["kind"], id: number) {
  return item?.kind === kind && item.id === id;
}
