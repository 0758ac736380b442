"""The progress line of a run."""

import shutil
import sys
import time
from typing import TextIO

from host_sim.protocol.generated import Side
from host_sim.protocol.memory_kinds import sides_of
from host_sim.sim.simulation import Simulation

_EVERY_TICKS = 64
_EVERY_S = 0.25
_MEMORIES_MAX = 4
_SIGNS = {Side.NOTHING: ".", Side.LEFT: "L", Side.RIGHT: "R"}


class Progress:
    """One line, rewritten during the run; prints nothing if the output is not a terminal."""

    def __init__(self, out: TextIO = sys.stderr) -> None:
        """Starts the clock.

        Args:
            out: Stream to write to.
        """
        self._out = out
        self._shown = out.isatty()
        self._ticks, self._ticks_then, self._then = 0, 0, time.monotonic()

    def __call__(self, simulation: Simulation) -> None:
        """Counts the ticks, and now and then rewrites the line."""
        if self._shown and simulation.tick >= self._ticks + _EVERY_TICKS:
            self._ticks = simulation.tick
            self._show(simulation)

    def clear(self) -> None:
        """Removes the line."""
        if self._shown:
            self._out.write("\r\x1b[K")
            self._out.flush()

    def _show(self, simulation: Simulation) -> None:
        now = time.monotonic()
        if now - self._then < _EVERY_S:
            return
        tick_s = simulation.params.tick_s
        speed = (self._ticks - self._ticks_then) * tick_s / (now - self._then)
        self._ticks_then, self._then = self._ticks, now
        memories = " ".join(
            "".join(_SIGNS[Side(side)] for side in sides_of(client.memory))
            for client in simulation.clients[:_MEMORIES_MAX]
        )
        eaten = simulation.arena.food.eaten
        line = (
            f"environment {simulation.record.begun[-1].number} of {simulation.environments}   "
            f"food {sum(eaten)} of {len(eaten)}   memory {memories}   {self._ticks * tick_s:.0f} s   "
            f"{speed:.0f} x real time"
        )
        self._out.write(f"\r\x1b[K{line[: shutil.get_terminal_size().columns - 1]}")  # a line that wraps stays
        self._out.flush()
