"""Modes of the bxCAN, and the time that it takes to change them."""

from collections.abc import Callable
from enum import Enum

from host_sim.emulator.can_wire import BITRATE
from host_sim.emulator.clock import NEVER, SECOND, Clock

_IDLE_SPAN = 11 * SECOND // BITRATE
"""A bus that is recessive for so long is idle: the controller waits for it before it joins or leaves."""

_RECOVERY_SPAN = 128 * _IDLE_SPAN
_INRQ, _SLEEP = 1, 2
_INAK, _SLAK = 1, 2


class Mode(Enum):
    """What the controller is about; the value is how MSR tells."""

    NORMAL = 0
    INIT = _INAK
    SLEEP = _SLAK


class ModeSwitch:
    """Follows the mode that MCR asks for, with the hardware's delay, and ends a bus-off.

    Attributes:
        mode: Of now.
    """

    def __init__(
        self, clock: Clock, changed: Callable[[Mode], None], recovered: Callable[[], None], *, inak_stuck: bool
    ) -> None:
        """Asleep, as after a reset.

        Args:
            clock: The board's.
            changed: Told of each new mode.
            recovered: Told when the bus-off is over.
            inak_stuck: Set-up is asked for in vain.
        """
        self._clock, self._inak_stuck = clock, inak_stuck
        self._changed, self._recovered = changed, recovered
        self.reset()
        clock.add(self._due)

    def reset(self) -> None:
        """Asleep again."""
        self.mode = self._wanted = Mode.SLEEP
        self._change_at = self._recovery_at = NEVER

    def ask(self, mcr: int) -> None:
        """Takes what MCR says now."""
        wanted = Mode.SLEEP if mcr & _SLEEP else Mode.INIT if mcr & _INRQ else Mode.NORMAL
        if wanted == self._wanted:
            return
        self._wanted = wanted
        stuck = wanted is Mode.INIT and self._inak_stuck
        self._change_at = NEVER if stuck else self._clock.now + _IDLE_SPAN
        self._clock.expect(self._change_at)

    def recover(self) -> None:
        """Begins to wait for the end of a bus-off."""
        self._recovery_at = self._clock.now + _RECOVERY_SPAN
        self._clock.expect(self._recovery_at)

    def _due(self) -> int:
        if self._change_at <= self._clock.now:
            self.mode, self._change_at = self._wanted, NEVER
            self._changed(self.mode)
        if self._recovery_at <= self._clock.now:
            self._recovery_at = NEVER
            self._recovered()
        return min(self._change_at, self._recovery_at)
