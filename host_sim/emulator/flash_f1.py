"""The flash of the STM32F103C8 (PM0075): 64 pages of 1 kB, written by half-words."""

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.flash import BASE as FLASH_BASE
from host_sim.emulator.flash import Flash, FlashFaults, FlashKind
from host_sim.emulator.registers import Register

_PG, _PER, _STRT, _LOCK = 1 << 0, 1 << 1, 1 << 6, 1 << 7
_PGERR = 1 << 2
_HALF_WORD, _ERASED = 2, 0xFFFF
_KIND = FlashKind((1024,) * 64, 24_000_000, 52 * SECOND // 10**6, 30 * SECOND // 1000)


class FlashF1(Flash):
    """The F1's: a half-word is written once between two erasures, but 0 can be written over anything."""

    def __init__(self, clock: Clock, faults: FlashFaults) -> None:
        """As in `Flash`."""
        self._address = Register("AR")
        super().__init__(clock, _KIND, faults, lock=_LOCK, registers={0x14: self._address})

    def start_bit(self) -> int:
        """As in `Flash`."""
        return _STRT

    def refusal(self, offset: int, size: int, value: int) -> int:
        """As in `Flash`."""
        programming = self._cr.value & _PG and size == _HALF_WORD
        fresh = self.read(offset, size) == _ERASED or value == 0
        return 0 if programming and fresh else _PGERR

    def page_to_erase(self) -> int | None:
        """As in `Flash`."""
        return (self._address.value - FLASH_BASE) // _KIND.pages[0] if self._cr.value & _PER else None

    @property
    def failure(self) -> int:
        """As in `Flash`."""
        return _PGERR
