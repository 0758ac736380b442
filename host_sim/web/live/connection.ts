/* The WebSocket of a live run: connects, and reconnects until the run has ended. */

import type { Command, Message } from "../types.js";

const RECONNECT_MS = 1000;
const GOING_AWAY = 1001;

export class Connection {
  /** Whether messages are ignored, except for the end of the run. */
  isResting = false;
  socket = this.connect();

  /**
   * @param accept - Gets each message.
   * @param onLoss - Called when the connection is lost, with whether the run has ended.
   */
  constructor(readonly accept: (message: Message) => void, readonly onLoss: (hasEnded: boolean) => void) {}

  connect(): WebSocket {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/live`);
    socket.addEventListener("message", ({ data }) => {
      if (socket === this.socket && !this.isResting) this.accept(JSON.parse(data));
    });
    socket.addEventListener("close", ({ code }) => {
      if (socket === this.socket) this.lose(code === GOING_AWAY);
    });
    return socket;
  }

  lose(hasEnded: boolean) {
    const { socket } = this;
    this.onLoss(hasEnded);
    if (!hasEnded) setTimeout(() => socket === this.socket && this.reconnect(), RECONNECT_MS);
  }

  reconnect() {
    this.socket.close();
    this.socket = this.connect();
  }

  /** Receives messages again, beginning with the first one of a new connection. */
  wake() {
    this.isResting = false;
    this.reconnect();
  }

  send(command: Command) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }
}
