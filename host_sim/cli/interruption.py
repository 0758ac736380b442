"""Ends a run on a signal: between two ticks, so that the log ends with a whole tick."""

import signal
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType

from host_sim.base.errors import RobotError
from host_sim.base.system import ENDING_SIGNALS, on_alarm, set_alarm
from host_sim.client.commands import stop
from host_sim.client.robot_client import RobotClient
from host_sim.live.ending_signals import TICK_S, at_most
from host_sim.sim.simulation import Simulation

STOP_S = 1.0
"""Time for all robots of an interrupted run to stop and report, s."""


@contextmanager
def interrupted_between_ticks(simulation: Simulation) -> Iterator[None]:
    """Delays each handled signal until the current tick has ended.

    A second signal takes effect at once; so does the first one if the tick does not end within `TICK_S`.

    Args:
        simulation: The simulation. Its `watch` must not be changed afterwards.
    """
    handlers = {number: handler for number in ENDING_SIGNALS if callable(handler := signal.getsignal(number))}
    pending: list[int] = []

    def remember(number: int, frame: FrameType | None) -> None:
        pending.append(number)
        if len(pending) > 1:
            handlers[signal.Signals(number)](number, frame)
        set_alarm(TICK_S)

    watch = simulation.watch

    def check(simulation: Simulation) -> None:
        watch(simulation)
        if pending:
            handlers[signal.Signals(pending[0])](pending[0], None)

    simulation.watch = check
    for number in handlers:
        signal.signal(number, remember)
    before = on_alarm(lambda _, frame: handlers[signal.Signals(pending[0])](pending[0], frame))
    try:
        yield
    finally:
        set_alarm(0)
        on_alarm(before)
        for number, handler in handlers.items():
            signal.signal(number, handler)


def stop_soon(clients: Sequence[RobotClient]) -> None:
    """Stops robots, and receives their final reports if they come within `STOP_S`.

    Raises:
        RobotError: A robot does not answer. The others were stopped.
    """
    try:
        with at_most(STOP_S):
            for client in clients:
                stop(client)
    except RobotError:
        for client in clients:
            client.dialogue.stop_at_once()
        raise


@contextmanager
def until_ctrl_c(limit_s: float) -> Iterator[Callable[[], bool]]:
    """Yields a function that is true until `limit_s` has passed or the first Ctrl-C. A second Ctrl-C raises."""
    end_s = time.monotonic() + limit_s
    asked: list[int] = []

    def ask(number: int, frame: FrameType | None) -> None:
        asked.append(number)
        if len(asked) > 1:
            signal.default_int_handler(number, frame)

    before = signal.signal(signal.SIGINT, ask)
    try:
        yield lambda: not asked and time.monotonic() < end_s
    finally:
        signal.signal(signal.SIGINT, before)
