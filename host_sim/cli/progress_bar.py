"""A progress bar for a known number of steps."""

import sys
import time
from typing import TextIO

_WIDTH = 30
_EVERY_S = 0.1


class ProgressBar:
    """One line, rewritten; prints nothing if the output is not a terminal."""

    def __init__(self, total: int, unit: str, out: TextIO | None = None) -> None:
        """Starts the clock.

        Args:
            total: Number of steps.
            unit: What a step is, in the plural.
            out: Stream to write to; by default stderr.
        """
        self._total, self._unit, self._out = total, unit, out or sys.stderr
        self._done, self._begun, self._shown = 0, time.monotonic(), 0.0

    def add(self, steps: int) -> None:
        """Counts steps, and now and then rewrites the line."""
        self._done += steps
        now = time.monotonic()
        if self._out.isatty() and (now >= self._shown + _EVERY_S or self._done == self._total):
            self._shown = now
            left_s = (now - self._begun) * (self._total - self._done) / max(1, self._done)
            filled = _WIDTH * self._done // max(1, self._total)
            bar = "#" * filled + "." * (_WIDTH - filled)
            self._out.write(f"\r\x1b[K[{bar}] {self._done} of {self._total} {self._unit}, {left_s:.0f} s left")
            self._out.flush()

    def clear(self) -> None:
        """Removes the line."""
        if self._out.isatty():
            self._out.write("\r\x1b[K")
            self._out.flush()
