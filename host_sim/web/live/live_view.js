// @ts-check
/* What the live page shows, and what a person can do there. */

import { ArenaEditor } from "../edit/arena_editor.js";
import { bindArenaKeys } from "../edit/arena_keys.js";
import { Controls } from "./controls.js";
import { DragController } from "../edit/drag_controller.js";
import { byId, setText, typedById } from "../core/elements.js";
import { LessonsView } from "../panel/lessons_view.js";
import { Panel } from "../panel/panel.js";
import { Renderer } from "../draw/renderer.js";
import { RobotPicker } from "../panel/robot_picker.js";
import { Scene } from "../draw/scene.js";

/**
 * @typedef {import("../types.js").Command} Command
 * @typedef {import("../types.js").EnvironmentScene} EnvironmentScene
 * @typedef {import("../types.js").Lesson} Lesson
 * @typedef {import("../types.js").Message} Message
 */

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
    this.renderer = new Renderer(typedById("arena", HTMLCanvasElement));
    this.editor = new ArenaEditor(scene, send, onChange);
    this.drag = new DragController(this.renderer, this.editor);
    this.panel = new Panel((cell, side) => send({ do: "write", node: scene.node, cell, side }));
    this.controls = new Controls(send);
    this.picker = new RobotPicker(scene, (node) => this.editor.pick(node));
    this.lessonsView = new LessonsView();
    /**
     * The last lessons of each robot, by node.
     * @type {Map<number, Lesson[]>}
     */
    this.lessons = new Map();
    bindArenaKeys(this.renderer.canvas, this.editor);
  }

  /** @param {Message} message */
  accept({ measures, environment, states, trails, lessons, news }) {
    const { scene } = this;
    if (measures && environment) this.restart(new Scene(measures, environment, states));
    if (environment) this.enter(environment);
    scene.states = states;
    scene.news = news ?? scene.news;
    trails.forEach((points, i) => {
      for (let at = 0; at < points.length; at += 3) scene.trails[i].add(points[at], points[at + 1], points[at + 2]);
    });
    for (const lesson of lessons) this.addLesson(lesson);
  }

  /**
   * The page has connected again: nothing of before holds, but for the robot that is selected.
   * @param {Scene} scene
   */
  restart(scene) {
    const { node } = this.scene;
    Object.assign(this.scene, scene);
    if (scene.states.some((state) => state.node === node)) this.scene.node = node;
    this.lessons.clear();
  }

  /** @param {EnvironmentScene} environment */
  enter(environment) {
    const { scene } = this;
    const before = scene.environment;
    const isNew = before.number !== environment.number || before.seed !== environment.seed;
    if (isNew) scene.trails.forEach((trail) => trail.clear());
    if (before.start_tick !== environment.start_tick) this.lessons.clear();
    scene.environment = environment;
    this.editor.onEnvironment();
  }

  /** @param {Lesson} lesson */
  addLesson(lesson) {
    const lessons = this.lessons.get(lesson.node) ?? [];
    this.lessons.set(lesson.node, [...lessons, lesson].slice(-LESSONS_SHOWN));
  }

  /** @param {Message} message - The last one. */
  draw({ play, health }) {
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
  }
}
