/* Draws a robot: body, wheels, heading, the five cones, the look ahead, its number, and what it tries. */

import { REASON } from "../generated.js";
import { CONES } from "../core/sensors.js";
import { circle, drawDisc, drawRing, drawText } from "./shapes.js";
import type { Palette } from "../core/palette.js";
import type { State } from "../generated_types.js";
import type { Scene } from "./scene.js";

const CONE_HALF = Math.PI / 8;
const GLANCE_MM = 700;
const VERDICT_MS = 1200;
const SIGN_MM = 290;
const SIGN_ROOM_MM = 400;
const NUMBER_MM = 165;
const NUMBER_ROOM_MM = 260;

/** Draws the robots of a scene, each by its state. */
export class RobotView {
  /** @param context - In mm. */
  constructor(readonly context: CanvasRenderingContext2D, readonly scene: Scene, readonly palette: Palette) {}

  draw(state: State) {
    const { context, scene, palette } = this;
    const { body } = scene.measures;
    const pose = scene.poseOf(state);
    context.save();
    context.translate(pose.x, pose.y);
    context.save();
    context.rotate(pose.heading / 1000);
    if (scene.isHeld(state)) this.drawAir();
    else this.drawCones(state);
    if (scene.item?.kind === "robot" && scene.item.id === state.node) drawRing(context, body * 1.12, palette.of.select);
    this.drawBody(state);
    context.restore();
    if (scene.states.length > 1) this.drawNumber(state);
    this.drawTrial(state);
    context.restore();
  }

  /** Draws a wide dashed ring, which shows that it is off the floor. */
  drawAir() {
    this.context.setLineDash([40, 30]);
    drawRing(this.context, this.scene.measures.body * 1.45, this.palette.of.select);
    this.context.setLineDash([]);
  }

  /** Draws the corridor in which a robot sees food, highlighted up to the food that it sees; obstacles cover it. */
  drawLook(state: State) {
    const { context, palette, scene: { measures } } = this;
    if (this.scene.isHeld(state)) return;
    context.save();
    context.beginPath();
    context.rect(0, 0, measures.width, measures.height);
    context.clip();
    context.translate(state.x, state.y);
    context.rotate(state.heading / 1000);
    context.globalAlpha = state.beacon ? 0.4 : 0.13;
    context.fillStyle = palette.of[state.beacon ? "food" : "beam"];
    context.fillRect(0, -measures.beam / 2, state.beacon || GLANCE_MM, measures.beam);
    context.restore();
  }

  drawCones({ feel }: State) {
    const { context, palette, scene: { measures } } = this;
    for (const { bit, bearing } of CONES) {
      const middle = (bearing * Math.PI) / 180;
      context.beginPath();
      context.moveTo(0, 0);
      context.arc(0, 0, measures.body + measures.reach, middle - CONE_HALF, middle + CONE_HALF);
      context.closePath();
      context.fillStyle = palette.of[feel & bit ? "cone" : "cone-dark"];
      context.globalAlpha = feel & bit ? 0.9 : 0.55;
      context.fill();
      context.globalAlpha = 1;
      context.strokeStyle = palette.of.floor;
      context.lineWidth = 5;
      context.stroke();
    }
  }

  drawBody(state: State) {
    const { context, palette, scene: { measures: { body, track } } } = this;
    const wheel = { length: 70, width: 24 };
    context.fillStyle = palette.of.ink;
    circle(context, 0, 0, body);
    context.fill();
    context.fillStyle = palette.reasons[this.scene.reasonOf(state)];
    circle(context, 0, 0, body * 0.86);
    context.fill();
    context.fillStyle = palette.of.ink;
    for (const side of [-1, 1]) {
      context.fillRect(-wheel.length / 2, (side * track) / 2 - wheel.width / 2, wheel.length, wheel.width);
    }
    context.beginPath();
    context.moveTo(body * 0.8, 0);
    context.lineTo(body * 0.12, -body * 0.42);
    context.lineTo(body * 0.12, body * 0.42);
    context.closePath();
    context.fill();
  }

  /** Draws the robot's number beside its body; inverted for the robot that the panel shows. */
  drawNumber(state: State) {
    const { context, scene, palette: { of } } = this;
    const { x, y } = scene.poseOf(state);
    const toTheRight = x < scene.measures.width - NUMBER_ROOM_MM;
    const below = y < scene.measures.height - NUMBER_ROOM_MM;
    const at = { x: toTheRight ? NUMBER_MM : -NUMBER_MM, y: below ? NUMBER_MM : -NUMBER_MM };
    const [ground, ink] = state.node === scene.node ? [of.ink, of.paper] : [of.paper, of.ink];
    drawDisc(context, { ...at, radius: 72, ground, edge: of.ink, width: 10 });
    drawText(context, `${state.node}`, { ...at, size: state.node < 10 ? 100 : 80, colour: ink });
  }

  /** Draws a sign above the robot: a question mark during a trial, then whether it helped. */
  drawTrial({ trial, tick, reason, y }: State) {
    const { context, scene, palette } = this;
    if (!trial || (tick - trial.tick) * scene.measures.tick_ms > VERDICT_MS) return;
    const trying = reason === REASON.TRIAL && trial.helped === null;
    if (!trying && trial.helped === null) return;
    const sign = trying ? "?" : trial.helped ? "✓" : "✗";
    const edge = trial.helped ? palette.of.food : palette.reasons[REASON.TRIAL];
    const at = { x: 0, y: y < SIGN_ROOM_MM ? SIGN_MM : -SIGN_MM };
    drawDisc(context, { ...at, radius: 95, ground: palette.of.paper, edge, width: 18 });
    drawText(context, sign, { ...at, size: 130, colour: palette.of.ink });
  }
}
