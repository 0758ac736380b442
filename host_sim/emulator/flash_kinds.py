"""The flash of each family of chips (F1: PM0075, F4: RM0090 3, G4: RM0440 5)."""

from collections.abc import Mapping
from typing import ClassVar

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.flash import BASE, ERASED, OUTLIVES, PG, Flash, FlashFaults
from host_sim.emulator.registers import Register

_F1_PGERR = 1 << 2
_F4_OPERR, _F4_PGPERR, _F4_PGSERR = 1 << 1, 1 << 6, 1 << 7
_G4_PROGERR, _G4_PGAERR, _G4_SIZERR, _G4_PGSERR = 1 << 3, 1 << 5, 1 << 6, 1 << 7
_G4_ERRORS, _G4_TWO_BITS, _G4_ONE_BIT = 0xC3FA, 1 << 31, 1 << 30
_F4_SNB_SHIFT, _F4_PSIZE_SHIFT = 3, 8


class FlashF1(Flash):
    """Flash of the STM32F103C8: a half-word is written once per erase, but 0 can overwrite any value."""

    pages = (1024,) * 64
    hz_per_wait_state = 24_000_000
    write_span = 52 * SECOND // 10**6
    erase_span: ClassVar[Mapping[int, int]] = {1024: 30 * SECOND // 1000}
    start = 1 << 6
    lock = 1 << 7
    acr = 0x30
    failure = _F1_PGERR

    def __init__(self, clock: Clock, faults: FlashFaults) -> None:
        """As in `Flash`."""
        super().__init__(clock, faults)
        self._address = self.registers[0x14] = Register("AR")

    def refusal(self, offset: int, size: int, value: int) -> int:
        """As in `Flash`."""
        half_word, erased = 2, 0xFFFF
        programming = self._cr.value & PG and size == half_word
        return 0 if programming and (self.read(offset, size) == erased or value == 0) else _F1_PGERR

    def page_to_erase(self) -> int:
        """As in `Flash`."""
        return (self._address.value - BASE) // self.pages[0]


class FlashF4(Flash):
    """Flash of the STM32F405: bits can be cleared at any time, in units of the size set in CR."""

    pages = (16 << 10,) * 4 + (64 << 10,) + (128 << 10,) * 7
    hz_per_wait_state = 30_000_000
    write_span = 16 * SECOND // 10**6
    erase_span: ClassVar[Mapping[int, int]] = {
        16 << 10: SECOND // 2,
        64 << 10: 11 * SECOND // 10,
        128 << 10: 2 * SECOND,
    }
    failure = _F4_OPERR
    data_cache = 1 << 10

    def refusal(self, offset: int, size: int, value: int) -> int:  # noqa: ARG002 - any place, any value
        """As in `Flash`."""
        if not self._cr.value & PG:
            return _F4_PGSERR
        return 0 if size == 1 << (self._cr.value >> _F4_PSIZE_SHIFT & 3) else _F4_PGPERR

    def page_to_erase(self) -> int:
        """As in `Flash`."""
        return self._cr.value >> _F4_SNB_SHIFT & 0xF


class FlashG4(Flash):
    """Flash of the STM32G431xB: two words are written at once, with eight bits of error correction.

    Attributes:
        unreadable: Offsets of double words with uncorrectable errors, left by power failures during writes.
    """

    pages = (2048,) * 64
    hz_per_wait_state = 30_000_000
    write_span = 82 * SECOND // 10**6
    erase_span: ClassVar[Mapping[int, int]] = {2048: 22 * SECOND // 1000}
    failure = _F4_OPERR
    offsets = (0x08, 0x10, 0x14)
    acr = 0x40600
    option_lock = 1 << 30
    data_cache = 1 << 10
    _WORD, _DOUBLE = 4, 8

    def __init__(self, clock: Clock, faults: FlashFaults) -> None:
        """As in `Flash`."""
        super().__init__(clock, faults)
        self.unreadable: set[int] = set()
        self._first: tuple[int, int] | None = None
        self._eccr = self.registers[0x18] = Register("ECCR", on_write=self._write_eccr)

    def reset(self) -> None:
        """As in `Peripheral`; the memory keeps its contents."""
        super().reset()
        self._first = None

    def read(self, offset: int, size: int) -> int:
        """As in `Flash`; an uncorrectable error is noted and raises an interrupt."""
        place = offset - offset % self._DOUBLE
        if place in self.unreadable:
            if not self._eccr.value & _G4_TWO_BITS:
                self._eccr.value |= _G4_TWO_BITS | place
            self.on_unreadable()
        return super().read(offset, size)

    def write(self, offset: int, size: int, value: int) -> None:
        """As in `Flash`; the second word of a pair starts the operation."""
        first, self._first = self._first, None
        if not self._cr.value & PG or self._sr.value & _G4_ERRORS:
            self._sr.value |= _G4_PGSERR
        elif size != self._WORD:
            self._sr.value |= _G4_SIZERR
        elif first is None and offset % self._DOUBLE == 0:
            self._first = offset, value
        elif first is None or offset != first[0] + self._WORD:
            self._sr.value |= _G4_PGAERR
        else:
            super().write(first[0], self._DOUBLE, first[1] | value << 32)

    def refusal(self, offset: int, size: int, value: int) -> int:
        """As in `Flash`; a double word that is not erased accepts zeros only."""
        blank = self.memory[offset : offset + size] == ERASED * size and offset not in self.unreadable
        return 0 if blank or value == 0 else _G4_PROGERR

    def changed(self, offset: int, size: int, *, cut: bool) -> None:
        """As in `Flash`."""
        kept = OUTLIVES if cut and size > self._DOUBLE else 0
        self.unreadable -= set(range(offset + kept, offset + size, self._DOUBLE))
        if cut and size == self._DOUBLE:
            self.unreadable.add(offset)

    def page_to_erase(self) -> int:
        """As in `Flash`."""
        return self._cr.value >> _F4_SNB_SHIFT & 0x7F

    def _write_eccr(self, value: int) -> None:
        self._eccr.value &= ~(value & (_G4_TWO_BITS | _G4_ONE_BIT))
        if not self._eccr.value & _G4_TWO_BITS:
            self._eccr.value = 0
