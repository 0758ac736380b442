"""The hardware of a board: one chip with its memories and peripherals, a CAN bus and a serial line."""

import random
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

from host_sim.emulator.board_pins import read_pins
from host_sim.emulator.can import CanFaults, CanFrame
from host_sim.emulator.chips import CAN_BASE, SYSTICK_BASE, Chip
from host_sim.emulator.clock import Clock
from host_sim.emulator.converter import Converter, Dma, Multiplexer
from host_sim.emulator.core import PAGE, Core, Fault
from host_sim.emulator.flash import BASE as FLASH
from host_sim.emulator.flash import FlashFaults
from host_sim.emulator.rcc import RccFaults
from host_sim.emulator.registers import AddressSpace, KeptPeripheral, Peripheral, Register, Window
from host_sim.emulator.robot_on_pins import RobotOnPins, Wiring
from host_sim.emulator.serial import SlcanLine
from host_sim.emulator.system import SystemControl, SysTick, Watchdog
from host_sim.emulator.timers import MotorTimer, Timer

_WORDS = 2
"""Number of registers, each for 32 interrupts."""


class Interrupts(Peripheral):
    """Tracks which interrupts are enabled and which are pending.

    Attributes:
        on_pending: Called when an enabled interrupt is pending.
    """

    def __init__(self) -> None:
        """Starts with none enabled or pending."""
        self.on_pending: Callable[[], None] = lambda: None
        self._enabled = self._pending = 0
        registers = {}
        for word in range(_WORDS):
            registers[0x000 + 4 * word] = self._register(f"ISER{word}", 32 * word, 1, 0)
            registers[0x080 + 4 * word] = self._register(f"ICER{word}", 32 * word, -1, 0)
            registers[0x100 + 4 * word] = self._register(f"ISPR{word}", 32 * word, 0, 1)
            registers[0x180 + 4 * word] = self._register(f"ICPR{word}", 32 * word, 0, -1)
        super().__init__("NVIC", registers, clocked=True)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._enabled = self._pending = 0

    def pend(self, number: int) -> None:
        """Makes an interrupt pending."""
        self._pending |= 1 << number
        self._tell()

    def acknowledge(self) -> int | None:
        """Returns the lowest number of an enabled pending interrupt, which then is pending no longer."""
        due = self._enabled & self._pending
        lowest = due & -due
        self._pending &= ~lowest
        return lowest.bit_length() - 1 if due else None

    @property
    def wakes(self) -> bool:
        """Whether an enabled interrupt is pending."""
        return bool(self._enabled & self._pending)

    def _tell(self) -> None:
        if self.wakes:
            self.on_pending()

    def _register(self, name: str, shift: int, enabled: int, pending: int) -> Register:
        """A register in which ones set (1) or clear (-1) enable or pending bits."""

        def on_write(value: int) -> None:
            bits = value << shift
            if enabled:
                self._enabled = self._enabled | bits if enabled > 0 else self._enabled & ~bits
            if pending:
                self._pending = self._pending | bits if pending > 0 else self._pending & ~bits
            self._tell()

        def on_read() -> int:
            return (self._enabled if enabled else self._pending) >> shift & 0xFFFFFFFF

        return Register(name, on_read=on_read, on_write=on_write)


_TIM1_UP = 25
_WINDOWS = ((0x40000000, 0x80000), (0x48000000, 2 * PAGE), (0x50000000, PAGE), (0xE000E000, PAGE))
"""Address ranges of registers, (base, bytes)."""


@dataclass(frozen=True)
class Faults:
    """Hardware faults to simulate, by part.

    Attributes:
        rcc: Faults of the clocks.
        can: Faults of the CAN controller.
        flash: Faults of the flash.
    """

    rcc: RccFaults = field(default_factory=RccFaults)
    can: CanFaults = field(default_factory=CanFaults)
    flash: FlashFaults = field(default_factory=FlashFaults)


