"""Shows a live run in the browser."""

import asyncio
import os
import sys
import webbrowser
from typing import TextIO

from host_sim.live.announcement import announce
from host_sim.live.ending_signals import on_ending_signals
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.server import LiveServer


def watch_run(live: PacedRun, listener: Listener, out: TextIO) -> None:
    """Plays a whole run while people watch; Ctrl-C ends it in order.

    Args:
        live: The run, before its first environment.
        listener: The socket that the page is served on.
        out: Where the page's address is printed.

    Raises:
        RobotError: A robot has ended or does not answer.
    """
    live.begin()
    asyncio.run(_serve(live, listener, out))


async def _serve(live: PacedRun, listener: Listener, out: TextIO) -> None:
    with on_ending_signals(asyncio.get_running_loop(), live.close):
        async with LiveServer(live, listener).serving():
            announce(listener, len(live.simulation.clients), out, waits=live.waits)
            if _on_a_desktop():
                webbrowser.open(listener.board_url if listener.is_open else listener.urls[0])
            await live.play()


def _on_a_desktop() -> bool:
    """Whether this is an interactive session on a desktop, where a browser can be opened."""
    screen = sys.platform == "darwin" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    return screen and sys.stdout.isatty()
