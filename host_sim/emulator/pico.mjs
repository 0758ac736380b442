// A Raspberry Pi Pico around rp2040js, an emulator that others keep. What that lacks is here: the boot ROM, a reset,
// the power, and a serial port that takes its time. Called as: node pico.mjs LIBRARY IMAGE.bin [stepped] [paced]
//
// In and out go what the serial port hears and says, lines of slcan. If nobody speaks to it, it soon stands still, so
// that a slow machine does not look like silence. With `stepped`, it runs only when told: lines that begin with '!'
// are for the harness, which answers each. Without `paced`, a byte takes as long as the robot needs to read it.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [library, imagePath, ...options] = process.argv.slice(2);
const { RP2040 } = await import(pathToFileURL(library).href);
const stepped = options.includes("stepped");
const paced = options.includes("paced");

const LINE_BAUD = 115200;
const BYTE_NS = paced ? 1e10 / LINE_BAUD : 1000;
const START_NS = 200e6; // it may erase a sector first
const QUIET_NS = 20e6;
const SLICE_NS = 200e3;
const HANG_NS = 10e3;
const SECTOR = 4096;
const FLASH = 0x10000000;
const RAM_TOP = 0x20041f00;
const WATCHDOG = 0x40058;
const CHIP_RESET = 0x40064;
const RESETS = 0x4000c;
const HARD_FAULT = 3;
const PINS = 30;
const ANALOGUE = 26; // from this pin on
const BY_PWM = 4; // the number of a pin's function
const TURN = [0, 1, 3, 2]; // the states of an encoder's channels B and A, forward
const SETTLES = 64; // steps of PIO: two rounds of any program that only watches its pins
const [RXFE, TXFF, QUEUE] = [1 << 4, 1 << 5, 32]; // of the serial port
const FUNCTIONS = ["IF", "EX", "RE", "RP", "FC", "CX"];

function fail(why) {
  process.stderr.write(`${why}\n`);
  process.exit(1);
}

/** The CRC that the boot ROM computes of the second stage (data sheet 2.8.1.3.1). */
function crcOf(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let bit = 0; bit < 8; bit++) crc = crc & 0x80000000 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
  }
  return crc >>> 0;
}

const lettersOf = (name) => name.charCodeAt(0) | (name.charCodeAt(1) << 8);
const functionAt = (number) => 0x211 + 16 * number; // with the bit of Thumb

/** Table, look-up and functions, each of them a breakpoint that the harness serves: its number, and a return. */
function bootRom() {
  const half = new Uint16Array(0x2000);
  half.set([0x754d, 0x0201, 0x0100, 0x0180, 0x0201], 0x10 / 2); // "Mu", 1, table, data, look-up with the bit of Thumb
  FUNCTIONS.forEach((name, at) => half.set([lettersOf(name), functionAt(at)], 0x80 + 2 * at));
  for (let at = 0; at <= FUNCTIONS.length; at++) half.set([0xbe00 | at, 0x4770], 0x100 + 8 * at);
  return new Uint32Array(half.buffer);
}

const flash = new Uint8Array(16 << 20).fill(0xff);
flash.set(readFileSync(imagePath));
let mcu; // a new one after each reset: rp2040js leaves most of one to its user
let restart = "power"; // what ends the current one
let away = false; // the flash cannot be read
let operations = 0;
let cut = { at: 0, part: 0 }; // the power goes at this operation, after this part of it
let cuts = 0;
let spokenTo = 0;
let line = []; // bytes on their way to the robot
let sent = []; // bytes in the port's own queue, if it takes its time
let moving = false;
let spoken = []; // bytes for whoever listens, with the answers to orders
const levels = Array.from({ length: PINS }, (_, pin) => pin < ANALOGUE); // what is wired to each pin drives it so
let samples = [0, 0, 0, 0, 0];
let beat = false; // a slice of the PWM has wrapped whose interrupt is enabled
let high = []; // for how long each pin was driven high, ns, and since when it is
let measured = 0;
let looked = 0; // up to when PIO has run
let woke = 0;
let longest = 0; // that the core did not sleep, ns

function flush() {
  if (spoken.length) process.stdout.write(Uint8Array.from(spoken));
  spoken = [];
}

/** Moves a byte each way, and comes again while there are more. */
function move() {
  const uart = mcu.uart[0];
  if (line.length && (paced || uart.rxFIFO.itemCount < 16)) uart.feedByte(line.shift());
  if (sent.length) spoken.push(sent.shift());
  moving = line.length + sent.length > 0;
  if (moving) mcu.mover.schedule(paced ? 1e10 / (uart.baudDivider ? uart.baudRate : LINE_BAUD) : BYTE_NS);
}

function say(byte) {
  if (!paced) spoken.push(byte);
  else if (sent.push(byte)) wake();
}

function wake() {
  if (!moving) mcu.mover.schedule(BYTE_NS);
  moving = true;
}