class Hardware:
    """Core, memories and peripherals of one chip, with a CAN bus and a serial line.

    Attributes:
        chip: The chip.
        clock: The board's clock.
        core: The processor.
        can: The CAN controller and its bus.
        usart: The serial port, with slcan on its line.
        flash: The flash.
        power: The supply monitor.
        pins: The GPIO ports, from A.
        rcc: The clocks.
        watchdog: The independent watchdog.
        wiring: The connections of its pins.
        space: All registers by address.
        faults: Fault exceptions that the image caused.
        peripherals: All parts with registers.
        interrupts: The interrupt controller.
        robot: Motors, sensors and other parts wired to its pins; None if the board has none.
    """

    def __init__(
        self,
        chip: Chip,
        faults: Faults,
        heard: Callable[[CanFrame], None],
        restart: Callable[[str], None],
    ) -> None:
        """Creates all parts in their power-up state, without an image.

        Args:
            chip: The chip to emulate.
            faults: Faults to simulate.
            heard: Called with each frame that the board sends, on the bus or on the serial line.
            restart: Called with the cause when a part of the chip requests a reset.
        """
        self.chip, self._heard = chip, heard
        self.faults: list[Fault] = []
        self.clock = Clock(chip.oscillators.internal)
        self.core = Core(self.clock, FLASH)
        self.core.on_fault = self._note_fault
        self.flash = chip.flash(self.clock, faults.flash)
        self.pins = [chip.gpio(name) for name in chip.places if name.startswith("GPIO")]
        self.rcc = chip.rcc(self.clock, chip.oscillators, self.flash.core_hz_max, faults.rcc)
        self.flash.on_wait_states = self.rcc.check_speeds
        self.can = chip.can(self.clock, self.rcc.can_hz, faults.can, self._hear)
        self._line = SlcanLine(heard)
        self.usart = chip.usart(self.clock, self.rcc.usart_hz, self._hear_byte)
        self.space = AddressSpace(self.clock)
        self.power = chip.power()
        self._systick = SysTick(self.clock)
        self._scb = SystemControl(chip.cpuid, lambda: restart("software"), self._move_vectors)
        self.watchdog = Watchdog(self.clock, chip.slow_hz, lambda: restart("watchdog"))
        self.interrupts = Interrupts()
        self.core.wakes = lambda: self.interrupts.wakes
        self.core.acknowledge = self.interrupts.acknowledge
        self.interrupts.on_pending = self.core.request
        self.flash.on_unreadable = self.core.interrupt
        self.core.on_exception = self._scb.enter
        self.robot: RobotOnPins | None = None
        self.peripherals: list[Peripheral] = [
            *(self.rcc, self.flash, self.watchdog, self._systick, self._scb, self.interrupts),
            *(self.can, self.power, self.usart, *self.pins),
        ]
        mapr = Register("MAPR") if "AFIO" in chip.places else None
        if mapr is not None:
            self.peripherals.append(Peripheral("AFIO", {0x00: Register("EVCR"), 0x04: mapr}))
        self.wiring = Wiring(read_pins(chip.name), self.pins, mapr)
        if chip.converter is not None:
            self._add_robot(chip.converter)
        self._map()

    @property
    def on_bus(self) -> bool:
        """Whether the CAN controller is routed to the pins wired to the bus."""
        return self.wiring.meets("CAN_RX", "CAN_TX")

    def flash_image(self, segments: list[tuple[int, bytes]]) -> None:
        """Writes an image, as a probe does, and resets the core.

        The image's pages become read-only memory; all others are handled by the flash's model.

        Args:
            segments: (address, bytes).
        """
        flash = self.flash
        for address, data in segments:
            offset = address - FLASH
            flash.memory[offset : offset + len(data)] = data
            flash.code_end = max(flash.code_end, -(-(offset + len(data)) // PAGE) * PAGE)
        self.core.add_rom(FLASH, bytes(flash.memory[: flash.code_end]))
        self.core.add_registers(self._flash_window(flash.code_end, len(flash.memory)))
        self.core.reset()

    def _flash_window(self, begin: int, end: int) -> Window:
        flash = self.flash
        return Window(
            FLASH + begin,
            end - begin,
            lambda address, width: flash.read(address - FLASH, width),
            lambda address, width, value: flash.write(address - FLASH, width, value),
        )

    def _move_vectors(self, address: int) -> None:
        """Sets the vector table; takes effect between two basic blocks."""
        self.core.vectors = address

    def restart(self, cause: str) -> None:
        """Resets the chip; a loss of power scrambles the RAM too.

        Args:
            cause: `power`, `software` or `watchdog`.
        """
        if cause == "power":
            self._scramble_ram()
        for peripheral in self.peripherals:
            peripheral.reset()
        self.rcc.restart(cause)
        self.core.reset()

    def _add_robot(self, create_converter: Callable[[int, Callable[[], int], Dma, Clock], Converter]) -> None:
        """Adds the peripherals and the wiring of a robot with a body on pins."""
        places, rcc = self.chip.places, self.rcc
        multiplexer = Multiplexer() if "DMAMUX" in places else None
        pend, filters = partial(self.interrupts.pend, _TIM1_UP), multiplexer is not None  # as a G4 has both
        motors = MotorTimer(self.clock, rcc.apb2_hz, pend, filters=filters)
        timers = {name: Timer(name, wide=name in self.chip.wide) for name in ("TIM2", "TIM3", "TIM4")}
        dma = Dma(multiplexer)
        converter = create_converter(places["ADC1"][0], rcc.adc_hz, dma, self.clock)
        self.peripherals += [motors, *timers.values(), dma, converter, *([multiplexer] if multiplexer else [])]
        self.robot = RobotOnPins(self.core, self.wiring, motors, timers, converter)

    def _map(self) -> None:
        space = self.space
        for peripheral in self.peripherals:
            base, *gate = self.chip.places[peripheral.name]
            if gate:
                self.rcc.add_gate(peripheral, *gate)
            space.attach(base, peripheral)
            if isinstance(peripheral, KeptPeripheral):
                peripheral.keep_in(space.model, base)
        self.can.access_directly(space.model, CAN_BASE)
        self._systick.access_directly(space.model, SYSTICK_BASE)
        space.model.direct = True
        for base, size in _WINDOWS:
            self.core.add_registers(Window(base, size, space.read, space.write, space.model))
        for base, size in self.chip.ram:
            self.core.add_ram(base, size)
        self._scramble_ram()

    def _scramble_ram(self) -> None:
        """Fills the RAM with noise, as a loss of power does; the same each time."""
        for base, size in self.chip.ram:
            self.core.write(base, random.Random(base).randbytes(size))

    def _hear(self, frame: CanFrame) -> None:
        if self.on_bus:
            self._heard(frame)

    def _hear_byte(self, byte: int) -> None:
        if self.wiring.meets("UART_TX"):
            self._line.take(byte)

    def feed_line(self, text: bytes) -> None:
        """Feeds received text to the serial port."""
        if self.wiring.meets("UART_RX"):
            self.usart.feed(text)

    def _note_fault(self, fault: Fault) -> None:
        self.faults.append(fault)
        self._scb.note_fault(fault.cause, fault.address)
