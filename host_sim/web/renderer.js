/* Draws one scene on a canvas: the arena to scale, the trail, the robot. Knows nothing but its canvas. */

import { paletteOf } from "./palette.js";
import { circle, drawLook, drawRobot } from "./robot_view.js";
import { TrailLayer } from "./trail_view.js";

/** Room around the arena, for its walls. */
export const MARGIN_MM = 40;
const GRID_MM = 500;
const FOOD_MM = 50;

/**
 * What there is to see; the parts are those of host_sim/view/state.py.
 * @typedef {Object} Scene
 * @property {Object} measures
 * @property {Object} environment
 * @property {Object} state
 * @property {import("./trail.js").Trail} trail
 * @property {{kind: string, id: number}} [selected] - What a person has chosen, if anything.
 * @property {{x: number, y: number}} [ghost] - Where a person holds the robot, if anyone does.
 */

/** Keeps its canvas as sharp as the screen. */
export class Renderer {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d", { alpha: false });
    this.palette = paletteOf(canvas);
    this.trailLayer = new TrailLayer();
    this.scale = 1;
    this.watchColours();
    this.size = { width: canvas.clientWidth, height: canvas.clientHeight };
    new ResizeObserver(() => this.measure()).observe(canvas);
  }

  /** @param {Scene} scene */
  draw(scene) {
    const { context, palette } = this;
    this.fit(scene.measures);
    this.drawFloor(scene.measures);
    this.trailLayer.draw(context, scene.trail, palette.reasons);
    drawLook(context, scene, palette);
    this.drawFood(scene);
    this.drawBars(scene);
    drawRobot(context, scene, palette);
  }

  /**
   * The place in the arena at a place of the page.
   * @param {{clientX: number, clientY: number}} at
   * @returns {{x: number, y: number}} mm
   */
  placeOf(at) {
    const box = this.canvas.getBoundingClientRect();
    const perMm = (this.scale * box.width) / this.canvas.width;
    return { x: (at.clientX - box.left) / perMm - MARGIN_MM, y: (at.clientY - box.top) / perMm - MARGIN_MM };
  }

  watchColours() {
    const again = () => (this.palette = paletteOf(this.canvas));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
  }

  measure() {
    this.size = { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }

  /** Gives the canvas a pixel for each of the screen's, and mm as its unit. */
  fit(measures) {
    const width = Math.max(1, Math.round(this.size.width * devicePixelRatio));
    const height = Math.max(1, Math.round(this.size.height * devicePixelRatio));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    this.scale = Math.min(width / (measures.width + 2 * MARGIN_MM), height / (measures.height + 2 * MARGIN_MM));
    this.context.setTransform(this.scale, 0, 0, this.scale, MARGIN_MM * this.scale, MARGIN_MM * this.scale);
  }

  drawFloor(measures) {
    const { context, palette } = this;
    context.fillStyle = palette.of.bar;
    context.fillRect(-MARGIN_MM, -MARGIN_MM, measures.width + 2 * MARGIN_MM, measures.height + 2 * MARGIN_MM);
    context.fillStyle = palette.of.floor;
    context.fillRect(0, 0, measures.width, measures.height);
    context.fillStyle = palette.of.grid;
    for (let x = GRID_MM; x < measures.width; x += GRID_MM) context.fillRect(x - 2, 0, 4, measures.height);
    for (let y = GRID_MM; y < measures.height; y += GRID_MM) context.fillRect(0, y - 2, measures.width, 4);
  }

  /** A full disc; an empty ring once it is eaten. */
  drawFood({ environment, state, selected }) {
    const { context, palette } = this;
    environment.food.forEach(([x, y], id) => {
      circle(context, x, y, FOOD_MM);
      context.fillStyle = palette.of[state.eaten[id] ? "floor" : "food"];
      context.fill();
      context.strokeStyle = palette.of[isIt(selected, "food", id) ? "select" : "food"];
      context.lineWidth = 14;
      context.stroke();
    });
  }

  drawBars({ environment, measures, selected }) {
    const { context, palette } = this;
    context.lineCap = "round";
    for (const [id, ax, ay, bx, by] of environment.bars) {
      if (isIt(selected, "bar", id)) this.drawBar([ax, ay, bx, by], measures.bar + 40, palette.of.select);
      this.drawBar([ax, ay, bx, by], measures.bar, palette.of.bar);
    }
  }

  drawBar([ax, ay, bx, by], width, colour) {
    const { context } = this;
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(ax, ay);
    context.lineTo(bx, by);
    context.stroke();
  }
}

function isIt(selected, kind, id) {
  return selected?.kind === kind && selected.id === id;
}
