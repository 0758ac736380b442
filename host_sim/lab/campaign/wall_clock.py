"""The wall clock as this process reads it, which somebody sets while a run goes on."""

import sys
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from itertools import chain, repeat

from host_sim.lab.campaign.setup import Happen

CLOCK_EVENTS = frozenset({"clock-ahead", "clock-back"})
"""The events of the wall clock, by name."""


def clock_events(undo: ExitStack) -> Mapping[str, Happen]:
    """Sets the clock ahead or back by some seconds.

    Args:
        undo: Sets it right again.
    """
    return {"clock-ahead": lambda span_s: _step(span_s, undo), "clock-back": lambda span_s: _step(-span_s, undo)}


def _step(span_s: int, undo: ExitStack) -> None:
    """Sets the clock for every module that reads it, libraries included: after the next reading, as if in a wait."""
    seconds, nanoseconds = time.time, time.time_ns
    shift_s, shift_ns = chain([0], repeat(span_s)), chain([0], repeat(span_s * 10**9))
    _replace(seconds, lambda: seconds() + next(shift_s), undo)
    _replace(nanoseconds, lambda: nanoseconds() + next(shift_ns), undo)


def _replace(old: Callable[[], object], new: Callable[[], object], undo: ExitStack) -> None:
    for module in tuple(sys.modules.values()):
        names = [name for name, value in vars(module).items() if value is old]
        for name in names:
            undo.callback(setattr, module, name, old)
            setattr(module, name, new)
