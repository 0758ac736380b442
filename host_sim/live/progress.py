"""What a person sees while a run goes on."""

import sys
import time
from typing import TextIO

from host_sim.client.session import Session
from host_sim.world.arena import Arena

_EVERY_TICKS = 64
_EVERY_S = 0.25


class Progress:
    """One line that is rewritten in a terminal; nothing where the output is no terminal."""

    def __init__(self, session: Session, environments: int, tick_s: float, out: TextIO = sys.stderr) -> None:
        """Starts the clock.

        Args:
            session: Knows the robot's memory.
            environments: How many there will be.
            tick_s: Length of a tick.
            out: Where to write.
        """
        self._session, self._environments, self._tick_s, self._out = session, environments, tick_s, out
        self._shown = out.isatty()
        self._ticks, self._ticks_then, self._then = 0, 0, time.monotonic()

    def __call__(self, number: int, arena: Arena) -> None:
        """Takes notice of one tick."""
        self._ticks += 1
        if self._shown and self._ticks % _EVERY_TICKS == 0:
            self._show(number, arena)

    def clear(self) -> None:
        """Removes the line."""
        if self._shown:
            self._out.write("\r\x1b[K")
            self._out.flush()

    def _show(self, number: int, arena: Arena) -> None:
        now = time.monotonic()
        if now - self._then < _EVERY_S:
            return
        speed = (self._ticks - self._ticks_then) * self._tick_s / (now - self._then)
        self._ticks_then, self._then = self._ticks, now
        cells = "".join(".LR"[cell] for cell in self._session.memory)
        eaten = sum(arena.eaten)
        self._out.write(
            f"\r\x1b[Kenvironment {number} of {self._environments}   food {eaten} of {eaten + arena.food_left}   "
            f"memory {cells}   {self._ticks * self._tick_s:.0f} s   {speed:.0f} x real time"
        )
        self._out.flush()
