/* The page of a live run: shows what arrives over the WebSocket, and sends what a person does. What needs the whole run
   is done in the recording of the run so far, which takes the place of the live run until a person goes back. */

import { byId, setText, typedById } from "../core/dom.js";
import { heard, inEachLanguage, nameIn, robotWords, say } from "../core/language.js";
import { decimal, minutes } from "../core/phrases.js";
import { RunData } from "../core/run_data.js";
import { hideToken } from "../core/storage.js";
import { SIDE } from "../generated.js";
import { LabPage, withhold } from "../lab/lab_page.js";
import { Connection, LiveRun } from "./live_run.js";
import type { EnvironmentScene, State } from "../generated_types.js";
import type { Parts } from "../lab/laboratory.js";
import type { ShownRun } from "../lab/shown_run.js";
import type { Change, Command, Ended, Experiment, Message, PinFigures, Play } from "../types.js";

/** The changes that its log cannot have: they are made in a copy. */
const IN_COPY = ["set", "start"];
/** What the run is asked for to get to the next event of a kind. */
const NEXT: Record<string, Command | undefined> = { decision: { do: "decision" }, environment: { do: "next" } };
/** The controls without effect once the run is over. */
const NEEDS_A_RUN = ["play", "lift", "add-bar", "add-plant", "break"];

/** Shows the live run, or the recording of it so far, and copies of that. */
class LivePage extends LabPage {
  /** The experiment of the first run, as far as it is known. */
  experiment = this.lane.experiment;
  /** Whether the run has ended, and whether its server is out of reach. */
  hasEnded = false;
  isLost = false;
  /** What repeats the recording. */
  repeats: Pick<Parts, "why" | "recorded"> = {};
  /** Settled when the recording is here; undefined unless it is being fetched. */
  past: Promise<void> | undefined;
  /** The tick of the recording to show. */
  wanted: number | undefined;
  /** How many events were marked, and the last tick then; later the marks are closer together. */
  marked = [0, 0];
  speed = typedById("speed", HTMLSelectElement);

  constructor(parts: Parts, readonly connection: Connection, live: LiveRun) {
    super(parts, live);
    this.speed.addEventListener("change", () => {
      this.send({ do: "speed", factor: Number(this.speed.value) });
      this.speed.blur();
    });
    typedById("kind", HTMLSelectElement).value = "decision";
    withhold("#copy-link, #show-link-code", () => say("noLink"), this.note);
    this.proposeSeed();
    inEachLanguage(() => this.showStatus());
  }

  /** The live run, while it is shown. */
  get live() {
    const data = this.lanes?.[0]?.data;
    return data instanceof LiveRun ? data : undefined;
  }

  /** How the live run stands. */
  get play() {
    return this.live?.message.play;
  }

  send(command: Command) {
    if (this.live) this.connection.send(command);
  }

  accept(message: Message) {
    if (!this.live) this.comeBack(new LiveRun(message));
    const { live, lane, scene } = this;
    if (!live || !scene) return;
    const { start_tick } = scene.environment;
    const isNew = Boolean(message.measures);
    if (live.message !== message) {
      live.accept(message);
      lane.go(live.last, isNew);
    }
    this.isLost = false;
    this.playing = message.play.playing;
    scene.news = live.run.news ?? [];
    super.go(live.last);
    if (message.environment) this.editor?.onEnvironment();
    if (isNew || scene.environment.start_tick !== start_tick) this.proposeSeed();
    if (scene.environment.start_tick !== start_tick) this.note.show(restarted(scene.environment, scene.states));
    if (message.notes) this.onRefusal();
    message.notes?.forEach((text) => this.note.show(heard(text)));
    message.answers?.forEach(({ places, ...exchange }) => this.talk.answer(exchange, places));
  }

  /** Shows the live run again. */
  comeBack(live: LiveRun) {
    const node = this.scene?.node;
    this.first = live.first;
    this.scrub.min = `${live.first}`;
    this.begin(this.experiment, live);
    if (node !== undefined) this.pick(node);
  }

  lose(hasEnded: boolean) {
    this.isLost = !this.connection.isResting;
    this.hasEnded = hasEnded;
    this.onLanes();
    this.showStatus();
    if (hasEnded) this.lookBack().catch(() => {}); // then the status says that it has ended
  }