/** What the power cuts off is half done; every cell keeps what it had or gets what it was to get. */
function alter(begin, values) {
  operations++;
  const count = operations === cut.at ? Math.floor(values.length * cut.part) : values.length;
  for (let i = 0; i < count; i++) flash[begin + i] = values[i];
  mcu.flash.set(flash.subarray(begin, begin + values.length), begin);
  if (operations !== cut.at) return;
  restart = "power";
  cuts++;
}

function serve(number) {
  const [first, second, count] = mcu.core.registers;
  const called = FUNCTIONS[number - 1];
  if (number === 0) {
    const at = FUNCTIONS.findIndex((name) => lettersOf(name) === second);
    mcu.core.registers[0] = at < 0 ? 0 : functionAt(at);
  } else if (called === "EX") {
    away = true;
  } else if (called === "CX") {
    away = false;
  } else if (called === "RE") {
    if (!away || first % SECTOR || second % SECTOR) fail(`erase of ${second} bytes at ${first}`);
    alter(first, new Uint8Array(second).fill(0xff));
    mcu.clock.tick(45e6);
  } else if (called === "RP") {
    if (!away || first % 256 || count % 256 || second < 0x20000000) fail(`write of ${count} bytes at ${first}`);
    alter(first, flash.subarray(first, first + count).map((old, i) => old & mcu.readUint8(second + i)));
    mcu.clock.tick(400e3);
  }
}

/** Runs PIO, which only repeats itself while nothing at its pins changes, and nobody looks at it. */
function runPio(most) {
  for (const machine of mcu.pio[0].machines)
    for (let i = 0; machine.enabled && i < most; i++) machine.step();
  looked = mcu.clock.nanos;
}

function lookAtPio(offset) {
  const passed = ((mcu.clock.nanos - looked) * mcu.clkSys) / 1e9 / mcu.pio[0].machines[0].clockDivInt;
  if (passed >= 1) runPio(Math.min(Math.floor(passed), SETTLES));
  return Object.getPrototypeOf(mcu.pio[0]).readUint32.call(mcu.pio[0], offset);
}

/** What drives a pin from outside. rp2040js does not tell a slice of the PWM that counts edges: its test is wrong. */
function drive(pin, value) {
  if (levels[pin] === value) return;
  levels[pin] = value;
  mcu.gpio[pin].setInputValue(value);
  if (pin % 2 && mcu.gpio[pin].functionSelect === BY_PWM) mcu.pwm.channels[(pin >> 1) % 8].gpioBChanged();
}

/** An encoder turns, whose channels are at a pin and at the next one. */
function turn(pin, count) {
  for (let left = Math.abs(count); left > 0; left--) {
    const at = TURN.indexOf(levels[pin] | (levels[pin + 1] << 1));
    const next = TURN[(at + Math.sign(count) + TURN.length) % TURN.length];
    drive(pin, Boolean(next & 1));
    drive(pin + 1, Boolean(next & 2));
    runPio(SETTLES / 2);
  }
}

/** The share of the time, since it was last asked, in which each pin was driven high. */
function shares() {
  const now = mcu.clock.nanos;
  const span = now - measured;
  measured = now;
  return high.map((it, pin) => {
    const driven = mcu.gpio[pin].value === 1;
    const time = it.time + (driven ? now - it.since : 0);
    Object.assign(it, { time: 0, since: now });
    return span > 0 ? (time / span).toFixed(5) : Number(driven);
  });
}

/** Wires around the chip that rp2040js leaves to its user, and what it does otherwise than the chip. */
function wire() {
  mcu.pio[0].run = () => {}; // in its own time, which is not the core's
  mcu.pio[0].readUint32 = lookAtPio;
  mcu.adc.channelValues = samples;
  [beat, measured, looked, woke] = [false, 0, 0, 0];
  high = mcu.gpio.map(() => ({ time: 0, since: 0 }));
  mcu.gpio.forEach((gpio, pin) => {
    gpio.rawInputValue = levels[pin];
    gpio.addListener((value, before) => {
      if (before === 1) high[pin].time += mcu.clock.nanos - high[pin].since;
      high[pin].since = mcu.clock.nanos;
    });
  });
  const told = mcu.pwm.channelInterrupt;
  mcu.pwm.channelInterrupt = (slice) => {
    if ((mcu.pwm.intEnable >> slice) & 1) beat = true;
    told.call(mcu.pwm, slice);
  };
  const core = mcu.core;
  const take = core.checkForInterrupts;
  // With PRIMASK set, an interrupt ends a sleep, and is not taken (ARMv6-M, B1.5.15).
  core.checkForInterrupts = () => {
    if (!core.PM) return take.call(core);
    core.interruptsUpdated = false;
    return (core.pendingInterrupts & core.enabledInterrupts) !== 0;
  };
}

