"""Handles the signals that end a run in an orderly way: SIGINT, SIGTERM and SIGHUP."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

from host_sim.base.errors import RobotError
from host_sim.base.system import ENDING_SIGNALS, on_alarm, on_signal, set_alarm

if TYPE_CHECKING:
    import asyncio

TICK_S = 0.5
"""Time for the current tick to end after such a signal: a robot that hangs does not hold up the end of a run."""


@contextmanager
def on_ending_signals(loop: "asyncio.AbstractEventLoop", close: Callable[[], None]) -> Iterator[None]:
    """Calls a function on each of these signals, between two steps of an event loop.

    A step that does not end within `TICK_S` is ended with a RobotError.
    """

    def end() -> None:
        set_alarm(0)
        close()

    on_alarm(_give_up)
    for number in ENDING_SIGNALS:
        on_signal(loop, number, end, lambda: set_alarm(TICK_S))
    try:
        yield
    finally:
        on_alarm(signal.SIG_IGN)
        set_alarm(0)


@contextmanager
def at_most(seconds: float) -> Iterator[None]:
    """Raises a RobotError inside if it takes longer."""
    before = on_alarm(_give_up)
    set_alarm(seconds)
    try:
        yield
    finally:
        set_alarm(0)
        on_alarm(before)


def _give_up(_number: int, _frame: FrameType | None) -> NoReturn:
    raise RobotError("a robot hung and was stopped without an answer")
