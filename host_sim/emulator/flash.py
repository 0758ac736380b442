"""The chip's own flash: what both families have alike. While it works, the core stands still."""

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from host_sim.emulator.clock import Clock
from host_sim.emulator.errors import BoardError, PowerCut
from host_sim.emulator.registers import Peripheral, Register

BASE = 0x08000000
ERASED = 0xFF
_KEYS = (0x45670123, 0xCDEF89AB)
_WAIT_STATES = 7
_UNFINISHED = 0x0F
"""Bits of a byte that are not written yet when the power goes in the middle."""


@dataclass(frozen=True)
class FlashFaults:
    """How the flash can misbehave. Writes and erasures are counted together, from 1.

    Attributes:
        failing: Numbers of those that fail: an error flag, and nothing is changed.
        cut_at: Number of that in whose middle the power goes.
    """

    failing: frozenset[int] = frozenset()
    cut_at: int = 0


@dataclass(frozen=True)
class FlashKind:
    """What one chip's flash is like.

    Attributes:
        pages: Size of each page or sector in bytes, from the lowest.
        hz_per_wait_state: Each wait state lets the core run faster by so much.
        write_span: Time to write one unit, fs.
        erase_span: Time to erase a page, fs.
    """

    pages: Sequence[int]
    hz_per_wait_state: int
    write_span: int
    erase_span: int


class Flash(Peripheral):
    """Memory that survives, and the registers through which it is changed.

    Attributes:
        memory: All of its bytes.
        operations: Writes and erasures so far.
        erasures: These alone.
        code_end: Offset in the memory up to which the image lies; it must not change that.
    """

    def __init__(
        self, clock: Clock, kind: FlashKind, faults: FlashFaults, *, lock: int, registers: dict[int, Register]
    ) -> None:
        """An erased flash.

        Args:
            clock: The board's.
            kind: The chip's.
            faults: How it misbehaves.
            lock: Bit LOCK of CR.
            registers: What the family adds, by offset.
        """
        self._clock, self._kind, self._faults, self._lock = clock, kind, faults, lock
        self.memory = bytearray([ERASED]) * sum(kind.pages)
        self.operations = self.erasures = 0
        self.code_end = 0
        self._keys_taken = 0
        self._acr, self._cr = Register("ACR"), Register("CR", lock, on_write=self._write_cr)
        self._sr = Register("SR", on_write=self._write_sr)
        common = {0x00: self._acr, 0x04: Register("KEYR", on_write=self._write_key), 0x0C: self._sr, 0x10: self._cr}
        super().__init__("FLASH", common | registers, clocked=True)

    @abstractmethod
    def start_bit(self) -> int:
        """Bit STRT of CR."""

    @abstractmethod
    def refusal(self, offset: int, size: int, value: int) -> int:
        """Flags of SR for a write that the hardware refuses; 0 for one that it does."""

    @abstractmethod
    def page_to_erase(self) -> int | None:
        """Number of the page that the registers name; None if no page is to be erased."""

    @property
    @abstractmethod
    def failure(self) -> int:
        """Flag of SR for what went wrong inside."""

    def reset(self) -> None:
        """As in `Peripheral`; the memory stays."""
        super().reset()
        self._keys_taken = 0

    def core_hz_max(self) -> int:
        """The fastest clock that it can follow as it is set up."""
        return ((self._acr.value & _WAIT_STATES) + 1) * self._kind.hz_per_wait_state

    def read(self, offset: int, size: int) -> int:
        """What the core reads from the memory."""
        return int.from_bytes(self.memory[offset : offset + size], "little")

    def write(self, offset: int, size: int, value: int) -> None:
        """The core writes to the memory.

        Raises:
            BoardError: That is where the image is.
            PowerCut: The power went in the middle.
        """
        self._protect(offset)
        flags = self.refusal(offset, size, value)
        if flags:
            self._sr.value |= flags
            return
        old = self.memory[offset : offset + size]
        whole = bytes(was & new for was, new in zip(old, value.to_bytes(size, "little"), strict=True))
        self._change(offset, whole, bytes(was & (new | _UNFINISHED) for was, new in zip(old, whole, strict=True)))
        self._clock.skip(self._kind.write_span)

    def _erase(self, page: int) -> None:
        if page >= len(self._kind.pages):
            raise BoardError(f"page {page} of the flash was to be erased, of {len(self._kind.pages)}")
        size, offset = self._kind.pages[page], sum(self._kind.pages[:page])
        self._protect(offset)
        self.erasures += 1
        half = bytes([ERASED]) * (size // 2)
        self._change(offset, half * 2, half + bytes(self.memory[offset + size // 2 : offset + size]))
        self._clock.skip(self._kind.erase_span)

    def _change(self, offset: int, whole: bytes, partial: bytes) -> None:
        self.operations += 1
        if self.operations in self._faults.failing:
            self._sr.value |= self.failure
            return
        cut = self.operations == self._faults.cut_at
        self.memory[offset : offset + len(whole)] = partial if cut else whole
        if cut:
            raise PowerCut

    def _protect(self, offset: int) -> None:
        if offset < self.code_end:
            raise BoardError(f"the image was about to change itself at 0x{BASE + offset:08X}")

    def _write_cr(self, value: int) -> None:
        if self._cr.value & self._lock:
            raise BoardError("FLASH CR was written while it is locked")
        start = self.start_bit()
        self._cr.value = value & ~start
        page = self.page_to_erase()
        if value & start and page is not None:
            self._erase(page)

    def _write_key(self, value: int) -> None:
        """Both keys in order, and only once: a wrong one locks until reset."""
        if self._keys_taken >= len(_KEYS) or value != _KEYS[self._keys_taken]:
            raise BoardError(f"FLASH KEYR was written with the wrong key 0x{value:08X}, which locks it until a reset")
        self._keys_taken += 1
        if self._keys_taken == len(_KEYS):
            self._keys_taken = 0
            self._cr.value &= ~self._lock

    def _write_sr(self, value: int) -> None:
        self._sr.value &= ~value


Factory = Callable[[Clock, FlashFaults], Flash]
