/* The live page: what comes over the WebSocket is drawn, what a person does is sent. */

import { Controls } from "./controls.js";
import { Hands } from "./hands.js";
import { Panel, byId } from "./panel.js";
import { Renderer } from "./renderer.js";
import { Trail } from "./trail.js";
import { lessonWords } from "./words.js";

const AGAIN_MS = 1000;
const LESSONS_SHOWN = 30;
const NOTE_MS = 5000;

/** Everything that the page knows of the run; `draw` shows it. */
class LivePage {
  constructor() {
    this.scene = { trail: new Trail() };
    this.renderer = new Renderer(byId("arena"));
    this.panel = new Panel((cell, side) => this.send({ do: "write", cell, side }));
    this.controls = new Controls((order) => this.send(order));
    this.hands = new Hands(this.renderer, this.scene, (order) => this.send(order));
    this.fresh = false;
    this.timing = { drawn: 0, ms: [], lagMs: 0 };
    this.connect();
    requestAnimationFrame(() => this.draw());
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    this.socket = new WebSocket(`${scheme}//${location.host}/live${location.search}`);
    this.socket.addEventListener("message", (event) => this.take(JSON.parse(event.data)));
    this.socket.addEventListener("close", (event) => this.lose(event));
  }

  /** A run that has ended is over; anything else may come back. */
  lose(event) {
    const ended = event.code === 1001;
    byId("status").textContent = ended ? "the run has ended" : "no connection, trying again";
    document.body.classList.add("lost");
    if (!ended) setTimeout(() => this.connect(), AGAIN_MS);
  }

  /** @param {Object} order - As in host_sim/live/orders.py. */
  send(order) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(order));
  }

  /** @param {Object} message - As in host_sim/live/feed.py. */
  take(message) {
    const { scene } = this;
    if (message.measures) this.begin(message.measures);
    if (message.environment) this.enter(message.environment);
    scene.state = message.state;
    scene.play = message.play;
    const trail = message.trail;
    for (let i = 0; i < trail.length; i += 3) scene.trail.add(trail[i], trail[i + 1], trail[i + 2]);
    message.lessons.forEach(addLesson);
    message.notes?.forEach(showNote);
    this.health = message.health;
    this.at = message.at;
    this.fresh = true;
  }

  begin(measures) {
    this.scene.measures = measures;
    this.scene.environment = undefined;
    byId("lessons").replaceChildren();
    document.body.classList.remove("lost");
  }

  enter(environment) {
    const before = this.scene.environment;
    if (before?.number !== environment.number || before.seed !== environment.seed) this.scene.trail.clear();
    this.scene.environment = environment;
    this.hands.recheck();
  }

  draw() {
    if ((this.fresh || this.hands.moved) && this.scene.state && this.scene.environment) {
      const began = performance.now();
      this.fresh = this.hands.moved = false;
      this.hands.follow(this.scene.state);
      this.renderer.draw(this.scene);
      this.panel.show(this.scene, { exact: !this.scene.play.playing });
      this.controls.show(this.scene);
      this.showHealth();
      this.time(performance.now() - began);
    }
    requestAnimationFrame(() => this.draw());
  }

  showHealth() {
    for (const [name, count] of Object.entries(this.health)) this.panel.write(`health-${name}`, `${count}`);
  }

  /** Keeps the last drawing times, and how old the state was, for whoever asks: `octet.timing`. */
  time(ms) {
    this.timing.drawn += 1;
    this.timing.lagMs = Date.now() - this.at;
    this.timing.ms[this.timing.drawn % 1000] = ms;
  }
}

function addLesson(lesson) {
  const list = byId("lessons");
  const item = document.createElement("li");
  item.textContent = lessonWords(lesson);
  list.prepend(item);
  while (list.children.length > LESSONS_SHOWN) list.lastChild.remove();
}

function showNote(text) {
  const note = byId("note");
  note.textContent = text;
  clearTimeout(note.timer);
  note.timer = setTimeout(() => (note.textContent = ""), NOTE_MS);
}

if ("WebSocket" in window) window.octet = new LivePage();
else byId("status").textContent = "This browser has no WebSocket: take a newer one, or open replay.html later.";
