"""The schedule of a run's changes."""

import sys
from collections.abc import Sequence

from host_sim.world.changes import Change


class ChangeSchedule:
    """Changes, each due before the senses of a tick.

    Attributes:
        next_tick: Tick of the next change; far away if no more are due.
    """

    def __init__(self, changes: Sequence[Change], tick_s: float) -> None:
        """Takes the changes; none are due before `enter`.

        Args:
            changes: The changes. Those due in the same tick keep their order.
            tick_s: Length of a tick, s.
        """
        self._changes, self._tick_s = changes, tick_s
        self._coming: list[tuple[int, Change]] = []
        self.next_tick = sys.maxsize

    def enter(self, number: int, tick: int) -> None:
        """Begins an environment; the first one restarts the run. Changes still due in the previous one are dropped.

        Args:
            number: Number of the environment.
            tick: Its first tick.
        """
        kept = [] if number == 1 else [coming for coming in self._coming if coming[1].number is None]
        begun = (None, 1) if number == 1 else (number,)
        new = [change for change in self._changes if change.number in begun]
        kept += [(tick + round(change.after_s / self._tick_s), change) for change in new]
        self._coming = sorted(kept, key=lambda coming: (coming[0], self._changes.index(coming[1])))
        self._look_ahead()

    def due(self, tick: int) -> list[Change]:
        """Returns the changes that are due by a tick, each only once."""
        count = sum(at <= tick for at, _ in self._coming)
        due = [change for _, change in self._coming[:count]]
        del self._coming[:count]
        self._look_ahead()
        return due

    def _look_ahead(self) -> None:
        self.next_tick = self._coming[0][0] if self._coming else sys.maxsize