  proposeSeed() {
    const field = typedById("seed", HTMLInputElement);
    if (document.activeElement !== field) field.value = `${(this.scene?.environment.seed ?? 0) + 1}`;
  }

  /** Replaces the live run, or an earlier recording, by the recording of the run so far. */
  lookBack() {
    return (this.past ??= this.fetchPast().finally(() => (this.past = this.wanted = undefined)));
  }

  async fetchPast() {
    const answer = await fetch("/recorded").catch(() => undefined);
    if (!answer?.ok) throw new Error(say(answer ? "waitingRobot" : "noConnection"));
    const { run, parts } = await answer.json();
    const data = await RunData.from(run);
    const { live, tick } = this;
    const lane = live ? this.lane : this.lanes.find(({ isRecorded }) => isRecorded);
    this.recorded = data;
    this.repeats = parts;
    if (lane) {
      lane.keep(data);
      this.canChange(lane);
    }
    if (live) this.leave();
    this.go(this.wanted ?? (live ? this.last : tick));
    this.onScene();
    this.onLanes();
    this.showStatus();
  }

  /** @param lane - Has the recording; prepares changes in a copy of it. */
  canChange(lane: ShownRun) {
    this.first = lane.data?.first ?? 0;
    this.scrub.min = `${this.first}`;
    this.recalled = this.recall(this.repeats, lane);
    this.recalled.catch(() => {});
  }

  /** The live run is not shown any more. */
  leave() {
    this.connection.isResting = true;
    this.isLost = false;
    super.setPlaying(false);
    if (!Number(this.speed.value)) this.speed.value = "1";
    for (const id of NEEDS_A_RUN) typedById(id, HTMLButtonElement).disabled = false;
    setText(byId("banner"), "");
    this.onLanes();
    this.showStatus();
  }

  override async whole() {
    if (this.live) await this.lookBack();
    await super.whole();
  }

  override begin(experiment: Experiment, recorded?: RunData) {
    const wasLive = this.live;
    super.begin(experiment, recorded);
    if (wasLive && !recorded) this.leave();
  }

  /** Starts over with another seed. */
  override renew(experiment: Experiment) {
    const keep = Number(typedById("keep", HTMLInputElement).checked);
    if (this.live) this.send({ do: "seed", seed: experiment.seed, keep });
    else super.renew(experiment);
  }

  override goBack() {
    if (!this.hasEnded) return this.connection.wake();
    this.begin(this.experiment, this.recorded);
    this.canChange(this.lane);
    this.go(this.last);
  }

  override get isAway() {
    return this.hasEnded ? super.isAway : !this.live;
  }

  override onLanes() {
    const key = this.hasEnded ? "backToRun" : "backToLive";
    byId("back").dataset.say = key;
    setText(byId("back"), say(key));
    document.body.classList.toggle("live", this.live !== undefined);
    super.onLanes();
  }

  override change(change: Change) {
    const { live, scene } = this;
    if (!live || !scene || IN_COPY.includes(change.do)) return super.change(change);
    const { robot = 0, ...others } = change as Change & { robot?: number };
    const whose = change.do === "body" ? { robot, seed: scene.environment.seed } : { node: scene.states[robot].node };
    this.send(("robot" in change ? { ...others, ...whose } : change) as Command);
  }

  override async ask(who: string, text: string) {
    if (this.live) this.send({ do: "ask", who, text, node: this.scene?.node ?? 1 });
    else await super.ask(who, text);
  }

  override go(tick: number) {
    if (!this.live || tick >= this.last) return super.go(tick);
    this.wanted = tick;
    this.lookBack().catch(({ message }) => this.note.show(message));
  }

  override seek(tick: number) {
    if (this.live) this.go(tick);
    else super.seek(tick);
  }

  override jump(step: number) {
    const kind = typedById("kind", HTMLSelectElement).value;
    const command = NEXT[kind];
    if (!this.play) super.jump(step);
    else if (step < 0) this.lookBack().then(() => super.jump(step), ({ message }) => this.note.show(message));
    else if (!command || this.play.done) this.note.show(say("noLater", { kind: nameIn("kinds", kind) }));
    else this.send(command);
  }

