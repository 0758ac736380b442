"""What a person can say about a recorded log, on the command line."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.cli.parsing import number
from host_sim.protocol.generated import NODE_MAX

if TYPE_CHECKING:
    from host_sim.recording.resimulation import Resimulation


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Adds the log, and how to read it."""
    add = parser.add_argument
    add("log", type=Path, metavar="RUN.LOG", help="as a run left it, or candump -L")
    add(
        "--node",
        type=number(1, NODE_MAX),
        default=1,
        help="the robot's number on the bus, of several the first one's (default: %(default)s)",
    )
    add("--no-world", action="store_true", help="draw the way by the odometers alone, as for a log of a real body")


def resimulated(arguments: argparse.Namespace) -> "Resimulation":
    """The run in a log; a log that is cut short is said to be, on stderr."""
    from host_sim.recording.resimulation import resimulate

    found = resimulate(arguments.log, arguments.node, in_the_open=arguments.no_world)
    if not found.stopped:
        print(f"octet: {arguments.log} ends before its run does; what it has is shown", file=sys.stderr)
    return found
