// @ts-check
/* The board of a class: how to join, the arena, and how each robot learns. */

import { BoardCurves } from "./board_curves.js";
import { BoardRobots } from "./board_robots.js";
import { made } from "../core/building.js";
import { byId, contextOf, setText, typedById } from "../core/elements.js";
import { ending } from "../core/endings.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { Toast } from "../core/toast.js";
import { Renderer } from "../draw/renderer.js";
import { Scene } from "../draw/scene.js";
import { Connection } from "../live/connection.js";
import { showMessage } from "../live/message_scene.js";
import { showFacts } from "../panel/panel.js";

/**
 * What a board is told besides; see host_sim/live/board_feed.py.
 * @typedef {Object} Class
 * @property {{urls: string[], modules: string[]}} [join]
 * @property {[number, number]} ended
 * @property {{name: string, page: boolean}[] | null} robots
 * @property {import("./board_curves.js").NewSamples} curves
 *
 * @typedef {Message & {board: Class}} BoardMessage
 */

const BORDER = 2;

/** Shows the last message, at most once per screen frame. */
class Board {
  constructor() {
    this.curves = new BoardCurves();
    this.robots = new BoardRobots();
    this.note = new Toast();
    this.renderer = new Renderer(typedById("arena", HTMLCanvasElement));
    this.speed = typedById("speed", HTMLSelectElement);
    /** @type {Scene | undefined} */
    this.scene = undefined;
    /** @type {BoardMessage | undefined} */
    this.message = undefined;
    this.isNew = false;
    this.connection = new Connection(`/board-live${location.search}`, (message) => this.accept(message));
    this.bind();
    setText(byId("status"), say("connecting"));
    inEachLanguage(() => this.drawSoon());
  }

  bind() {
    const on = (/** @type {string} */ id, /** @type {() => Command} */ command) =>
      byId(id).addEventListener("click", () => this.connection.send(command()));
    on("play", () => ({ do: this.runs ? "pause" : "play" }));
    on("next", () => ({ do: "next" }));
    on("again", () => ({ do: "seed", seed: this.scene?.environment.seed ?? 1, keep: 0 }));
    this.speed.addEventListener("change", () => this.connection.send({ do: "speed", factor: Number(this.speed.value) }));
    this.curves.select.addEventListener("change", () => this.drawSoon());
    addEventListener("resize", () => this.drawSoon());
  }

  /** Whether time goes on. */
  get runs() {
    const play = this.message?.play;
    return Boolean(play?.playing && !play.waits);
  }

  /** @param {BoardMessage} message */
  accept(message) {
    const { measures, environment, states, board } = message;
    if (measures && environment) this.scene ??= new Scene(measures, environment, states);
    if (!this.scene) return;
    showMessage(this.scene, message);
    if (measures) document.body.style.setProperty("--ratio", `${(measures.width + 80) / (measures.height + 80)}`);
    if (board.join) showJoin(board.join);
    this.curves.add(board.curves);
    this.message = message;
    message.notes?.forEach((text) => this.note.show(heard(text)));
    this.drawSoon();
  }

  /** Draws with the next frame of the screen. */
  drawSoon() {
    if (!this.isNew) requestAnimationFrame(() => this.draw());
    this.isNew = true;
  }

  draw() {
    const { message, scene, renderer } = this;
    this.isNew = false;
    if (!message || !scene) return;
    const { play, board } = message;
    renderer.useColours();
    const rows = this.rowsOf(scene, board.robots);
    scene.tags = rows.map(({ node, name, colour }) => ({ name: name || `${node}`, colour }));
    renderer.draw(scene);
    this.robots.show(rows);
    this.curves.draw(scene, renderer.palette.robots);
    showFacts(scene);
    setText(byId("present"), board.robots ? presence(board.robots) : say("shared"));
    setText(byId("result"), play.ended ? ending(play.ended, play.done).join(": ") : "");
    setText(byId("fact-finished"), say("ofCount", { count: board.ended[0], all: board.ended[1] }));
    this.showPlay(play, scene.environment);
    this.connection.tell();
  }

  /**
   * @param {Scene} scene
   * @param {Class["robots"]} robots
   * @returns {import("./board_robots.js").Row[]}
   */
  rowsOf({ states }, robots) {
    const colours = this.renderer.palette.robots;
    return states.map(({ node, memory }, i) => {
      const { name, page } = robots?.[i] ?? { name: "", page: true };
      return { node, name, page, memory, colour: colours[i % colours.length], meals: this.curves.last(i, "meals") };
    });
  }

  /**
   * @param {Play} play
   * @param {EnvironmentScene} environment
   */
  showPlay(play, { number, of }) {
    setText(byId("play"), say(play.waits ? "begin" : play.playing ? "pause" : "play"));
    setText(byId("status"), statusOf(play));
    typedById("play", HTMLButtonElement).disabled = play.done;
    typedById("next", HTMLButtonElement).disabled = play.done || number >= of;
    if (document.activeElement !== this.speed) this.speed.value = `${play.speed}`;
  }
}

/** @param {{page: boolean}[]} robots */
function presence(robots) {
  return say("presence", { open: robots.filter(({ page }) => page).length, all: robots.length });
}

/** @param {Play} play */
function statusOf(play) {
  if (play.waits) return say("standStill");
  if (play.done) return say("allDone");
  return say(play.playing ? "live" : "paused");
}

/** @param {{urls: string[], modules: string[]}} join */
function showJoin({ urls, modules }) {
  byId("urls").replaceChildren(...urls.map((url) => {
    const [, home, code] = /^([^/]+\/)([^/]+)$/.exec(url) ?? ["", url, ""];
    return made("li", [home, made("b", [code])]);
  }));
  const canvas = typedById("qr", HTMLCanvasElement);
  canvas.hidden = modules.length === 0;
  canvas.width = canvas.height = modules.length + 2 * BORDER;
  const context = contextOf(canvas);
  context.fillStyle = "white";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = "black";
  modules.forEach((row, y) => [...row].forEach((module, x) => {
    if (module === "1") context.fillRect(x + BORDER, y + BORDER, 1, 1);
  }));
}

if ("WebSocket" in window) Object.assign(window, { octet: new Board() });
else setText(byId("status"), say("needsSocket"));
