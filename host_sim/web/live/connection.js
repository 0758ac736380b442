// @ts-check
/* The WebSocket of a live run: connects, and reconnects. */

import { byId, setText } from "../core/elements.js";
import { say } from "../core/language.js";
import { hideToken } from "../core/storage.js";

const RECONNECT_MS = 1000;
const GOING_AWAY = 1001;
const RECORDED = "/recorded";

/**
 * Shows the run so far as a recorded one.
 * @param {string} how - What to do there: a query for `followAddress` in replay/replay.js.
 */
export function lookBack(how) {
  location.assign(`${RECORDED}#${how}`);
}

/** Shows a lost connection in the element `status`; the next run may use the same address. */
export class Connection {
  /**
   * @param {string} path - The address, with its query, and without the page's token.
   * @param {(message: any) => void} accept - Gets each message.
   */
  constructor(path, accept) {
    hideToken();
    this.path = path;
    this.accept = accept;
    this.hasEnded = false;
    this.socket = this.connect();
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}${this.path}`);
    socket.addEventListener("message", (event) => this.onMessage(event.data));
    socket.addEventListener("close", (event) => this.onClose(event));
    return socket;
  }

  /** @param {string} text */
  onMessage(text) {
    this.hasEnded = false;
    document.body.classList.remove("lost");
    this.accept(JSON.parse(text));
  }

  /** @param {CloseEvent} event */
  onClose(event) {
    this.hasEnded ||= event.code === GOING_AWAY;
    document.body.classList.add("lost");
    this.tell();
    if (event.code === GOING_AWAY) this.becomeRecorded();
    setTimeout(() => (this.socket = this.connect()), RECONNECT_MS);
  }

  /** The run has ended: the page becomes that of the recorded run, if the server still has it. */
  async becomeRecorded() {
    const { ok } = await fetch(RECORDED, { method: "HEAD" }).catch(() => ({ ok: false }));
    if (ok) location.replace(`${RECORDED}#ended`);
  }

  /** Says that the connection is lost, if it is. */
  tell() {
    if (!document.body.classList.contains("lost")) return;
    setText(byId("status"), say(this.hasEnded ? "runEnded" : "noConnection"));
  }

  /** @param {Command} command */
  send(command) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }
}
