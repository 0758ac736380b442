/* Draws the robot: body, wheels, heading, the five cones, the look ahead, and what it tries. */

import { REASON } from "./reasons.js";

/** The bearing of each cone's middle in degrees, to the right of the heading, by its bit of feel. */
const CONES = [[1, 90], [2, 45], [4, 0], [8, -45], [16, -90]];
const CONE_HALF = Math.PI / 8;
const GLANCE_MM = 700;
const VERDICT_MS = 1200;
const SIGN_MM = 290;
const SIGN_ROOM_MM = 400;

/**
 * @param {CanvasRenderingContext2D} context - In mm.
 * @param {import("./renderer.js").Scene} scene
 * @param {import("./palette.js").Palette} palette
 */
export function drawRobot(context, scene, palette) {
  const { state, measures, ghost, selected } = scene;
  context.save();
  context.translate(ghost?.x ?? state.x, ghost?.y ?? state.y);
  context.save();
  context.rotate((ghost?.heading ?? state.heading) / 1000);
  if (state.lifted || ghost) drawAir(context, measures, palette);
  else drawCones(context, state.feel, measures, palette);
  if (selected?.kind === "robot") drawRing(context, measures.body * 1.12, palette.of.select);
  drawBody(context, state, measures, palette);
  context.restore();
  drawTrial(context, scene, palette);
  context.restore();
}

/** A wide broken ring says that it is off the floor. */
function drawAir(context, measures, palette) {
  context.setLineDash([40, 30]);
  drawRing(context, measures.body * 1.45, palette.of.select);
  context.setLineDash([]);
}

function drawRing(context, radius, colour) {
  context.strokeStyle = colour;
  context.lineWidth = 16;
  circle(context, 0, 0, radius);
  context.stroke();
}

/** The corridor in which the robot sees food, lit as far as the food that it sees; obstacles go over it. */
export function drawLook(context, { state, measures, ghost }, palette) {
  if (state.lifted || ghost) return;
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

function drawCones(context, feel, measures, palette) {
  for (const [bit, bearing] of CONES) {
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

function drawBody(context, state, measures, palette) {
  const wheel = { length: 70, width: 24 };
  context.fillStyle = palette.of.ink;
  circle(context, 0, 0, measures.body);
  context.fill();
  context.fillStyle = palette.reasons[state.reason];
  circle(context, 0, 0, measures.body * 0.86);
  context.fill();
  context.fillStyle = palette.of.ink;
  for (const side of [-1, 1]) {
    context.fillRect(-wheel.length / 2, (side * measures.track) / 2 - wheel.width / 2, wheel.length, wheel.width);
  }
  drawNose(context, measures.body, palette);
}

function drawNose(context, body, palette) {
  context.fillStyle = palette.of.ink;
  context.beginPath();
  context.moveTo(body * 0.8, 0);
  context.lineTo(body * 0.12, -body * 0.42);
  context.lineTo(body * 0.12, body * 0.42);
  context.closePath();
  context.fill();
}

/** A sign above the robot: a question while it tries something, then whether it helped. */
function drawTrial(context, scene, palette) {
  const { state, measures } = scene;
  const trial = state.trial;
  if (!trial || (state.tick - trial.tick) * measures.tick_ms > VERDICT_MS) return;
  const trying = state.reason === REASON.trial && trial.helped === null;
  if (!trying && trial.helped === null) return;
  const sign = trying ? "?" : trial.helped ? "✓" : "✗";
  const colour = trial.helped === 1 ? palette.of.food : palette.reasons[REASON.trial];
  drawSign(context, { sign, colour, y: state.y < SIGN_ROOM_MM ? SIGN_MM : -SIGN_MM }, palette);
}

function drawSign(context, { sign, colour, y }, palette) {
  circle(context, 0, y, 95);
  context.fillStyle = palette.of.paper;
  context.fill();
  context.strokeStyle = colour;
  context.lineWidth = 18;
  context.stroke();
  context.fillStyle = palette.of.ink;
  context.font = "bold 130px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(sign, 0, y + 8);
}

/** Begins a path that is one circle. */
export function circle(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}
