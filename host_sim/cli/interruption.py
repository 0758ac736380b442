"""Ends a run between two ticks when a signal asks for it, so that its log has no half tick."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from host_sim.live.ending_signals import ENDING_SIGNALS
from host_sim.sim.simulation import Simulation


@contextmanager
def interrupted_between_ticks(simulation: Simulation) -> Iterator[None]:
    """Has each signal that is handled already take effect after the current tick; a second one does so at once.

    Args:
        simulation: The simulation. Its `watch` must not be changed afterwards.
    """
    handlers = {number: handler for number in ENDING_SIGNALS if callable(handler := signal.getsignal(number))}
    pending: list[int] = []

    def remember(number: int, frame: FrameType | None) -> None:
        pending.append(number)
        if len(pending) > 1:
            handlers[signal.Signals(number)](number, frame)

    watch = simulation.watch

    def check(simulation: Simulation) -> None:
        watch(simulation)
        if pending:
            handlers[signal.Signals(pending[0])](pending[0], None)

    simulation.watch = check
    for number in handlers:
        signal.signal(number, remember)
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
