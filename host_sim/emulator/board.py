"""A board: one chip with its memories and peripherals, the image that it runs, and a link to the simulator."""

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from host_sim.emulator.can import BxCan, CanFaults, CanFrame
from host_sim.emulator.chips import (
    AFIO_BASE,
    CAN_BASE,
    CHIPS,
    GPIO_STRIDE,
    SCB_BASE,
    SYSTICK_BASE,
    WATCHDOG_BASE,
    Chip,
)
from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.core import PAGE, Core, Fault, load_segments
from host_sim.emulator.flash import BASE as FLASH
from host_sim.emulator.flash import FlashFaults
from host_sim.emulator.rcc import RccFaults
from host_sim.emulator.registers import AddressSpace, Peripheral, PowerCut, Register, Window
from host_sim.emulator.serial import SlcanLine, Usart
from host_sim.emulator.system import SystemControl, SysTick, Watchdog
from host_sim.errors import UsageError
from host_sim.paths import image_path
from host_sim.protocol.codec import Frame
from host_sim.transport.slcan_link import encode

_BOOT_S = 0.6
"""Enough to erase a page of flash."""

_WINDOWS = ((0x40000000, 0x80000), (0xE000E000, PAGE))
"""(base, bytes) of where registers can be."""


@dataclass(frozen=True)
class Faults:
    """How the hardware misbehaves, part by part.

    Attributes:
        rcc: The clocks.
        can: The CAN controller.
        flash: The flash.
    """

    rcc: RccFaults = field(default_factory=RccFaults)
    can: CanFaults = field(default_factory=CanFaults)
    flash: FlashFaults = field(default_factory=FlashFaults)


