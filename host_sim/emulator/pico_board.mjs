// A Raspberry Pi Pico around rp2040js, an emulator that others maintain. What it lacks is here: the boot ROM, resets,
// power failures, and a serial port in real time. pico.mjs runs it in Node, pico_worker.ts in a page.

const LINE_BAUD = 115200;
const QUICK_NS = 1000; // for a byte, if the line is not paced
const HANG_NS = 10e3;
const SECTOR = 4096;
const FLASH_SIZE = 16 << 20;
const FLASH = 0x10000000;
const RAM = 0x20000000;
const RAM_TOP = 0x20041f00;
const WATCHDOG = 0x40058;
const CHIP_RESET = 0x40064;
const RESETS = 0x4000c;
const ADC_CS = 0;
const HARD_FAULT = 3;
const PINS = 30;
const ANALOGUE = 26; // from this pin on
const BY_PWM = 4; // the number of a pin's function
const TURN = [0, 1, 3, 2]; // the states of an encoder's channels B and A, forward
const SETTLES = 64; // steps of PIO: two rounds of any program that only watches its pins
const [RXFE, TXFF, QUEUE] = [1 << 4, 1 << 5, 32]; // of the serial port
const FUNCTIONS = ["IF", "EX", "RE", "RP", "FC", "CX"];

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

/** Table, look-up and functions, each of them a breakpoint that `serve` answers: its number, and a return. */
function bootRom() {
  const half = new Uint16Array(0x2000);
  half.set([0x754d, 0x0201, 0x0100, 0x0180, 0x0201], 0x10 / 2); // "Mu", 1, table, data, look-up with the bit of Thumb
  FUNCTIONS.forEach((name, at) => half.set([lettersOf(name), functionAt(at)], 0x80 + 2 * at));
  for (let at = 0; at <= FUNCTIONS.length; at++) half.set([0xbe00 | at, 0x4770], 0x100 + 8 * at);
  return new Uint32Array(half.buffer);
}

function fail(why) {
  throw new Error(why);
}

/** The board. A fault of the image, such as running in a flash that cannot be read, is thrown as an error. */
export class PicoBoard {
  mcu; // a new one after each reset, which rp2040js mostly leaves to its user
  flash = new Uint8Array(FLASH_SIZE).fill(0xff);
  restart = "power"; // the cause of the pending reset
  away = false; // the flash cannot be read
  operations = 0; // writes and erases of the flash so far
  cut = { at: 0, part: 0 }; // the power fails at this operation, after this part of it
  cuts = 0;
  line = []; // bytes on their way to the robot
  sent = []; // bytes in the port's own queue, if the line is paced
  moving = false;
  spoken = []; // bytes for whoever listens
  levels = Array.from({ length: PINS }, (_, pin) => pin < ANALOGUE); // to which the wiring drives each pin
  samples = [0, 0, 0, 0, 0];
  beat = false; // a slice of the PWM with an enabled interrupt has wrapped
  high = []; // how long each pin has been driven high, ns, and the time of its last change
  measured = 0;
  looked = 0; // time up to which PIO has run
  woke = 0;
  longest = 0; // longest time without sleep of the core, ns

  /**
   * @param RP2040 - The class of rp2040js.
   * @param image - The contents of the flash from its beginning.
   * @param paced - Whether a byte takes as long as on a real line; otherwise as long as the robot needs to read it.
   */
  constructor(RP2040, image, paced = false) {
    this.RP2040 = RP2040;
    this.paced = paced;
    this.flash.set(image);
    this.start();
  }

  /** Puts bytes on its line. */
  hear(bytes) {
    this.line.push(...bytes);
    if (this.line.length) this.wake();
  }

  /** What it has said since the last call. */
  takeSpoken() {
    const { spoken } = this;
    this.spoken = [];
    return spoken;
  }

  /** Moves a byte each way, and schedules itself again while there are more. */
  move() {
    const { line, sent, paced } = this;
    const uart = this.mcu.uart[0];
    if (line.length && (paced || uart.rxFIFO.itemCount < 16)) uart.feedByte(line.shift());
    if (sent.length) this.spoken.push(sent.shift());
    this.moving = line.length + sent.length > 0;
    if (this.moving) this.mcu.mover.schedule(paced ? 1e10 / (uart.baudDivider ? uart.baudRate : LINE_BAUD) : QUICK_NS);
  }

  say(byte) {
    if (!this.paced) this.spoken.push(byte);
    else if (this.sent.push(byte)) this.wake();
  }

  wake() {
    if (!this.moving) this.mcu.mover.schedule(this.paced ? 1e10 / LINE_BAUD : QUICK_NS);
    this.moving = true;
  }

  /** Changes bytes of the flash. If the power fails meanwhile, each byte has either its old or its new value. */
  alter(begin, values) {
    this.operations++;
    const isCut = this.operations === this.cut.at;
    const count = isCut ? Math.floor(values.length * this.cut.part) : values.length;
    for (let i = 0; i < count; i++) this.flash[begin + i] = values[i];
    this.mcu.flash.set(this.flash.subarray(begin, begin + values.length), begin);
    if (!isCut) return;
    this.restart = "power";
    this.cuts++;
  }

