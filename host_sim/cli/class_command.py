"""`tools/octet class`: the page for a room full of pupils, and a board with their goals."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, file_path
from host_sim.cli.run_options import add_option

if TYPE_CHECKING:
    from host_sim.live.class_roster import Roster
    from host_sim.live.listener import Listener

_EXAMPLES = """\
examples:
  tools/octet class --listen                   for a room: prints an address, a short code and a QR code
  tools/octet class --listen --file 7b.json    another class
  tools/octet class                            on this machine only, to try it
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "class",
        _serve_class,
        summary="serve the page to a class, and show its progress on a board",
        description="Serves the page to a class: each pupil's page runs a robot of its own. The goals reached in\n"
        "the lessons come to a board, and are kept in a file. Ctrl-C ends it.",
        epilog=_EXAMPLES,
        stages=lambda arguments: ["page"] if arguments.listen is None else ["page", "classroom"],
    )
    kept = "keep names and goals in this file, and continue with it" + DEFAULT
    parser.add_argument("--file", type=file_path, default=Path("class.json"), metavar="FILE", help=kept)
    others = "serve other machines: on all interfaces, or on one address (default: this machine only)"
    parser.add_argument("--listen", nargs="?", const="0.0.0.0", metavar="ADDRESS", help=others)
    add_option(parser, "port")


def _serve_class(arguments: argparse.Namespace) -> int:
    import asyncio

    from host_sim.live.class_roster import Roster
    from host_sim.live.listener import Listener
    from host_sim.report.octet_page import class_page

    roster, page = Roster(arguments.file), class_page()
    listener = Listener(arguments.listen, arguments.port)
    try:
        asyncio.run(_serve(roster, listener, page))
    finally:
        listener.socket.close()
    print(f"kept      {arguments.file} ({len(roster.pupils)} pupils)")
    return 0


async def _serve(roster: "Roster", listener: "Listener", page: str) -> None:
    import asyncio
    import sys

    from host_sim.live.class_server import ClassServer
    from host_sim.live.ending_signals import on_ending_signals
    from host_sim.live.qr_code import lines_for

    ended = asyncio.Event()
    with on_ending_signals(asyncio.get_running_loop(), ended.set):
        async with ClassServer(roster, listener, page).serving():
            first, *others = listener.urls
            lines = [f"class     {first}", *(f"          {url}" for url in others)]
            lines += [f"to type   {listener.short_urls[0]}"] if listener.is_open else []
            lines += [f"board     {listener.board_url} (keep this address private)"]
            lines += lines_for(first, sys.stdout) if listener.is_open else []
            print("\n".join(lines), "ends      with Ctrl-C", sep="\n", flush=True)
            await ended.wait()
