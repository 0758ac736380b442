// The board of pico_board.mjs in Node. Called as: node pico.mjs LIBRARY IMAGE.bin [stepped] [paced]
//
// Its standard input and output are the serial line, with slcan text. If nobody sends anything, its time soon stands
// still, so that a slow machine does not look like silence. With `stepped`, it runs only when told: lines that begin
// with '!' are orders to this program, which answers each. Without `paced`, a byte takes as long as the robot needs to read it.
import { readFileSync, readSync, writeSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { PicoBoard } from "./pico_board.mjs";

const [library, imagePath, ...options] = process.argv.slice(2);
const { RP2040 } = await import(pathToFileURL(library).href);
const stepped = options.includes("stepped");

const START_NS = 200e6; // the image may erase a sector first
const QUIET_NS = 20e6;
const SLICE_NS = 200e3;

process.on("uncaughtException", ({ message }) => {
  process.stderr.write(`${message}\n`);
  process.exit(1);
});
const board = new PicoBoard(RP2040, readFileSync(imagePath), options.includes("paced"));
let { mcu } = board;
let spokenTo = START_NS;

/** Reads orders synchronously: there are 200 a second, and a stream would take as long for one as the chip. */
function obey() {
  const buffer = Buffer.alloc(65536);
  for (let count; (count = readSync(0, buffer)); ) {
    hear(buffer.subarray(0, count));
    const spoken = Uint8Array.from(board.takeSpoken());
    for (let done = 0; done < spoken.length; ) done += writeSync(1, spoken, done);
  }
}

function flush() {
  const spoken = board.takeSpoken();
  if (spoken.length) process.stdout.write(Uint8Array.from(spoken));
}

const ORDERS = {
  run: (micros) => void board.pass(1000 * micros),
  beat: (micros) => `${Math.round(board.pass(1000 * micros, true))} ${board.shares().join(" ")}`,
  drive: (pin, value) => board.drive(pin, Boolean(value)),
  turn: (pin, count) => board.turn(pin, count),
  sample: (...values) => board.sample(...values),
  longest: () => { const micros = board.longest / 1000; board.longest = 0; return micros; },
  cut: (after, part) => { board.cut = { at: board.operations + after, part }; },
  power: () => { board.restart = "power"; },
  crash: () => board.crash(),
  hang: () => board.hang(),
  operations: () => board.operations,
  cuts: () => board.cuts,
  count: (machine) => board.mcu.pio[0].machines[machine].y | 0,
  led: () => board.mcu.gpio[25].value,
};

let begun = "";
function hear(data) {
  for (const byte of data) {
    if (begun || byte === 33) {
      begun += String.fromCharCode(byte);
      if (byte === 13) {
        const [order, ...numbers] = begun.slice(1, -1).split(" ");
        begun = "";
        const answer = ORDERS[order](...numbers.map(Number)) ?? "";
        board.spoken.push(...Buffer.from(`!${answer}\r`));
      }
    } else {
      board.hear([byte]);
    }
  }
}

let waiting = false;
function live() {
  if (waiting) return;
  if (mcu !== board.mcu) [mcu, spokenTo] = [board.mcu, START_NS];
  const now = mcu.clock.nanos;
  if (board.line.length) spokenTo = now;
  if (now - spokenTo > QUIET_NS + (board.line.length ? 1e12 : 0)) return;
  board.pass(SLICE_NS);
  flush();
  waiting = true;
  setImmediate(() => {
    waiting = false;
    live();
  });
}

if (stepped) {
  obey();
} else {
  process.stdin.on("data", (data) => {
    hear(data);
    spokenTo = board.mcu.clock.nanos;
    live();
  });
  process.stdin.on("end", () => process.exit(0));
  live();
}
