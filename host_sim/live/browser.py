"""Shows a live run in the browser."""

import asyncio
import os
import signal
import sys
import webbrowser
from collections.abc import Callable

from host_sim.live.paced_run import PacedRun
from host_sim.live.server import Listener, LiveServer


def watch_run(live: PacedRun, listener: Listener, say: Callable[[str], object]) -> None:
    """Plays a whole run while people watch; Ctrl-C ends it in order.

    Args:
        live: The run, before its first environment.
        listener: The socket that the page is served on.
        say: Prints a line, with the page's address.

    Raises:
        RobotError: A robot has ended or does not answer.
    """
    live.begin()
    asyncio.run(_serve(live, listener, say))


async def _serve(live: PacedRun, listener: Listener, say: Callable[[str], object]) -> None:
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        loop.add_signal_handler(number, live.close)
    async with LiveServer(live, listener).serving():
        say(f"watch     {listener.url}  ({'begins when the page is open; ' if live.waits else ''}Ctrl-C ends it)")
        if _on_a_desktop():
            webbrowser.open(listener.url)
        await live.play()


def _on_a_desktop() -> bool:
    """Whether this is an interactive session on a desktop, where a browser can be opened."""
    screen = sys.platform == "darwin" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    return screen and sys.stdout.isatty()
