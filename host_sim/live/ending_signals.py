"""Handles the signals that end a run in an orderly way: SIGINT, SIGTERM and SIGHUP."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

from host_sim.base.errors import RobotError

if TYPE_CHECKING:
    import asyncio

ENDING_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

TICK_S = 0.5
"""Time for the current tick to end after such a signal: a robot that hangs does not hold up the end of a run."""


@contextmanager
def on_ending_signals(loop: "asyncio.AbstractEventLoop", close: Callable[[], None]) -> Iterator[None]:
    """Has each of these signals call a function, between two steps of an event loop.

    Where no step ends within `TICK_S`, the one that does not ends with a RobotError.
    """

    def end() -> None:
        signal.setitimer(signal.ITIMER_REAL, 0)
        close()

    signal.signal(signal.SIGALRM, _give_up)
    for number in ENDING_SIGNALS:
        loop.add_signal_handler(number, end)
        # The loop hears of the signal all the same, as soon as a step ends.
        signal.signal(number, lambda *_: signal.setitimer(signal.ITIMER_REAL, TICK_S))
    try:
        yield
    finally:
        signal.signal(signal.SIGALRM, signal.SIG_IGN)
        signal.setitimer(signal.ITIMER_REAL, 0)


@contextmanager
def at_most(seconds: float) -> Iterator[None]:
    """Raises a RobotError inside if it takes longer."""
    before = signal.signal(signal.SIGALRM, _give_up)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def _give_up(_number: int, _frame: FrameType | None) -> NoReturn:
    raise RobotError("a robot hangs, and was ended without an answer")
