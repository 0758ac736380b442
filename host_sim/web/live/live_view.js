// @ts-check
/* What the live page shows, and what a person can do there. */

import { ArenaEditor } from "../edit/arena_editor.js";
import { bindArenaKeys } from "../edit/arena_keys.js";
import { Controls } from "./controls.js";
import { DragController } from "../edit/drag_controller.js";
import { byId, setText, typedById } from "../core/elements.js";
import { Lens } from "../draw/lens.js";
import { LessonsView } from "../panel/lessons_view.js";
import { Panel } from "../panel/panel.js";
import { Renderer } from "../draw/renderer.js";
import { RobotPicker } from "../panel/robot_picker.js";
import { robotWords, say } from "../core/language.js";
import { showMessage } from "./message_scene.js";

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
    this.renderer = new Renderer(typedById("arena", HTMLCanvasElement), new Lens(onChange));
    this.editor = new ArenaEditor(scene, send, onChange);
    this.drag = new DragController(this.renderer, this.editor);
    this.panel = new Panel((cell, side) => send({ do: "write", node: scene.node, cell, side }));
    this.controls = new Controls(send);
    this.picker = new RobotPicker(scene, (node) => this.editor.pick(node));
    this.lessonsView = new LessonsView();
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
