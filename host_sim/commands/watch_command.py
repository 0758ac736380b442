"""`tools/octet watch`: a run in the browser."""

import asyncio
import os
import signal
import sys
import webbrowser
from collections.abc import Callable

from host_sim.live.live_run import LiveRun
from host_sim.live.live_server import Door, LiveServer


def watch_run(live: LiveRun, door: Door, say: Callable[[str], object]) -> None:
    """Takes a run from its begin to its end while people watch; Ctrl-C ends it in good order.

    Args:
        live: The run.
        door: Where they come in.
        say: Prints its address.

    Raises:
        RobotError: The robot is gone.
    """
    live.begin()
    asyncio.run(_serve(live, door, say))


async def _serve(live: LiveRun, door: Door, say: Callable[[str], object]) -> None:
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, live.close)
    async with LiveServer(live, door).serving():
        say(f"watch     {door.url}  (Ctrl-C ends it)")
        if _on_a_desktop():
            webbrowser.open(door.url)
        await live.play()


def _on_a_desktop() -> bool:
    """Whether someone sits before a screen here who would like to see a browser."""
    screen = sys.platform == "darwin" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    return screen and sys.stdout.isatty()
