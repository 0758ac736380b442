// @ts-check
/* The live page: shows what comes over the WebSocket, sends what a person does. */

import { byId, setText } from "./elements.js";
import { LiveView } from "./live_view.js";
import { Scene } from "./scene.js";

/**
 * @typedef {import("./types.js").Command} Command
 * @typedef {import("./types.js").Message} Message
 */

const RECONNECT_MS = 1000;
const NOTE_MS = 5000;
const GOING_AWAY = 1001;

/** Connects, and connects again; draws at most once a frame of the screen. */
class LivePage {
  constructor() {
    /** @type {LiveView | undefined} */
    this.view = undefined;
    /**
     * The last message.
     * @type {Message | undefined}
     */
    this.message = undefined;
    this.isNew = false;
    /** How old the state was when it was last drawn, for measurements. */
    this.timing = { lagMs: 0 };
    this.note = new Note();
    this.socket = this.connect();
    requestAnimationFrame(() => this.frame());
  }

  get scene() {
    return this.view?.scene;
  }

  get play() {
    return this.message?.play;
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/live${location.search}`);
    socket.addEventListener("message", (event) => this.accept(JSON.parse(event.data)));
    socket.addEventListener("close", (event) => this.onClose(event));
    return socket;
  }

  /**
   * A run that has ended is over; anything else may come back.
   * @param {CloseEvent} event
   */
  onClose(event) {
    const ended = event.code === GOING_AWAY;
    setText(byId("status"), ended ? "the run has ended" : "no connection, trying again");
    document.body.classList.add("lost");
    if (!ended) setTimeout(() => (this.socket = this.connect()), RECONNECT_MS);
  }

  /** @param {Command} command */
  send(command) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  /** @param {Message} message */
  accept(message) {
    const { measures, environment, states } = message;
    if (measures) document.body.classList.remove("lost");
    if (measures && environment) {
      this.view ??= new LiveView(new Scene(measures, environment, states), (command) => this.send(command));
    }
    this.view?.accept(message);
    message.notes?.forEach((text) => this.note.show(text));
    this.message = message;
    this.isNew = true;
  }

  frame() {
    const { view, message } = this;
    if (view && message && (this.isNew || view.editor.changed)) {
      this.isNew = false;
      view.draw(message);
      this.timing.lagMs = Date.now() - message.at;
    }
    requestAnimationFrame(() => this.frame());
  }
}

/** Tells a person for a while what could not be done. */
class Note {
  constructor() {
    this.timer = 0;
  }

  /** @param {string} text */
  show(text) {
    setText(byId("note"), text);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => setText(byId("note"), ""), NOTE_MS);
  }
}

if ("WebSocket" in window) Object.assign(window, { octet: new LivePage() });
else setText(byId("status"), "This browser has no WebSocket: take a newer one, or open replay.html later.");
