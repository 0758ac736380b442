"""`tools/octet watch`: shows a run in the browser or in the terminal, with controls."""

import argparse
from typing import TYPE_CHECKING

from host_sim.cli.parsing import add_command, parameter_table
from host_sim.cli.run_arguments import add_run_options, add_watch_options
from host_sim.cli.run_options import check_no_page, check_run, run_stages, watch_options

if TYPE_CHECKING:
    from host_sim.cli.parsing import Subparsers

_EXAMPLES = """\
examples:
  tools/octet watch                                  one robot, five environments
  tools/octet watch --robots 3                       three robots in the same environments
  tools/octet watch --seed 7 --memory robot.mem      other environments, with the memory in robot.mem
  tools/octet watch --listen                         for other machines too: prints an address and a QR code
  tools/octet watch --listen --robots 30             for a class: a robot for each page, and a board for all
  tools/octet watch --terminal                       without a browser, for example over ssh
"""


def add(commands: "Subparsers") -> None:
    """Adds the command."""
    watch = add_command(
        commands,
        "watch",
        _watch,
        summary="watch a robot learn in the browser, and interfere",
        description="Shows a run in the browser, in real time, with controls. Ctrl-C ends it.",
        epilog=f"{parameter_table()}\n\n{_EXAMPLES}",
        check=_check,
        stages=run_stages,
    )
    add_run_options(watch)
    add_watch_options(watch)
    watch.add_argument("--terminal", action="store_true", help="draw the run in this terminal instead of a browser")


def _check(arguments: argparse.Namespace) -> None:
    if arguments.terminal:
        check_no_page(arguments, "leave --terminal out")
    check_run(arguments)


def _watch(arguments: argparse.Namespace) -> int:
    from host_sim.cli.conduct import conduct_watched

    conduct_watched(arguments, watch_options(arguments, terminal=arguments.terminal))
    return 0
