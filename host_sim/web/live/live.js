// @ts-check
/* The live page: shows what arrives over the WebSocket and sends what a person does. */

import { byId, setText } from "../core/elements.js";
import { restarted } from "../core/endings.js";
import { heard, inEachLanguage, say } from "../core/language.js";
import { Connection } from "./connection.js";
import { LiveView } from "./live_view.js";
import { Toast } from "../core/toast.js";
import { Scene } from "../draw/scene.js";
import { TalkBox } from "../talk/talk_box.js";

/** Draws at most once per screen frame. */
class LivePage {
  constructor() {
    /** @type {LiveView | undefined} */
    this.view = undefined;
    /** @type {Message | undefined} - The last message. */
    this.message = undefined;
    this.isNew = false;
    /** How old the state was when it was last drawn, for measurements. */
    this.timing = { lagMs: 0 };
    this.note = new Toast();
    this.talk = new TalkBox(byId("talk"), this);
    this.connection = new Connection("/live", (message) => this.accept(message));
    setText(byId("status"), say("connecting"));
    setText(byId("doing"), say("waitingRobot"));
    inEachLanguage(() => this.drawSoon());
  }

  get scene() {
    return this.view?.scene;
  }

  get play() {
    return this.message?.play;
  }

  /** @param {Command} command */
  send(command) {
    this.connection.send(command);
  }

  /**
   * @param {string} who
   * @param {string} text
   */
  ask(who, text) {
    this.send({ do: "ask", who, text, node: this.scene?.node ?? 1 });
  }

  lightUp() {
    this.drawSoon();
  }

  /** @param {Message} message */
  accept(message) {
    const { measures, environment, states } = message;
    const startedOver = !measures && environment && environment.start_tick !== this.scene?.environment.start_tick;
    if (measures && environment) {
      const scene = new Scene(measures, environment, states);
      this.view ??= new LiveView(scene, (command) => this.send(command), () => this.drawSoon());
    }
    this.view?.accept(message);
    if (startedOver) this.note.show(restarted(environment, states));
    if (message.notes) this.view?.editor.onRefusal();
    message.notes?.forEach((text) => this.note.show(heard(text)));
    message.answers?.forEach(({ places, ...exchange }) => this.talk.answer(exchange, places));
    this.message = message;
    this.drawSoon();
  }

  /** Draws with the next frame of the screen. */
  drawSoon() {
    if (this.isNew) return;
    this.isNew = true;
    requestAnimationFrame(() => this.draw());
  }

  draw() {
    const { view, message } = this;
    this.isNew = false;
    if (!view || !message) return;
    view.draw(message);
    this.connection.tell();
    this.timing.lagMs = Date.now() - message.at;
  }
}

if ("WebSocket" in window) Object.assign(window, { octet: new LivePage() });
else setText(byId("status"), say("needsSocket"));