  serve(number) {
    const { mcu, flash, away } = this;
    const [first, second, count] = mcu.core.registers;
    const called = FUNCTIONS[number - 1];
    if (number === 0) {
      const at = FUNCTIONS.findIndex((name) => lettersOf(name) === second);
      mcu.core.registers[0] = at < 0 ? 0 : functionAt(at);
    } else if (called === "EX") {
      this.away = true;
    } else if (called === "CX") {
      this.away = false;
    } else if (called === "RE") {
      if (!away || first % SECTOR || second % SECTOR) fail(`erase of ${second} bytes at ${first}`);
      this.alter(first, new Uint8Array(second).fill(0xff));
      mcu.clock.tick(45e6);
    } else if (called === "RP") {
      if (!away || first % 256 || count % 256 || second < RAM) fail(`write of ${count} bytes at ${first}`);
      this.alter(first, flash.subarray(first, first + count).map((old, i) => old & mcu.readUint8(second + i)));
      mcu.clock.tick(400e3);
    }
  }

  /** Runs PIO; needed only when a pin changes or a register is read, since otherwise it just repeats itself. */
  runPio(most) {
    for (const machine of this.mcu.pio[0].machines)
      for (let i = 0; machine.enabled && i < most; i++) machine.step();
    this.looked = this.mcu.clock.nanos;
  }

  lookAtPio(offset) {
    const { clock, clkSys, pio } = this.mcu;
    const passed = ((clock.nanos - this.looked) * clkSys) / 1e9 / pio[0].machines[0].clockDivInt;
    if (passed >= 1) this.runPio(Math.min(Math.floor(passed), SETTLES));
    return Object.getPrototypeOf(pio[0]).readUint32.call(pio[0], offset);
  }

  /** Drives a pin from outside. Tells a PWM slice that counts edges, since rp2040js has the wrong condition. */
  drive(pin, value) {
    const { gpio, pwm } = this.mcu;
    if (this.levels[pin] === value) return;
    this.levels[pin] = value;
    gpio[pin].setInputValue(value);
    if (pin % 2 && gpio[pin].functionSelect === BY_PWM) pwm.channels[(pin >> 1) % 8].gpioBChanged();
  }

  /** Turns an encoder whose channels are at a pin and at the next one. */
  turn(pin, count) {
    for (let left = Math.abs(count); left > 0; left--) {
      const at = TURN.indexOf(this.levels[pin] | (this.levels[pin + 1] << 1));
      const next = TURN[(at + Math.sign(count) + TURN.length) % TURN.length];
      this.drive(pin, Boolean(next & 1));
      this.drive(pin + 1, Boolean(next & 2));
      this.runPio(SETTLES / 2);
    }
  }

  /** A poll for the end of a conversion waits for that end: as much time passes, in fewer instructions. */
  readAdc(offset) {
    const { adc, clock } = this.mcu;
    while (adc.busy && offset === ADC_CS) clock.tick(clock.nextAlarm.nanos - clock.nanos);
    return Object.getPrototypeOf(adc).readUint32.call(adc, offset);
  }

  /** @param values - What the ADC reads at each of its inputs from now on. */
  sample(...values) {
    this.samples = this.mcu.adc.channelValues = [...values, 0];
  }

  /** The fraction of the time since the last call in which each pin was driven high. */
  shares() {
    const now = this.mcu.clock.nanos;
    const span = now - this.measured;
    this.measured = now;
    return this.high.map((it, pin) => {
      const driven = this.mcu.gpio[pin].value === 1;
      const time = it.time + (driven ? now - it.since : 0);
      Object.assign(it, { time: 0, since: now });
      return span > 0 ? (time / span).toFixed(5) : Number(driven);
    });
  }

  /** Makes the core fault; returns the address of its next instruction. */
  crash() {
    const at = this.mcu.core.PC;
    this.mcu.core.exceptionEntry(HARD_FAULT);
    return at;
  }

  /** Makes the core hang. */
  hang() {
    this.mcu.core.PC = 0x20030000;
    this.mcu.sramView.setUint16(0x30000, 0xe7fe, true);
  }

