"""The independent watchdog (RM0090 21, RM0008 19)."""

from collections.abc import Callable

from host_sim.emulator.clock import NEVER, SECOND, Clock
from host_sim.emulator.registers import Peripheral, Register

_START, _FEED, _UNLOCK = 0xCCCC, 0xAAAA, 0x5555
_RELOAD_MAX = 0xFFF


class Watchdog(Peripheral):
    """Resets the board when it is not fed. Once started, it cannot be stopped."""

    def __init__(self, clock: Clock, slow_hz: int, bite: Callable[[], None]) -> None:
        """At rest.

        Args:
            clock: The board's.
            slow_hz: Speed of its own oscillator.
            bite: Resets the board.
        """
        self._clock, self._slow_hz, self._bite = clock, slow_hz, bite
        self._expires = NEVER
        self._started = self._unlocked = False
        self._prescaler = Register("PR", on_write=self._write_prescaler)
        self._reload = Register("RLR", _RELOAD_MAX, on_write=self._write_reload)
        key = Register("KR", on_write=self._write_key, idle=True)
        super().__init__(
            "IWDG", {0x0: key, 0x4: self._prescaler, 0x8: self._reload, 0xC: Register("SR")}, clocked=True
        )
        clock.add(self._due)

    def reset(self) -> None:
        """As in `Peripheral`."""
        super().reset()
        self._started = self._unlocked = False
        self._expires = NEVER

    def _write_key(self, value: int) -> None:
        self._unlocked = value == _UNLOCK
        self._started = self._started or value == _START
        if self._started and value in (_START, _FEED):
            period = SECOND // self._slow_hz * (4 << min(self._prescaler.value, 6))
            self._expires = self._clock.now + (self._reload.value + 1) * period
            self._clock.expect(self._expires)

    def _write_prescaler(self, value: int) -> None:
        if self._unlocked:
            self._prescaler.value = value & 7

    def _write_reload(self, value: int) -> None:
        if self._unlocked:
            self._reload.value = value & _RELOAD_MAX

    def _due(self) -> int:
        if self._expires <= self._clock.now:
            self._expires = NEVER
            self._bite()
        return self._expires