/** A start as the boot ROM makes it: the second stage is checked, copied to the RAM, and called there. */
function start() {
  const before = mcu;
  const [power, reason] = [restart === "power", { force: 2, timer: 1 }[restart] ?? 0];
  [restart, away, moving, sent] = [null, false, false, []];
  mcu = new RP2040();
  mcu.logger = { debug() {}, info() {}, warn() {}, error: (of, what) => fail(`${of}: ${what}`) };
  mcu.loadBootrom(bootRom());
  mcu.flash.set(flash);
  if (power) mcu.sram.fill(0xa5);
  else mcu.sram.set(before.sram);
  const watchdog = mcu.peripherals[WATCHDOG];
  watchdog.reason = reason;
  watchdog.onWatchdogTrigger = () => {
    restart ??= watchdog.reason === 2 ? "force" : "timer";
    watchdog.timer.enable = watchdog.alarm.enable = false; // else it bites for ever
  };
  mcu.peripherals[CHIP_RESET].readUint32 = () => (restart === "run" ? 1 << 16 : 1 << 8);
  const resets = mcu.peripherals[RESETS];
  resets.reset = 0x1ffffff;
  resets.readUint32 = (offset) => (offset === 8 ? ~resets.reset & 0x1ffffff : resets.reset);
  mcu.onBreak = serve;
  mcu.uart[0].onByte = say;
  const flags = { get: () => (mcu.uart[0].rxFIFO.empty ? RXFE : 0) | (sent.length >= QUEUE ? TXFF : 0) };
  if (paced) Object.defineProperty(mcu.uart[0], "flags", flags);
  mcu.mover = mcu.clock.createAlarm(move);
  wire();
  if (line.length) wake();
  const sum = new DataView(flash.buffer).getUint32(252, true);
  if (crcOf(flash.subarray(0, 252)) !== sum) fail("the second stage has a wrong sum: the boot ROM does not start it");
  mcu.sram.set(flash.subarray(0, 256), RAM_TOP - 0x20000000);
  [mcu.core.PC, mcu.core.SP, mcu.core.LR, spokenTo] = [RAM_TOP, RAM_TOP, 0, START_NS];
}

/** Lets the core sleep until an interrupt is pending. */
function sleep(until) {
  const { core, clock } = mcu;
  longest = Math.max(longest, clock.nanos - woke);
  while (clock.nanos < until && !(core.pendingInterrupts & core.enabledInterrupts))
    clock.tick(Math.min(clock.nextAlarm?.nanos ?? until, until) - clock.nanos);
  woke = clock.nanos;
  core.waiting = !(core.pendingInterrupts & core.enabledInterrupts);
}

function run(until, toBeat) {
  beat = false;
  while (!restart && mcu.clock.nanos < until && !(toBeat && beat)) {
    if (mcu.core.waiting) {
      sleep(until);
      continue;
    }
    const at = mcu.core.PC;
    const cycles = mcu.core.executeInstruction();
    mcu.clock.tick((cycles * 1e9) / mcu.clkSys);
    if (mcu.core.PC === at) mcu.clock.tick(HANG_NS); // it hangs: nothing but time goes on
    if (away && mcu.core.PC >= FLASH && mcu.core.PC < 0x20000000) fail("runs in the flash while that cannot be read");
  }
}

/** Runs for a time, through the resets within it, or to the next beat. Returns the time that passed, ns. */
function pass(nanos, toBeat = false) {
  let left = nanos;
  do {
    if (restart) start();
    const begun = mcu.clock.nanos;
    run(begun + left, toBeat);
    left -= mcu.clock.nanos - begun;
  } while (restart);
  return nanos - left;
}

const ORDERS = {
  run: (micros) => void pass(1000 * micros),
  beat: (micros) => `${Math.round(pass(1000 * micros, true))} ${shares().join(" ")}`,
  drive: (pin, value) => drive(pin, Boolean(value)),
  turn,
  sample: (...values) => { samples = mcu.adc.channelValues = [...values, 0]; },
  longest: () => { const micros = longest / 1000; longest = 0; return micros; },
  cut: (after, part) => { cut = { at: operations + after, part }; },
  power: () => { restart = "power"; },
  crash: () => {
    const at = mcu.core.PC;
    mcu.core.exceptionEntry(HARD_FAULT);
    return at;
  },
  hang: () => { mcu.core.PC = 0x20030000; mcu.sramView.setUint16(0x30000, 0xe7fe, true); },
  operations: () => operations,
  cuts: () => cuts,
  count: (machine) => mcu.pio[0].machines[machine].y | 0,
  led: () => mcu.gpio[25].value,
};

let begun = "";
process.stdin.on("data", (data) => {
  for (const byte of data) {
    if (begun || byte === 33) {
      begun += String.fromCharCode(byte);
      if (byte === 13) {
        const [order, ...numbers] = begun.slice(1, -1).split(" ");
        begun = "";
        const answer = ORDERS[order](...numbers.map(Number)) ?? "";
        spoken.push(...Buffer.from(`!${answer}\r`));
      }
    } else {
      line.push(byte);
      wake();
    }
  }
  spokenTo = mcu.clock.nanos;
  flush();
  if (!stepped) live();
});
process.stdin.on("end", () => process.exit(0));

let waiting = false;
function live() {
  if (waiting) return;
  const now = mcu.clock.nanos;
  if (line.length) spokenTo = now;
  if (now - spokenTo > QUIET_NS + (line.length ? 1e12 : 0)) return;
  pass(SLICE_NS);
  flush();
  waiting = true;
  setImmediate(() => {
    waiting = false;
    live();
  });
}

start();
if (!stepped) live();