class Hardware:
    """Core, memories and peripherals of one chip, with a CAN bus and a serial line.

    Attributes:
        chip: Which one.
        clock: Its time.
        core: The processor.
        can: The CAN controller and its bus.
        usart: The serial port, with slcan on its line.
        flash: The flash.
        pins: The ports, from A.
        rcc: The clocks.
        watchdog: The independent watchdog.
        space: All registers by address.
        faults: What the image did that the core cannot do.
    """

    def __init__(
        self,
        chip: Chip,
        faults: Faults,
        heard: Callable[[CanFrame], None],
        restart: Callable[[str], None],
    ) -> None:
        """All parts as after power-up, with no image.

        Args:
            chip: What to build.
            faults: How it misbehaves.
            heard: Takes the frames that the board sends, on the bus and on the serial line.
            restart: Told the cause when something in the chip asks for a reset.
        """
        self.chip = chip
        self.faults: list[Fault] = []
        self.clock = Clock(chip.oscillators.internal)
        self.core = Core(self.clock, FLASH)
        self.core.on_fault = self._note_fault
        self.flash = chip.flash(self.clock, faults.flash)
        self.pins = [chip.gpio(f"GPIO{letter}") for letter in "ABCDEFGHI"[: len(chip.gpio_gates)]]
        self.rcc = chip.rcc(self.clock, chip.oscillators, self.flash.core_hz_max, faults.rcc)
        self.flash.on_wait_states = self.rcc.check_speeds
        self.can = BxCan(self.clock, self.rcc.apb1_hz, chip.can_banks, faults.can, heard)
        self.usart = Usart(self.clock, self.rcc.apb2_hz, SlcanLine(heard).take)
        self.space = AddressSpace(self.clock)
        self._systick = SysTick(self.clock)
        self._scb = SystemControl(chip.cpuid, lambda: restart("software"))
        self.watchdog = Watchdog(self.clock, chip.slow_hz, lambda: restart("watchdog"))
        self._peripherals = self._always_clocked() + self._gated()
        self._map()

    def flash_image(self, segments: list[tuple[int, bytes]]) -> None:
        """Writes an image, as a probe does, and resets the core.

        The image's pages become memory that cannot be written; behind all others is the flash's model.

        Args:
            segments: (address, bytes).
        """
        flash = self.flash
        for address, data in segments:
            offset = address - FLASH
            flash.memory[offset : offset + len(data)] = data
            flash.code_end = max(flash.code_end, -(-(offset + len(data)) // PAGE) * PAGE)
        self.core.add_rom(FLASH, bytes(flash.memory[: flash.code_end]))
        behind = Window(
            FLASH + flash.code_end,
            len(flash.memory) - flash.code_end,
            lambda address, width: flash.read(address - FLASH, width),
            lambda address, width, value: flash.write(address - FLASH, width, value),
        )
        self.core.add_registers(behind)
        self.core.reset()

    def restart(self, cause: str) -> None:
        """Resets the chip; a loss of power clears the RAM too.

        Args:
            cause: `power`, `software` or `watchdog`.
        """
        if cause == "power":
            for base, size in self.chip.ram:
                self.core.clear_ram(base, size)
        for _, peripheral in self._peripherals:
            peripheral.reset()
        self.rcc.restart(cause)
        self.core.reset()

    def _always_clocked(self) -> list[tuple[int, Peripheral]]:
        return [
            (self.chip.rcc_base, self.rcc),
            (self.chip.flash_base, self.flash),
            (WATCHDOG_BASE, self.watchdog),
            (SYSTICK_BASE, self._systick),
            (SCB_BASE, self._scb),
        ]

    def _gated(self) -> list[tuple[int, Peripheral]]:
        chip = self.chip
        gated: list[tuple[int, Peripheral]] = [(CAN_BASE, self.can), (chip.usart_base, self.usart)]
        gated += [(chip.gpio_base + GPIO_STRIDE * number, port) for number, port in enumerate(self.pins)]
        gates = [chip.can_gate, chip.usart_gate, *chip.gpio_gates]
        if chip.afio_gate is not None:
            gated.append((AFIO_BASE, Peripheral("AFIO", {0x00: Register("EVCR"), 0x04: Register("MAPR")})))
            gates.append(chip.afio_gate)
        for gate, (_, peripheral) in zip(gates, gated, strict=True):
            self.rcc.add_gate(*gate, peripheral)
        return gated

    def _map(self) -> None:
        space = self.space
        for base, peripheral in self._peripherals:
            space.attach(base, peripheral)
        self.can.access_directly(space.model, CAN_BASE)
        self._systick.access_directly(space.model, SYSTICK_BASE)
        space.model.direct = True
        for base, size in _WINDOWS:
            self.core.add_registers(Window(base, size, space.read, space.write, space.model))
        for base, size in self.chip.ram:
            self.core.add_ram(base, size)

    def _note_fault(self, fault: Fault) -> None:
        self.faults.append(fault)
        self._scb.note_fault(fault.cause, fault.address)


class EmulatedBoard:
    """A `Link` to a board. Time on the board passes within `receive` and `pass_time`, and only there.

    Attributes:
        hardware: Its parts.
        resets: Cause of each reset so far, after that of power-up.
        drift: By how much its time runs ahead of the simulator's, of 1.
    """

    def __init__(self, chip: Chip, image: Path, faults: Faults | None = None, *, serial: bool = False) -> None:
        """Flashes the image, and lets it run until it has settled.

        Args:
            chip: What to build.
            image: The `.elf`.
            faults: How the hardware misbehaves.
            serial: Its frames go over the serial line, as slcan text, rather than over the bus.

        Raises:
            OctetError: The image cannot be read.
            BoardError: It does what the hardware does not allow.
        """
        self.resets: list[str] = []
        self.drift = 0.0
        self._serial = serial
        self._said: deque[CanFrame] = deque()
        self._reset_cause: str | None = None
        self._deadline = NEVER
        self.hardware = Hardware(chip, faults or Faults(), self._receive, self._ask_reset)
        self.hardware.flash_image(load_segments(image))
        self._clock = self.hardware.clock
        self._alarm = self._clock.add(self._due)
        self._said.extend(self._listen(round(_BOOT_S * SECOND)))

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        if self._serial:
            self.hardware.usart.feed(encode(frame))
        else:
            self.put(CanFrame(frame.id, frame.data))

    def put(self, frame: CanFrame) -> None:
        """Another node on the bus wants to send a frame of any kind."""
        self.hardware.can.put(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`. Time is the board's: never faster than the wall clock, but for its drift; it may be slower.

        Raises:
            BoardError: The image does what the hardware does not allow.
        """
        began = time.monotonic()
        self._run_until(self._clock.now + round(timeout_s * (1 + self.drift) * SECOND))
        if self._said:
            frame = self._said.popleft()
            return Frame(-1, b"") if frame.extended or frame.remote else Frame(frame.id, frame.data)
        time.sleep(max(timeout_s - (time.monotonic() - began), 0.0))
        return None

    def pass_time(self, span_s: float) -> list[Frame]:
        """Lets so much time pass on the board, without waiting for it.

        Returns:
            What it sent meanwhile.
        """
        said = self._listen(round(span_s * SECOND))
        return [Frame(frame.id, frame.data) for frame in said]

    def cut_power(self) -> None:
        """Off and on again: only the flash is as before."""
        self.restart("power")

    def restart(self, cause: str) -> None:
        """Resets the chip, for a cause as `Hardware.restart` has them."""
        self.resets.append(cause)
        self._reset_cause = None
        self.hardware.restart(cause)

    def status(self) -> str:
        """How the board is, in a few words."""
        return f"is an emulated {self.hardware.chip.name}, and was reset {len(self.resets)} times"

    def close(self) -> None:
        """As in `Link`."""
        self._said.clear()

    def _listen(self, span: int) -> list[CanFrame]:
        """Lets so much time pass; returns all that was said until then."""
        end = self._clock.now + span
        heard: list[CanFrame] = []
        while self._clock.now < end:
            self._run_until(end)
            heard.extend(self._said)
            self._said.clear()
        return heard

    def _run_until(self, moment: int) -> None:
        """Runs until the board says something, at the latest until then."""
        self._deadline = moment
        self._alarm.set(moment)
        while not self._said and self._clock.now < moment:
            try:
                self.hardware.core.run()
            except PowerCut:
                self.cut_power()
            if self._reset_cause is not None:
                self.restart(self._reset_cause)

    def _due(self) -> int:
        if self._deadline <= self._clock.now:
            self._deadline = NEVER
            self.hardware.core.stop()
        return self._deadline

    def _receive(self, frame: CanFrame) -> None:
        self._said.append(frame)
        self.hardware.core.stop()

    def _ask_reset(self, cause: str) -> None:
        self._reset_cause = cause
        self.hardware.core.stop()


def start_board(name: str, faults: Faults | None = None, link: str = "bxcan") -> EmulatedBoard:
    """A board with the image that the build leaves for it, up and running.

    Args:
        name: `feather_stm32f405` or `blue_pill`.
        faults: How its hardware misbehaves.
        link: `bxcan` or `slcan`: which of its images.

    Raises:
        UsageError: No board has that name.
        OctetError: Its image is not built.
        BoardError: The image does what the hardware does not allow.
    """
    if name not in CHIPS:
        raise UsageError(f"no board {name!r}; there are {', '.join(CHIPS)}")
    return EmulatedBoard(CHIPS[name], image_path(name, link), faults, serial=link == "slcan")
