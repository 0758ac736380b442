"""The signals that end a run in order: Ctrl-C, a request to end, a terminal that is closed."""

import signal
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import asyncio

ENDING_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def on_ending_signals(loop: "asyncio.AbstractEventLoop", close: Callable[[], None]) -> None:
    """Has each of these signals call a function, between two steps of an event loop."""
    for number in ENDING_SIGNALS:
        loop.add_signal_handler(number, close)
