"""The acceptance filters of the bxCAN."""

from collections.abc import Callable

from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.errors import BoardError
from host_sim.emulator.registers import Register

BASE = 0x200
"""Offset of the filters' registers."""

_FINIT = 1
_FMR_RESET = 0x2A1C0E01
_BANKS = 0x40


def _word_32(frame: CanFrame) -> int:
    remote = 2 if frame.remote else 0
    return (frame.id << 3 | 4 if frame.extended else frame.id << 21) | remote


def _word_16(frame: CanFrame) -> int:
    remote = 1 << 4 if frame.remote else 0
    if frame.extended:
        return frame.id >> 18 << 5 | remote | 1 << 3 | frame.id >> 15 & 7
    return frame.id << 5 | remote


def _halves(*words: int) -> list[int]:
    return [half for word in words for half in (word & 0xFFFF, word >> 16)]


class CanFilters:
    """Decides which FIFO a frame goes to, if any.

    Attributes:
        registers: By their offset from the beginning of the bxCAN.
    """

    def __init__(self, banks: int) -> None:
        """No filter is active.

        Args:
            banks: How many the chip has.
        """
        self._banks = banks
        self._fmr = Register("FMR", _FMR_RESET)
        self._mode = Register("FM1R", on_write=self._in_init("_mode"))
        self._scale = Register("FS1R", on_write=self._in_init("_scale"))
        self._assignment = Register("FFA1R", on_write=self._in_init("_assignment"))
        self._active = Register("FA1R")
        self._values = [
            Register(f"F{bank}R{half + 1}", on_write=self._bank_writer(bank, half))
            for bank in range(banks)
            for half in range(2)
        ]
        named = {0x00: self._fmr, 0x04: self._mode, 0x0C: self._scale, 0x14: self._assignment, 0x1C: self._active}
        values = {_BANKS + 4 * i: register for i, register in enumerate(self._values)}
        self.registers = {BASE + offset: register for offset, register in (named | values).items()}

    def fifo_for(self, frame: CanFrame) -> int | None:
        """Number of the FIFO that takes the frame; None: no filter lets it through."""
        if self._fmr.value & _FINIT:
            return None
        for bank in range(self._banks):
            if self._bit(self._active, bank) and self._passes(bank, frame):
                return self._bit(self._assignment, bank)
        return None

    def _passes(self, bank: int, frame: CanFrame) -> bool:
        first, second = (register.value for register in self._values[2 * bank : 2 * bank + 2])
        if self._bit(self._scale, bank):
            word, values = _word_32(frame), [first, second]
        else:
            word, values = _word_16(frame), _halves(first, second)
        if self._bit(self._mode, bank):
            return word in values
        return any((word ^ wanted) & mask == 0 for wanted, mask in zip(values[::2], values[1::2], strict=True))

    @staticmethod
    def _bit(register: Register, bank: int) -> int:
        return register.value >> bank & 1

    def _in_init(self, attribute: str) -> Callable[[int], None]:
        def write(value: int) -> None:
            register: Register = getattr(self, attribute)
            if not self._fmr.value & _FINIT:
                raise BoardError(f"CAN1 {register.name} was written outside the filters' set-up (FMR FINIT)")
            register.value = value

        return write

    def _bank_writer(self, bank: int, half: int) -> Callable[[int], None]:
        def write(value: int) -> None:
            register = self._values[2 * bank + half]
            if self._bit(self._active, bank) and not self._fmr.value & _FINIT:
                raise BoardError(f"CAN1 {register.name} was written while its filter is active")
            register.value = value

        return write
