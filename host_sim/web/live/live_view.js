// @ts-check
/* What the live page shows, and what a person can do there. */

import { Scene } from "../draw/scene.js";
import { ArenaEditor } from "../edit/arena_editor.js";
import { bindArenaKeys } from "../edit/arena_keys.js";
import { Controls } from "./controls.js";
import { DragController } from "../edit/drag_controller.js";
import { byId, setText, typedById } from "../core/elements.js";
import { FaultMenu } from "../panel/fault_menu.js";
import { Viewport } from "../draw/viewport.js";
import { LessonsView } from "../panel/lessons_view.js";
import { Panel } from "../panel/panel.js";
import { Renderer } from "../draw/renderer.js";
import { RobotPicker } from "../panel/robot_picker.js";
import { robotWords, say } from "../core/language.js";

const LESSONS_SHOWN = 30;

/** A message changes its scene, `draw` shows it. */
export class LiveView {
  /**
   * @param {Scene} scene
   * @param {(command: Command) => void} send
   * @param {() => void} onChange - Called when a person has changed what is to be drawn.
   */
  constructor(scene, send, onChange) {
    this.scene = scene;
    this.renderer = new Renderer(typedById("arena", HTMLCanvasElement), new Viewport(onChange));
    this.editor = new ArenaEditor(scene, send, onChange);
    this.drag = new DragController(this.renderer, this.editor);
    this.panel = new Panel((cell, side) => send({ do: "write", node: scene.node, cell, side }));
    this.controls = new Controls(send);
    this.picker = new RobotPicker(scene, (node) => this.editor.pick(node));
    this.lessonsView = new LessonsView();
    this.faults = new FaultMenu((what) => {
      const { index, environment } = scene;
      send({ do: "body", what, robot: index, seed: environment.seed });
    });
    /** @type {Map<number, Lesson[]>} - The last lessons of each robot, by node. */
    this.lessons = new Map();
    bindArenaKeys(this.renderer.canvas, this.editor);
  }

  /** @param {Message} message */
  accept(message) {
    const before = this.scene.environment.start_tick;
    showMessage(this.scene, message);
    if (message.measures || this.scene.environment.start_tick !== before) this.lessons.clear();
    if (message.environment) this.editor.onEnvironment();
    for (const lesson of message.lessons) this.addLesson(lesson);
  }

  /** @param {Lesson} lesson */
  addLesson(lesson) {
    const lessons = this.lessons.get(lesson.node) ?? [];
    this.lessons.set(lesson.node, [...lessons, lesson].slice(-LESSONS_SHOWN));
  }

  /** @param {Message} message - The last one. */
  draw({ play, health, pins }) {
    const { scene } = this;
    this.editor.onStates(this.drag.robot);
    this.panel.settle(scene, !play.playing);
    this.renderer.draw(scene);
    this.panel.show(scene, { exact: !play.playing });
    this.controls.show(scene, play);
    this.picker.show();
    setText(byId("news"), scene.lastNews);
    this.lessonsView.show(scene, this.lessons.get(scene.node) ?? []);
    for (const [name, count] of Object.entries(health)) setText(byId(`health-${name}`), `${count}`);
    byId("on-pins").hidden = pins.length === 0;
    setText(byId("pins"), pins.map(pinsText).join("; "));
  }
}

/** @param {import("../types.js").PinFigures} figures */
function pinsText({ volts, counts, duty }) {
  const said = `${volts}`.replace(".", robotWords().point);
  return say("pins", { volts: said, counts: counts.join(", "), duty: duty.join(", ") });
}

/**
 * Fills a scene with a message of a live run.
 * @param {Scene} scene
 * @param {Message} message
 */
function showMessage(scene, { measures, environment, states, trails, news }) {
  if (measures && environment) restart(scene, new Scene(measures, environment, states));
  if (environment) enter(scene, environment);
  scene.states = states;
  scene.news = news ?? scene.news;
  trails.forEach((points, i) => {
    for (let at = 0; at < points.length; at += 3) scene.trails[i].add(points[at], points[at + 1], points[at + 2]);
  });
}

/**
 * The page has connected again: nothing of before holds, but for the robot that is selected.
 * @param {Scene} scene
 * @param {Scene} anew
 */
function restart(scene, anew) {
  const { node } = scene;
  Object.assign(scene, anew);
  if (scene.states.some((state) => state.node === node)) scene.node = node;
}

/**
 * @param {Scene} scene
 * @param {EnvironmentScene} environment
 */
function enter(scene, environment) {
  if (environment.first_tick !== scene.environment.first_tick) scene.trails.forEach((trail) => trail.clear());
  scene.environment = environment;
}
