"""The bxCAN controller (RM0090 chapter 32, RM0008 chapter 24), as far as a driver that polls can see it."""

from collections.abc import Callable
from dataclasses import dataclass

from host_sim.emulator.can_errors import ErrorCounters
from host_sim.emulator.can_fifo import CanFifo
from host_sim.emulator.can_filters import CanFilters
from host_sim.emulator.can_frame import CanFrame, disregard
from host_sim.emulator.can_mailboxes import TransmitMailboxes
from host_sim.emulator.can_mode import Mode, ModeSwitch
from host_sim.emulator.can_wire import BITRATE, CanWire
from host_sim.emulator.clock import Clock
from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Peripheral, Register, ignore

_TXFP, _RFLM, _NART, _ABOM, _RESET = 1 << 2, 1 << 3, 1 << 4, 1 << 6, 1 << 15
_MCR_RESET = 0x00010002
_MSR_LEVELS = 0xC00
_BTR_RESET = 0x01230000
_TEST_MODES = 0xC0000000
_LEC = 0x70
_RATE_TOLERANCE = 0.005


@dataclass(frozen=True)
class CanFaults:
    """How a controller can misbehave.

    Attributes:
        inak_stuck: Set-up is never acknowledged.
        stuck_mailboxes: Numbers of mailboxes whose frames never leave.
    """

    inak_stuck: bool = False
    stuck_mailboxes: frozenset[int] = frozenset()


class BxCan(Peripheral):
    """The controller, its parts put together.

    Attributes:
        errors: The error counters.
        mailboxes: What is to be sent.
        fifos: The two receive FIFOs.
        on_requested: Called with each frame that the image wants sent.
    """

    def __init__(
        self, clock: Clock, wire: CanWire, bus_hz: Callable[[], int], banks: int, faults: CanFaults | None = None
    ) -> None:
        """A controller that sleeps.

        Args:
            clock: The board's.
            wire: The bus.
            bus_hz: Gives the speed of the controller's clock.
            banks: Number of filter banks.
            faults: How it misbehaves.
        """
        faults = faults or CanFaults()
        self._wire, self._bus_hz = wire, bus_hz
        self.errors = ErrorCounters()
        self.on_requested: Callable[[CanFrame], None] = disregard
        self.fifos = [CanFifo(number) for number in range(2)]
        self._filters = CanFilters(banks)
        self.mailboxes = TransmitMailboxes(self._requested, faults.stuck_mailboxes)
        self._switch = ModeSwitch(clock, self._enter, self._rejoin, inak_stuck=faults.inak_stuck)
        self._mcr = Register("MCR", _MCR_RESET, on_write=self._write_mcr)
        self._btr = Register("BTR", _BTR_RESET, on_write=self._write_btr)
        super().__init__("CAN1", self._control() | self.mailboxes.registers | self._filters.registers)
        wire.controller = self

    def _control(self) -> dict[int, Register]:
        own = {
            0x00: self._mcr,
            0x04: Register("MSR", on_read=self._read_msr, on_write=ignore),
            0x0C: self.fifos[0].status_register(),
            0x10: self.fifos[1].status_register(),
            0x14: Register("IER", on_write=self._write_ier),
            0x18: Register("ESR", on_read=self.errors.esr, on_write=self._write_esr),
            0x1C: self._btr,
        }
        for number, fifo in enumerate(self.fifos):
            own |= {0x1B0 + 0x10 * number + offset: register for offset, register in fifo.mailbox_registers().items()}
        return own

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self.errors.recover()
        self.mailboxes.reset()
        self._switch.reset()
        for fifo in self.fifos:
            fifo.reset()

    def listens(self) -> bool:
        """As in `Controller`."""
        return self._switch.mode is Mode.NORMAL and not self.errors.bus_off

    def offer(self) -> CanFrame | None:
        """As in `Controller`."""
        return self.mailboxes.offer()

    def lost_arbitration(self) -> None:
        """As in `Controller`."""
        self.mailboxes.lost_arbitration()

    def sent(self) -> None:
        """As in `Controller`."""
        self.errors.sent()
        self.mailboxes.sent()

    def failed(self, *, acknowledged: bool) -> None:
        """As in `Controller`."""
        self.errors.send_failed(acknowledged=acknowledged)
        self.mailboxes.failed(once=bool(self._mcr.value & _NART))
        if self.errors.bus_off and self._mcr.value & _ABOM:
            self._switch.recover()

    def arrived(self, frame: CanFrame) -> None:
        """As in `Controller`."""
        self.errors.received()
        number = self._filters.fifo_for(frame)
        if number is not None:
            self.fifos[number].push(frame)

    def _requested(self, frame: CanFrame) -> None:
        self.on_requested(frame)
        self._wire.wake()

    def _write_mcr(self, value: int) -> None:
        if value & _RESET:
            clocked = self.clocked
            self.reset()
            self.clocked = clocked
            return
        self._mcr.value = value
        self.mailboxes.by_request = bool(value & _TXFP)
        for fifo in self.fifos:
            fifo.locked = bool(value & _RFLM)
        self._switch.ask(value)

    def _enter(self, mode: Mode) -> None:
        """Leaving set-up is also how an image asks for the end of a bus-off."""
        if mode is not Mode.NORMAL:
            return
        rate = self._bit_rate()
        if abs(rate - BITRATE) > BITRATE * _RATE_TOLERANCE:
            raise BoardError(f"CAN1 was set up for {rate:.0f} bit/s, on a bus of {BITRATE}")
        if self.errors.bus_off:
            self._switch.recover()
        self._wire.wake()

    def _rejoin(self) -> None:
        self.errors.recover()
        self._wire.wake()

    def _bit_rate(self) -> float:
        btr = self._btr.value
        quanta = 1 + (btr >> 16 & 0xF) + 1 + (btr >> 20 & 0x7) + 1
        return self._bus_hz() / ((btr & 0x3FF) + 1) / quanta

    def _read_msr(self) -> int:
        return self._switch.mode.value | _MSR_LEVELS

    def _write_btr(self, value: int) -> None:
        if self._switch.mode is not Mode.INIT:
            raise BoardError("CAN1 BTR was written outside set-up")
        if value & _TEST_MODES:
            raise BoardError("CAN1 was set to loop back or silence, which is not modelled")
        self._btr.value = value

    def _write_ier(self, value: int) -> None:
        if value:
            raise BoardError("CAN1 interrupts were enabled, which are not modelled")

    def _write_esr(self, value: int) -> None:
        self.errors.last = (value & _LEC) >> 4
