/* Feeds a recorded log to the firmware and compares its answers with the recorded ones. */

import { FRAMES, NODE_MAX, PAGE_ROBOTS_MAX } from "../generated.js";
import { NativeRun } from "./native_run.js";
import type { Frame } from "./native_run.js";

/** The first frame that differs: its line in the log, counted from 1, and what the firmware says instead. */
type Difference = { line: number; recorded: string; replayed: string };

type Comparison = { frames: number; difference: Difference | undefined };

/** A line as candump -L writes it: time, channel, identifier, bytes. */
const LINE = /^\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#((?:[0-9A-F]{2})*)$/;
const TO_ROBOT = [FRAMES.COMMAND, FRAMES.SENSES, FRAMES.RANGES];

/**
 * Compares a log of robots in lockstep, of which no frame was lost.
 * @param module - page.wasm, compiled.
 * @param text - The log.
 */
export function replayLog(module: WebAssembly.Module, text: string): Comparison {
  const run = new NativeRun(module, PAGE_ROBOTS_MAX);
  const answers: string[][] = Array.from({ length: PAGE_ROBOTS_MAX }, () => []);
  let frames = 0;
  for (const { line, robot, base, words, data } of framesOf(text)) {
    frames += 1;
    if (TO_ROBOT.includes(base)) {
      for (const said of run.exchange(robot, { id: base + robot, data })) answers[robot].push(wordsOf(said));
    } else {
      const replayed = answers[robot].shift() ?? "nothing";
      if (replayed !== words) return { frames, difference: { line, recorded: words, replayed } };
    }
  }
  return { frames, difference: undefined };
}

/** The frames of a log that come from a robot or are meant for one. */
export function* framesOf(text: string) {
  for (const [index, line] of text.split("\n").entries()) {
    const frame = line && frameOf(line, index + 1);
    if (frame) yield { line: index + 1, ...frame };
  }
}

function frameOf(line: string, number: number) {
  const [, , id, hex] = LINE.exec(line) ?? [];
  if (id === undefined) throw new Error(`line ${number} is not a frame of a log: open a run.log`);
  const numeric = parseInt(id, 16);
  const base = Object.values(FRAMES).find((first) => numeric >= first && numeric < first + NODE_MAX);
  if (base === undefined) return undefined;
  const robot = numeric - base;
  if (robot >= PAGE_ROBOTS_MAX) throw new Error(`line ${number} is from node ${robot + 1}: a page supports up to ${PAGE_ROBOTS_MAX}`);
  return { robot, base, words: `${id}#${hex}`, data: bytesOf(hex) };
}

/** @param hex - The bytes of a frame. */
export function bytesOf(hex: string) {
  return Uint8Array.from(hex.match(/../g) ?? [], (byte) => parseInt(byte, 16));
}

function wordsOf({ id, data }: Frame) {
  const hex = Array.from(data, (byte) => byte.toString(16).padStart(2, "0"));
  return `${id.toString(16).padStart(3, "0")}#${hex.join("")}`.toUpperCase();
}
