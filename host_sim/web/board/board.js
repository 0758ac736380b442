// @ts-check
/* The board of a class: how to join, how the run stands, and how each robot learns. */

import { BoardCurves } from "./board_curves.js";
import { BoardRobots } from "./board_robots.js";
import { byId, contextOf, setText, typedById } from "../core/elements.js";
import { Toast } from "../core/toast.js";
import { ending } from "../core/phrases.js";

/**
 * @typedef {import("../types.js").Command} Command
 * @typedef {import("../types.js").Play} Play
 *
 * What the board receives from host_sim/live/board_feed.py.
 * @typedef {Object} BoardMessage
 * @property {{urls: string[], modules: string[]}} [join]
 * @property {number} tick_ms
 * @property {number} clock_ms
 * @property {[number, number]} environment
 * @property {[number, number]} ended
 * @property {[number, number]} food
 * @property {number} seed
 * @property {Play} play
 * @property {import("./board_robots.js").BoardRobot[]} robots
 * @property {import("./board_curves.js").NewSamples} curves
 * @property {string[]} [notes]
 */

const RECONNECT_MS = 1000;
const BORDER = 2;

/** Connects, and connects again. */
class Board {
  constructor() {
    this.curves = new BoardCurves();
    this.robots = new BoardRobots();
    this.note = new Toast();
    this.curve = typedById("curve", HTMLSelectElement);
    this.speed = typedById("speed", HTMLSelectElement);
    /** @type {BoardMessage | undefined} */
    this.message = undefined;
    this.bind();
    this.socket = this.connect();
  }

  bind() {
    const on = (/** @type {string} */ id, /** @type {() => Command} */ command) =>
      byId(id).addEventListener("click", () => this.send(command()));
    on("play", () => ({ do: this.runs ? "pause" : "play" }));
    on("next", () => ({ do: "next" }));
    on("again", () => ({ do: "seed", seed: this.message?.seed ?? 1, keep: 0 }));
    this.speed.addEventListener("change", () => this.send({ do: "speed", factor: Number(this.speed.value) }));
    this.curve.addEventListener("change", () => this.show());
  }

  /** Whether time goes on. */
  get runs() {
    const play = this.message?.play;
    return Boolean(play?.playing && !play.waits);
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/board-live${location.search}`);
    socket.addEventListener("message", (event) => this.accept(JSON.parse(event.data)));
    socket.addEventListener("close", () => {
      setText(byId("status"), "no connection, trying again");
      document.body.classList.add("lost");
      setTimeout(() => (this.socket = this.connect()), RECONNECT_MS);
    });
    return socket;
  }

  /** @param {Command} command */
  send(command) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  /** @param {BoardMessage} message */
  accept(message) {
    document.body.classList.remove("lost");
    if (message.join) showJoin(message.join);
    this.curves.add(message.curves);
    this.message = message;
    message.notes?.forEach((text) => this.note.show(text));
    this.show();
  }

  show() {
    const { message } = this;
    if (!message) return;
    const { environment, food, seed, play, robots, tick_ms, clock_ms } = message;
    const curve = /** @type {import("./board_curves.js").CurveName} */ (this.curve.value);
    const own = robots.length > 1;
    this.robots.show(robots, this.curves, { curve, tickMs: tick_ms, own });
    setText(byId("fact-environment"), `${environment[0]} of ${environment[1]}`);
    setText(byId("fact-food"), `${food[1] - food[0]} of ${food[1]}`);
    setText(byId("fact-time"), clockOf(clock_ms));
    setText(byId("fact-seed"), `${seed}`);
    setText(byId("present"), own ? presence(robots) : "All pages share one robot.");
    setText(byId("scale"), `Each curve grows with robot time; all have the same scale.`);
    setText(byId("result"), resultOf(message));
    this.showPlay(play, environment);
  }

  /**
   * @param {Play} play
   * @param {[number, number]} environment
   */
  showPlay(play, environment) {
    setText(byId("play"), play.waits ? "Begin" : play.playing ? "Pause" : "Play");
    setText(byId("status"), statusOf(play));
    typedById("play", HTMLButtonElement).disabled = play.done;
    typedById("next", HTMLButtonElement).disabled = play.done || environment[0] >= environment[1];
    if (document.activeElement !== this.speed) this.speed.value = `${play.speed}`;
  }
}

/** @param {import("./board_robots.js").BoardRobot[]} robots */
function presence(robots) {
  const open = robots.filter(({ page }) => page).length;
  return `${open} of ${robots.length} robots have a page.`;
}

/**
 * How the environment has ended or, while it goes on, how those before it did.
 * @param {BoardMessage} message
 */
function resultOf({ play, ended: [finished, all] }) {
  if (play.ended) return ending(play.ended, play.done).join(": ");
  return all ? `All food found in ${finished} of ${all} environments so far` : "";
}

/** @param {Play} play */
function statusOf(play) {
  if (play.waits) return "the robots stand still until you press Begin";
  if (play.done) return "all done";
  return play.playing ? "live" : "paused";
}

/** @param {number} ms */
function clockOf(ms) {
  const seconds = Math.floor(ms / 1000);
  return `${Math.floor(seconds / 60)}:${`${seconds % 60}`.padStart(2, "0")}`;
}

/** @param {{urls: string[], modules: string[]}} join */
function showJoin({ urls, modules }) {
  byId("urls").replaceChildren(...urls.map((url) => {
    const item = document.createElement("li");
    item.textContent = url;
    return item;
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
else setText(byId("status"), "This browser has no WebSocket: take a newer one.");