  override setPlaying(playing: boolean) {
    if (this.live) this.send({ do: playing ? "play" : "pause" });
    else super.setPlaying(playing);
  }

  override advance(now: number) {
    if (!this.live) super.advance(now);
  }

  override showStatus() {
    const lost = say(this.hasEnded ? "runEnded" : "noConnection");
    document.body.classList.toggle("lost", Boolean(this.isLost));
    document.body.classList.toggle("ended", Boolean(this.hasEnded));
    if (this.isLost || this.play) setText(byId("status"), this.play && !this.isLost ? statusOf(this.play) : lost);
    else super.showStatus();
  }

  override get title() {
    return say(this.hasEnded ? "runRecorded" : "runSoFar");
  }

  override get doing() {
    return this.hasEnded ? say("runEnded") : super.doing;
  }

  override showTime(clock: string) {
    if (this.wanted === undefined) super.showTime(clock);
  }

  override draw() {
    super.draw();
    if (!this.live) return;
    this.showLive(this.live.message);
    const { robot, last } = this.lane;
    const count = this.live.eventsOf(robot).length;
    const [known, marked] = this.marked;
    if (count !== known || (last - marked) * this.marks.width > last) this.drawMarks();
  }

  override drawMarks() {
    const { live, lane } = this;
    this.marked = [live?.eventsOf(lane.robot).length ?? 0, lane.last];
    super.drawMarks();
  }

  showLive({ play, health, pins }: Message) {
    const { speed } = this;
    this.showPlaying();
    if (document.activeElement !== speed) speed.value = `${play.speed}`;
    setText(byId("fact-speed"), `${decimal((play.rate * this.tickMs) / 1000, 1, robotWords())} ×`);
    for (const id of NEEDS_A_RUN) typedById(id, HTMLButtonElement).disabled = play.done;
    setText(byId("banner"), play.ended ? ending(play.ended, play.done).join("\n") : "");
    for (const [name, count] of Object.entries(health)) setText(byId(`health-${name}`), `${count}`);
    byId("on-pins").hidden = pins.length === 0;
    setText(byId("pins"), pins.map(pinsText).join("; "));
    this.showStatus();
  }
}

function pinsText({ volts, counts, duty }: PinFigures) {
  return say("pins", { volts: `${volts}`.replace(".", robotWords().point), counts: counts.join(", "), duty: duty.join(", ") });
}

function statusOf(play: Play) {
  if (play.done) return say(play.stays ? "allDoneSeed" : "allDone");
  if (play.ended) return say("onToNext");
  return say(play.playing ? "live" : "paused");
}

/**
 * A heading and a sentence for how an environment ended, and after the last one for all of them.
 * @param done - Whether it was the last one.
 */
function ending(ended: Ended, done: boolean): [string, string] {
  const { number, eaten, food, environments, environments_finished, environments_robot_s } = ended;
  const { point } = robotWords();
  if (done) return [say("allDoneBig"), say("endedAll", { finished: environments_finished, all: environments, time: minutes(environments_robot_s, point) })];
  const found = ended.finished ? say("allFood") : say("someFood", { eaten, food });
  return [found, say("endedAt", { number, time: minutes(ended.robot_s, point) })];
}

/** What "start over" has done. */
function restarted({ seed }: EnvironmentScene, states: State[]) {
  const isEmpty = states.every(({ memory }) => memory.every((side) => side === SIDE.NOTHING));
  return say(isEmpty ? "restartedEmpty" : "restartedKept", { seed });
}

/** Connects, and shows the run with its first message. */
export function watch(parts: Parts) {
  let page: LivePage | undefined;
  hideToken();
  history.replaceState(null, "", location.href.split("#")[0]); // a link would hold another run
  document.body.classList.add("live");
  setText(byId("status"), say("connecting"));
  setText(byId("doing"), say("waitingRobot"));
  const accept = (message: Message) => {
    if (!page) Object.assign(window, { octet: (page = new LivePage(parts, connection, new LiveRun(message))) });
    page.accept(message);
  };
  const connection = new Connection(accept, (hasEnded) => {
    if (page) page.lose(hasEnded);
    else setText(byId("status"), say(hasEnded ? "runEnded" : "noConnection"));
  });
}
