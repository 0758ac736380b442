"""The board's time."""

from collections.abc import Callable

SECOND = 10**15
"""Moments and spans are whole femtoseconds: no clock of the boards makes their sum drift."""

NEVER = 2**127
"""A moment that does not come."""


class Clock:
    """Time, made of the core's cycles, one for each instruction. What happens by itself happens when time passes it.

    Attributes:
        now: This moment, since power-up.
        cycles: Of the core, since power-up.
        period: Length of a cycle.
        horizon: When something is next due; `settle` does it.
    """

    def __init__(self, hz: int) -> None:
        """Begins at 0.

        Args:
            hz: Speed of the core at power-up.
        """
        self.now = 0
        self.cycles = 0
        self.period = SECOND // hz
        self.horizon = NEVER
        self._timed: list[Callable[[], int]] = []

    def add(self, due: Callable[[], int]) -> None:
        """Adds what happens by itself.

        Args:
            due: Does all that is due by now, and returns when it wants to be called next.
        """
        self._timed.append(due)

    def set_hz(self, hz: int) -> None:
        """Changes the speed of the core."""
        self.period = SECOND // hz
        self.expect(self.now)

    def expect(self, moment: int) -> None:
        """Something new is due then."""
        self.horizon = min(self.horizon, moment)

    def settle(self) -> None:
        """Lets everything happen that is due."""
        self.horizon = NEVER
        moments = [due() for due in self._timed]
        self.horizon = min(self.horizon, *moments, NEVER)

    def execute(self, cycles: int) -> None:
        """Passes the time of a number of cycles."""
        self.cycles += cycles
        self.now += cycles * self.period
        if self.now >= self.horizon:
            self.settle()

    def skip_to(self, moment: int) -> None:
        """Passes time in which the core does nothing, and stops at each event on the way."""
        while self.now < moment:
            target = max(min(moment, self.horizon), self.now)
            self.cycles += (target - self.now) // self.period
            self.now = target
            if self.now >= self.horizon:
                self.settle()

    def skip(self, span: int) -> None:
        """Passes that much of it."""
        self.skip_to(self.now + span)
