"""Shows a live run in the browser, and prints its address."""

import asyncio
import sys
import webbrowser
from typing import TextIO

from host_sim.base.system import has_screen
from host_sim.live.ending_signals import on_ending_signals
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.qr_code import lines_for
from host_sim.live.server import LiveServer


def watch_run(live: PacedRun, listener: Listener, out: TextIO) -> None:
    """Plays a whole run while people watch; Ctrl-C ends it in an orderly way.

    Args:
        live: The run, before its first environment.
        listener: The socket that the page is served on.
        out: Stream for the page's address.

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
    return has_screen() and sys.stdout.isatty()


def announce(listener: Listener, robots: int, out: TextIO, *, waits: bool) -> None:
    """Prints the address at which a run can be watched.

    Args:
        listener: The socket that it is served on.
        robots: Number of its robots.
        out: Stream to print to.
        waits: Whether the run waits for the first page.
    """
    first, *others = listener.urls
    if not listener.is_open:
        _say(out, f"watch     {first}  ({'begins when the page is open; ' if waits else ''}Ctrl-C ends it)")
        return
    _say(out, f"watch     {first}")
    for url in others:
        _say(out, f"          {url}")
    _say(out, f"board     {listener.board_url} (yours alone)")
    shares = f"each page gets one of {robots}" if robots > 1 else "all pages share one"
    _say(out, f"to type   {listener.short_urls[0]}: {shares}")
    for line in lines_for(first, out):
        _say(out, line)
    if waits:
        _say(out, "waits     for the first page; the robot stands still until then. Ctrl-C ends it")


def _say(out: TextIO, line: str) -> None:
    out.write(f"{line}\n")
    out.flush()
