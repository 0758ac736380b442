/* A live run as far as a page knows it: its WebSocket, its present, and what its robots have just learned. */

import { RunData } from "../core/run_data.js";
import type { RobotData } from "../core/run_data.js";
import type { Trail } from "../draw/trail.js";
import type { State } from "../generated_types.js";
import type { Command, Message, RobotRun } from "../types.js";

const LESSONS_SHOWN = 30;
const MEMORIES_KEPT = 1000;

/** A run of which only the last tick is known; each message replaces it. */
export class LiveRun extends RunData {
  /** The events of each robot so far. */
  events: RobotRun["events"][] = [];

  /** @param message - The first one. */
  constructor(public message: Message) {
    const { measures, environment, states } = message;
    if (!measures || !environment) throw new Error("the first message of a live run has its world");
    const robots = states.map(({ node, memory }) => ({
      node, memory: [[0, memory]] as [number, number[]][], trials: [], lessons: [], cells: [], events: [], columns: [], data: "",
    }));
    super({
      version: 0, title: "", measures, first_tick: 0, ticks: 1, shown: states[0].tick, scenes: [[0, environment]], eaten: [], robots,
    }, states.map(() => ({})));
    this.accept(message);
  }

  accept(message: Message) {
    const { measures, environment, states, lessons, events, news } = message;
    const { run, robots } = this;
    this.events = events.map((more, i) => (measures ? more : this.events[i].concat(more)));
    this.message = message;
    this.last = states[0].tick;
    if (environment) run.scenes[0][1] = environment;
    run.news = news ?? run.news;
    robots.forEach((robot, i) => {
      const { node, lessons: known } = robot.run;
      robot.run.lessons = [...(measures ? [] : known), ...lessons.filter((lesson) => lesson.node === node)].slice(-LESSONS_SHOWN);
      keepState(robot, states[i]);
    });
  }

  override eventsOf(robot: number) {
    return this.events[robot];
  }

  override statesAt() {
    return this.message.states;
  }

  /** Adds the points of the last message, once. */
  override addTrails(trails: Trail[]) {
    this.message.trails.forEach((points, robot) => {
      for (let i = 0; i < points.length; i += 3) trails[robot].add(points[i], points[i + 1], points[i + 2]);
    });
    this.message.trails = [];
  }
}

/** Keeps only the present in the columns; their tick is the one in which the current action began. */
function keepState(robot: RobotData, { tick, action, pattern, reason, memory }: State) {
  if (robot.columns.action?.[0] !== action) robot.first = tick;
  robot.columns = { action: Int32Array.of(action), pattern: Int32Array.of(pattern), reason: Int32Array.of(reason) };
  const memories = robot.run.memory;
  if (`${memories[memories.length - 1][1]}` !== `${memory}`) memories.push([tick, memory]);
  memories.splice(1, memories.length - MEMORIES_KEPT);
}

const RECONNECT_MS = 1000;
const GOING_AWAY = 1001;

/** The WebSocket of a live run: connects, and reconnects until the run has ended. */
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
