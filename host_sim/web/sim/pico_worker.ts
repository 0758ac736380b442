/* The worker of an emulated Pico: its flash image hears what the page's robot heard, and must say the same. */

import { RP2040 } from "rp2040js";
import { PicoBoard } from "../../emulator/pico_board.mjs";
import { FRAMES } from "../generated.js";
import { framesOf } from "./log_replay.js";

/** A frame as logs have it, such as `0C1#05`: what the page's robot said, and what the flash image says. */
export type Pair = { tick: number; page: string; pico: string };

/**
 * Its progress: ticks and frames that were compared, how many times as fast as real time; the newest frames; the
 * frames of the first tick that differs, after which it ends.
 */
export type Progress = { ticks: number; frames: number; equal: number; speed: number; newest: Pair[]; differs?: Pair[]; done: boolean };

/** What the robot hears, and what it is to answer. */
type Exchange = { heard: string; isTick: boolean; answers: string[] };

const BOOT_NS = 1e9;
/** An answer may come as late as this: the flash may be erased before it. */
const LATE_NS = 200e6;
const STEP_NS = 50e3;
const REPORT_MS = 250;
const NEWEST = 8;
const LINE = /^t([0-9A-F]{3})\d([0-9A-F]*)$/;
const TO_ROBOT = [FRAMES.COMMAND, FRAMES.SENSES, FRAMES.RANGES];

/** The exchanges of a log's first robot. */
function exchangesOf(log: string) {
  const exchanges: Exchange[] = [];
  for (const { robot, base, words } of framesOf(log)) {
    if (robot !== 0) continue;
    if (TO_ROBOT.includes(base)) exchanges.push({ heard: words, isTick: base === FRAMES.SENSES, answers: [] });
    else exchanges.at(-1)?.answers.push(words);
  }
  return exchanges;
}

/** A flash image on its serial line. */
class PicoRobot {
  board = new PicoBoard(RP2040, this.image);
  text = "";
  said: string[] = [];

  constructor(readonly image: Uint8Array) {
    this.hearUntil(1, BOOT_NS);
  }

  pass() {
    this.board.pass(STEP_NS);
    const lines = `${this.text}${String.fromCharCode(...this.board.takeSpoken())}`.split("\r");
    this.text = lines.pop() ?? "";
    for (const line of lines) {
      const [, id, hex] = LINE.exec(line) ?? [];
      if (id !== undefined) this.said.push(`${id}#${hex}`);
    }
  }

  /** What it says until it has said a number of frames, or a time has passed. */
  hearUntil(count: number, nanos: number) {
    for (let left = nanos; left > 0 && this.said.length < count; left -= STEP_NS) this.pass();
    const { said } = this;
    this.said = [];
    return said;
  }

  /** What it answers. Does not wait for frames beyond the expected ones: those come with the next exchange. */
  ask({ heard, answers }: Exchange) {
    const [id, hex] = heard.split("#");
    this.board.hear(new TextEncoder().encode(`t${id}${hex.length / 2}${hex}\r`));
    return this.hearUntil(answers.length, LATE_NS);
  }
}

function compare({ image, log, tickMs }: { image: Uint8Array; log: string; tickMs: number }) {
  const exchanges = exchangesOf(log);
  const robot = new PicoRobot(image);
  const progress: Progress = { ticks: 0, frames: 0, equal: 0, speed: 0, newest: [], done: false };
  const began = performance.now();
  let reported = began;
  for (const exchange of exchanges) {
    const said = robot.ask(exchange);
    const tick = progress.ticks;
    const count = Math.max(said.length, exchange.answers.length);
    const pairs = Array.from({ length: count }, (_, i) => ({ tick, page: exchange.answers[i] ?? "", pico: said[i] ?? "" }));
    const now = performance.now();
    progress.ticks += Number(exchange.isTick);
    progress.frames += count;
    progress.equal += pairs.filter(({ page, pico }) => page === pico).length;
    progress.speed = (progress.ticks * tickMs) / (now - began);
    progress.newest = [...progress.newest, ...pairs].slice(-NEWEST);
    if (progress.equal < progress.frames) return postMessage({ ...progress, differs: pairs, done: true });
    if (now - reported < REPORT_MS) continue;
    reported = now;
    postMessage(progress);
  }
  postMessage({ ...progress, done: true });
}

addEventListener("message", ({ data }) => {
  try {
    compare(data);
  } catch (error) {
    postMessage({ error: error instanceof Error ? error.message : `${error}` });
  }
});
