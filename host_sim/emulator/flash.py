"""The chip's internal flash (F1: PM0075, F4: RM0090 3, G4: RM0440 5). The core stalls during operations."""

from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import ClassVar

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.registers import BoardError, Peripheral, PowerCut, Register

BASE = 0x08000000
ERASED = b"\xff"
_KEYS = (0x45670123, 0xCDEF89AB)
OUTLIVES = 16
"""Bytes at the start of a page that an interrupted erase leaves unchanged; the rest reads blank."""
_WAIT_STATES = 7
_UNFINISHED = 0x0F
"""Bits of a byte that are not yet written when power fails during a write."""

PG, _ERASE = 1 << 0, 1 << 1


@dataclass(frozen=True)
class FlashFaults:
    """Faults of the flash. Writes and erases are counted together, from 1.

    Attributes:
        failing: Numbers of the operations that fail: they set an error flag and change nothing.
        cut_at: Number of the operation during which power fails.
    """

    failing: frozenset[int] = frozenset()
    cut_at: int = 0


class Flash(Peripheral):
    """Non-volatile memory, and the registers that control it.

    Attributes:
        memory: Its contents.
        operations: Number of writes and erases so far.
        erasures: Number of erases so far.
        cuts: Numbers of the operations during which power fails.
        erasure_cuts: Numbers of the erases during which power fails.
        code_end: Offset of the end of the image, which must not overwrite itself.
        on_wait_states: Called when the wait states have changed.
        on_unreadable: Called when the core has read data with an uncorrectable error.
    """

    pages: ClassVar[Sequence[int]]
    """Size of each page or sector in bytes, from the lowest."""
    hz_per_wait_state: ClassVar[int]
    """Fastest core clock without wait states, and the increase by each of them, Hz."""
    write_span: ClassVar[int]
    """Time to write one unit, fs."""
    erase_span: ClassVar[Mapping[int, int]]
    """Time to erase a page, fs, by the size of the page."""
    start: ClassVar[int] = 1 << 16
    """Bit STRT of CR."""
    lock: ClassVar[int] = 1 << 31
    """Bit LOCK of CR."""
    option_lock: ClassVar[int] = 0
    """Bit OPTLOCK of CR."""
    failure: ClassVar[int]
    """Flag of SR for an internal error."""
    offsets: ClassVar[tuple[int, int, int]] = (0x04, 0x0C, 0x10)
    """Offsets of KEYR, SR and CR."""
    acr: ClassVar[int] = 0
    """Reset value of ACR."""
    data_cache: ClassVar[int] = 0
    """Bit DCEN of ACR; 0 if there is no such cache."""

    def __init__(self, clock: Clock, faults: FlashFaults) -> None:
        """Creates an erased flash.

        Args:
            clock: The board's clock.
            faults: Faults to simulate.
        """
        self._clock, self._faults = clock, faults
        self.memory = bytearray(ERASED) * sum(self.pages)
        self._half_erased: set[int] = set()
        self.cuts = {faults.cut_at}
        self.erasure_cuts: set[int] = set()
        self.operations = self.erasures = self.code_end = self._keys_taken = 0
        self.on_wait_states: Callable[[], None] = lambda: None
        self.on_unreadable: Callable[[], None] = lambda: None
        self._acr = Register("ACR", self.acr, on_write=self._write_acr)
        self._cr = Register("CR", self.lock | self.option_lock, on_write=self._write_cr)
        self._sr = Register("SR", on_write=self._write_sr)
        keyr, sr, cr = self.offsets
        registers = {0x00: self._acr, keyr: Register("KEYR", on_write=self._write_key), sr: self._sr, cr: self._cr}
        super().__init__("FLASH", registers, clocked=True)

    def fill_last_page(self, size: int) -> None:
        """Simulates long use: fills the blank places of the last page in use with the latest record.

        Args:
            size: Size of a place, bytes.
        """
        end = -(-len(self.memory.rstrip(ERASED)) // size) * size
        room = sum(self.pages[: self._page_of(end - 1) + 1]) - end
        self.memory[end : end + room] = self.memory[end - size : end] * (room // size)

    @abstractmethod
    def refusal(self, offset: int, size: int, value: int) -> int:
        """SR flags for a write that the hardware rejects; 0 if it accepts the write."""

    @abstractmethod
    def page_to_erase(self) -> int:
        """Number of the page selected by the registers."""

    def changed(self, offset: int, size: int, *, cut: bool) -> None:
        """Called after bytes were written or erased, or power failed meanwhile."""

    def reset(self) -> None:
        """As in `Peripheral`; the memory keeps its contents."""
        super().reset()
        self._keys_taken = 0

    def core_hz_max(self) -> int:
        """The fastest core clock that the current wait states allow, Hz."""
        return ((self._acr.value & _WAIT_STATES) + 1) * self.hz_per_wait_state

    def read(self, offset: int, size: int) -> int:
        """Reads the memory on behalf of the core."""
        return int.from_bytes(self.memory[offset : offset + size], "little")

    def write(self, offset: int, size: int, value: int) -> None:
        """Writes to the memory on behalf of the core.

        Raises:
            BoardError: The address is within the image, or the data written would not last.
            PowerCut: Power failed during the write.
        """
        self._protect(offset)
        if value and self._page_of(offset) in self._half_erased:
            raise BoardError(f"page {self._page_of(offset)} of the flash was written, but its erase was cut short")
        flags = self.refusal(offset, size, value)
        if flags:
            self._sr.value |= flags
            return
        old = self.memory[offset : offset + size]
        whole = bytes(was & new for was, new in zip(old, value.to_bytes(size, "little"), strict=True))
        self._change(offset, whole, bytes(was & (new | _UNFINISHED) for was, new in zip(old, whole, strict=True)))
        self._clock.skip(self.write_span)

    def _erase(self, page: int) -> None:
        if page >= len(self.pages):
            raise BoardError(f"page {page} of the flash was to be erased, of {len(self.pages)}")
        if self._acr.value & self.data_cache:
            raise BoardError(f"page {page} of the flash was to be erased while the data cache would still show it")
        size, offset = self.pages[page], sum(self.pages[:page])
        self._protect(offset)
        self.erasures += 1
        self._half_erased.add(page)
        if self.erasures in self.erasure_cuts:
            self.cuts.add(self.operations + 1)
        blank = ERASED * size
        self._change(offset, blank, bytes(self.memory[offset : offset + OUTLIVES]) + blank[OUTLIVES:])
        self._half_erased.discard(page)
        self._clock.skip(self.erase_span[size])

    def _change(self, offset: int, whole: bytes, partial: bytes) -> None:
        self.operations += 1
        if self.operations in self._faults.failing:
            self._sr.value |= self.failure
            return
        cut = self.operations in self.cuts
        self.memory[offset : offset + len(whole)] = partial if cut else whole
        self.changed(offset, len(whole), cut=cut)
        if cut:
            raise PowerCut

    def _page_of(self, offset: int) -> int:
        return next(page for page, end in enumerate(accumulate(self.pages)) if offset < end)

    def _protect(self, offset: int) -> None:
        if offset < self.code_end:
            raise BoardError(f"the image was about to change itself at 0x{BASE + offset:08X}")

    def _write_acr(self, value: int) -> None:
        self._acr.value = value
        self.on_wait_states()

    def _write_cr(self, value: int) -> None:
        if self._cr.value & self.lock:
            raise BoardError("FLASH CR was written while it is locked")
        self._cr.value = value & ~self.start | self._cr.value & self.option_lock
        if value & self.start and value & _ERASE:
            self._erase(self.page_to_erase())

    def _write_key(self, value: int) -> None:
        """Unlocks after both keys in order; a wrong key locks the flash until reset."""
        if self._keys_taken >= len(_KEYS) or value != _KEYS[self._keys_taken]:
            raise BoardError(f"FLASH KEYR was written with the wrong key 0x{value:08X}, which locks it until a reset")
        self._keys_taken += 1
        if self._keys_taken == len(_KEYS):
            self._keys_taken = 0
            self._cr.value &= ~self.lock

    def _write_sr(self, value: int) -> None:
        self._sr.value &= ~value


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