  /** Connects what rp2040js leaves to its user, and corrects where it differs from the chip. */
  wire() {
    const { mcu } = this;
    mcu.pio[0].run = () => {}; // runPio runs it instead
    mcu.pio[0].readUint32 = (offset) => this.lookAtPio(offset);
    mcu.adc.channelValues = this.samples;
    mcu.adc.readUint32 = (offset) => this.readAdc(offset);
    [this.beat, this.measured, this.looked, this.woke] = [false, 0, 0, 0];
    this.high = mcu.gpio.map(() => ({ time: 0, since: 0 }));
    mcu.gpio.forEach((gpio, pin) => {
      gpio.rawInputValue = this.levels[pin];
      gpio.addListener((value, before) => {
        if (before === 1) this.high[pin].time += mcu.clock.nanos - this.high[pin].since;
        this.high[pin].since = mcu.clock.nanos;
      });
    });
    const told = mcu.pwm.channelInterrupt;
    mcu.pwm.channelInterrupt = (slice) => {
      if ((mcu.pwm.intEnable >> slice) & 1) this.beat = true;
      told.call(mcu.pwm, slice);
    };
    const { core } = mcu;
    const take = core.checkForInterrupts;
    // With PRIMASK set, an interrupt ends a sleep, and is not taken (ARMv6-M, B1.5.15).
    core.checkForInterrupts = () => {
      if (!core.PM) return take.call(core);
      core.interruptsUpdated = false;
      return (core.pendingInterrupts & core.enabledInterrupts) !== 0;
    };
  }

  /** Connects what resets the chip, and the registers that tell the cause afterwards. */
  wireResets(cause) {
    const { peripherals } = this.mcu;
    const watchdog = peripherals[WATCHDOG];
    watchdog.reason = { force: 2, timer: 1 }[cause] ?? 0;
    watchdog.onWatchdogTrigger = () => {
      this.restart ??= watchdog.reason === 2 ? "force" : "timer";
      watchdog.timer.enable = watchdog.alarm.enable = false; // otherwise it would fire for ever
    };
    peripherals[CHIP_RESET].readUint32 = () => 1 << 8;
    const resets = peripherals[RESETS];
    resets.reset = 0x1ffffff;
    resets.readUint32 = (offset) => (offset === 8 ? ~resets.reset & 0x1ffffff : resets.reset);
  }

  wireUart() {
    const { mcu } = this;
    const uart = mcu.uart[0];
    uart.onByte = (byte) => this.say(byte);
    const flags = { get: () => (uart.rxFIFO.empty ? RXFE : 0) | (this.sent.length >= QUEUE ? TXFF : 0) };
    if (this.paced) Object.defineProperty(uart, "flags", flags);
    mcu.mover = mcu.clock.createAlarm(() => this.move());
    if (this.line.length) this.wake();
  }

  /** Starts as the boot ROM does: checks the second stage, copies it to the RAM, and calls it there. */
  start() {
    const [before, cause, { flash }] = [this.mcu, this.restart, this];
    Object.assign(this, { restart: null, away: false, moving: false, sent: [] });
    const mcu = (this.mcu = new this.RP2040());
    mcu.logger = { debug() {}, info() {}, warn() {}, error: (of, what) => fail(`${of}: ${what}`) };
    mcu.loadBootrom(bootRom());
    mcu.flash.set(flash);
    if (cause === "power") mcu.sram.fill(0xa5);
    else mcu.sram.set(before.sram);
    mcu.onBreak = (number) => this.serve(number);
    this.wireResets(cause);
    this.wireUart();
    this.wire();
    const sum = new DataView(flash.buffer).getUint32(252, true);
    if (crcOf(flash.subarray(0, 252)) !== sum) fail("the second stage has a wrong checksum: it does not start");
    mcu.sram.set(flash.subarray(0, 256), RAM_TOP - RAM);
    [mcu.core.PC, mcu.core.SP, mcu.core.LR] = [RAM_TOP, RAM_TOP, 0];
  }

  /** Lets the core sleep until an interrupt is pending. */
  sleep(until) {
    const { core, clock } = this.mcu;
    this.longest = Math.max(this.longest, clock.nanos - this.woke);
    while (clock.nanos < until && !(core.pendingInterrupts & core.enabledInterrupts))
      clock.tick(Math.min(clock.nextAlarm?.nanos ?? until, until) - clock.nanos);
    this.woke = clock.nanos;
    core.waiting = !(core.pendingInterrupts & core.enabledInterrupts);
  }

  run(until, toBeat) {
    const { mcu } = this;
    const { core, clock } = mcu;
    this.beat = false;
    while (!this.restart && clock.nanos < until && !(toBeat && this.beat)) {
      if (core.waiting) {
        this.sleep(until);
        continue;
      }
      const at = core.PC;
      const cycles = core.executeInstruction();
      clock.tick((cycles * 1e9) / mcu.clkSys);
      if (core.PC === at) clock.tick(HANG_NS); // it hangs: only time passes
      if (this.away && core.PC >= FLASH && core.PC < RAM) fail("runs in the flash while it cannot be read");
    }
  }

  /** Runs for a time, with the resets within it, or to the next beat. Returns the time that passed, ns. */
  pass(nanos, toBeat = false) {
    let left = nanos;
    do {
      if (this.restart) this.start();
      const begun = this.mcu.clock.nanos;
      this.run(begun + left, toBeat);
      left -= this.mcu.clock.nanos - begun;
    } while (this.restart);
    return nanos - left;
  }
}
