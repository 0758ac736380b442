"""What is printed when a run can be watched: the addresses, what it waits for, and a QR code for phones."""

from typing import TextIO

from host_sim.live.listener import Listener
from host_sim.live.qr_code import lines_for


def announce(listener: Listener, robots: int, out: TextIO, *, waits: bool) -> None:
    """Prints where a run can be watched.

    Args:
        listener: The socket that it is served on.
        robots: Number of its robots.
        out: Where to print.
        waits: Whether the run waits for the first page.
    """
    first, *others = listener.urls
    if not listener.is_open:
        _say(out, f"watch     {first}  ({'begins when the page is open; ' if waits else ''}Ctrl-C ends it)")
        return
    _say(out, f"watch     {first}")
    for url in others:
        _say(out, f"          {url}")
    _say(out, f"board     {listener.board_url}")
    shares = f"each page gets one of {robots}" if robots > 1 else "all pages share one"
    _say(out, f"robots    {shares}; keep the board's address to yourself")
    for line in lines_for(first, out):
        _say(out, line)
    if waits:
        _say(out, "waits     for the first page; the robot stands still until then. Ctrl-C ends it")


def _say(out: TextIO, line: str) -> None:
    out.write(f"{line}\n")
    out.flush()
