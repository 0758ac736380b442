"""The command-line options for a recorded log."""

import argparse
import sys
from typing import TYPE_CHECKING

from host_sim.cli.parsing import file_path
from host_sim.cli.run_options import add_option

if TYPE_CHECKING:
    from host_sim.recording.resimulation import Resimulation


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options that `replay` and `picture` share."""
    add = parser.add_argument
    add("log", type=file_path, metavar="RUN.LOG", help="log of a run, of candump or of python-can; ASC or BLF")
    add_option(parser, "node")
    add(
        "--no-world",
        action="store_true",
        help="ignore seed and world file and draw the path from the odometers only, as for a real body",
    )


def resimulated(arguments: argparse.Namespace) -> "Resimulation":
    """The run in a log; a log that is cut short is reported on stderr."""
    from host_sim.recording.resimulation import resimulate

    result = resimulate(arguments.log, arguments.node, ignore_world=arguments.no_world)
    if result.note:
        print(f"octet: {result.note}", file=sys.stderr)
    if not result.stopped:
        print(f"octet: {arguments.log} ends before the run does; showing what it has", file=sys.stderr)
    return result
