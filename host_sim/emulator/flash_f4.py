"""The flash of the STM32F405 (RM0090 3): twelve sectors, written by units of the size that CR says."""

from host_sim.emulator.clock import SECOND, Clock
from host_sim.emulator.flash import Flash, FlashFaults, FlashKind

_PG, _SER, _STRT, _LOCK = 1 << 0, 1 << 1, 1 << 16, 1 << 31
_SNB_SHIFT, _PSIZE_SHIFT = 3, 8
_PGPERR, _PGSERR, _OPERR = 1 << 6, 1 << 7, 1 << 1
_SECTORS = (16 << 10,) * 4 + (64 << 10,) + (128 << 10,) * 7
_KIND = FlashKind(_SECTORS, 30_000_000, 16 * SECOND // 10**6, SECOND // 2)


class FlashF4(Flash):
    """The F4's: bits can be cleared at any time, one after the other."""

    def __init__(self, clock: Clock, faults: FlashFaults) -> None:
        """As in `Flash`."""
        super().__init__(clock, _KIND, faults, lock=_LOCK, registers={})

    def start_bit(self) -> int:
        """As in `Flash`."""
        return _STRT

    def refusal(self, offset: int, size: int, value: int) -> int:  # noqa: ARG002 - any place, any value
        """As in `Flash`."""
        if not self._cr.value & _PG:
            return _PGSERR
        return 0 if size == 1 << (self._cr.value >> _PSIZE_SHIFT & 3) else _PGPERR

    def page_to_erase(self) -> int | None:
        """As in `Flash`."""
        return self._cr.value >> _SNB_SHIFT & 0xF if self._cr.value & _SER else None

    @property
    def failure(self) -> int:
        """As in `Flash`."""
        return _OPERR
