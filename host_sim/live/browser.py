"""Shows a live run in the browser, and prints its address."""

import asyncio
import contextlib
import html
import os
import sys
import tempfile
import webbrowser
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from host_sim.base.system import has_screen
from host_sim.live.ending_signals import on_ending_signals
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.qr_code import lines_for
from host_sim.live.server import LiveServer

_REDIRECT = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Octet</title>
<meta name="referrer" content="no-referrer"><meta http-equiv="refresh" content="0; url={url}"></head></html>
"""


def watch_run(live: PacedRun, server: LiveServer, out: TextIO) -> None:
    """Plays a whole run while people watch; Ctrl-C ends it in an orderly way.

    Args:
        live: The run, before its first environment.
        server: Serves its page.
        out: Stream for the page's address.

    Raises:
        RobotError: A robot has ended or does not answer.
    """
    live.begin()
    asyncio.run(_serve(live, server, out))


async def _serve(live: PacedRun, server: LiveServer, out: TextIO) -> None:
    with on_ending_signals(asyncio.get_running_loop(), live.close):
        async with server.serving():
            announce(server.listener, out, waits=live.waits)
            with open_browser(server.listener.urls[0]) if _on_a_desktop() else contextlib.nullcontext():
                await live.play()


@contextlib.contextmanager
def open_browser(url: str) -> Iterator[None]:
    """Opens a browser at an address that others must not see: other users can read the list of processes.

    The browser gets the name of a file that only this user can read, and that redirects it to the address. The file
    is deleted when the context ends.
    """
    descriptor, name = tempfile.mkstemp(prefix="octet-", suffix=".html")
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8") as file:
            file.write(_REDIRECT.format(url=html.escape(url)))
        webbrowser.open(Path(name).as_uri())
        yield
    finally:
        Path(name).unlink(missing_ok=True)


def _on_a_desktop() -> bool:
    """Whether this is an interactive session on a desktop, where a browser can be opened."""
    return has_screen() and sys.stdout.isatty()


def announce(listener: Listener, out: TextIO, *, waits: bool) -> None:
    """Prints the address at which a run can be watched.

    Args:
        listener: The socket that it is served on.
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
    _say(out, f"to type   {listener.short_urls[0]}")
    for line in lines_for(first, out):
        _say(out, line)
    if waits:
        _say(out, "waits     for the first page; the robot stands still until then. Ctrl-C ends it")


def _say(out: TextIO, line: str) -> None:
    out.write(f"{line}\n")
    out.flush()
