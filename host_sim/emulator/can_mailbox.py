"""One transmit mailbox of the bxCAN."""

from collections.abc import Callable

from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Register

RQCP, TXOK, ALST, TERR, ABRQ = 0x01, 0x02, 0x04, 0x08, 0x80
"""Bits of TSR; those of mailbox n are shifted left by 8 n."""

_TXRQ, _RTR, _IDE = 1, 2, 4
_UNDEFINED = 0xA5A5A5A5
"""What the registers hold before they are written: anything."""


class Mailbox:
    """Holds a frame, and tells what became of it.

    Attributes:
        registers: By their offset within the mailbox.
        pending: Its frame is to be sent.
        aborting: It is to be given up.
        status: RQCP, TXOK, ALST, TERR.
    """

    def __init__(self, number: int, requested: Callable[[int], None]) -> None:
        """An empty mailbox.

        Args:
            number: 0..2.
            requested: Told the number when the image wants the frame sent.
        """
        self._number, self._requested = number, requested
        self.registers = {
            0x0: Register(f"TI{number}R", 0, on_write=self._write_identifier),
            0x4: Register(f"TDT{number}R", _UNDEFINED, on_write=self._writer(0x4)),
            0x8: Register(f"TDL{number}R", _UNDEFINED, on_write=self._writer(0x8)),
            0xC: Register(f"TDH{number}R", _UNDEFINED, on_write=self._writer(0xC)),
        }
        self.reset()

    def reset(self) -> None:
        """Empty again."""
        self.pending = self.aborting = False
        self.status = 0

    def frame(self) -> CanFrame:
        """The frame that it holds."""
        identifier, control, low, high = (register.value for register in self.registers.values())
        extended, remote = bool(identifier & _IDE), bool(identifier & _RTR)
        data = (low | high << 32).to_bytes(8, "little")[: min(control & 0xF, 8)]
        return CanFrame(identifier >> 3 if extended else identifier >> 21, data, extended, remote)

    def end(self, status: int) -> None:
        """The request is done with, for better or worse."""
        self.pending = self.aborting = False
        self.status = RQCP | status
        self.registers[0x0].value &= ~_TXRQ

    def clear(self, written: int) -> None:
        """Ones written to its part of TSR clear flags; RQCP takes all others along."""
        self.status &= 0 if written & RQCP else ~written

    def _write_identifier(self, value: int) -> None:
        self._keep(0x0, value)
        if value & _TXRQ:
            self.pending, self.status = True, 0
            self._requested(self._number)

    def _writer(self, offset: int) -> Callable[[int], None]:
        return lambda value: self._keep(offset, value)

    def _keep(self, offset: int, value: int) -> None:
        if self.pending:
            raise BoardError(f"CAN1 transmit mailbox {self._number} was written while its frame is pending")
        self.registers[offset].value = value
