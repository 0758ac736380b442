"""`tools/octet monitor`: shows what is on a bus, live."""

import argparse
import math
import sys
from typing import TYPE_CHECKING

from host_sim.cli.parsing import add_bitrate, add_command, number

if TYPE_CHECKING:
    from host_sim.cli.parsing import Subparsers

_EXAMPLES = """\
examples:
  tools/octet monitor socketcan:can0              a table of the robots, on a terminal
  tools/octet monitor socketcan:can0 | grep '!'   what looks wrong; not on a terminal, each frame is a line
  tools/octet monitor slcan:/dev/ttyACM0 --all    other frames too
"""


def add(commands: "Subparsers") -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "monitor",
        _monitor,
        summary="show what is on a bus, live",
        description="Shows the robots on a bus, live: their state, rates, lost and damaged frames, and what looks\n"
        "wrong. Where the output is no terminal, each frame is a line. Ctrl-C ends it.",
        epilog=_EXAMPLES,
    )
    add = parser.add_argument
    add("bus", metavar="BUS", help="any bus of python-can: INTERFACE:CHANNEL, such as socketcan:can0")
    add("--all", action="store_true", help="other frames too; without it, the kernel keeps them away")
    add_bitrate(parser)
    add("--limit-s", type=number(0.1, 1e9, float), default=math.inf, metavar="S", help="end after S seconds")


def _monitor(arguments: argparse.Namespace) -> int:
    from host_sim.monitor.bus_watch import BusWatch
    from host_sim.monitor.monitor import filter_robots, watch_lines, watch_table
    from host_sim.transport.buses import open_bus

    watch = BusWatch(arguments.bitrate)
    limit_s: float = arguments.limit_s

    with open_bus(arguments.bus, bitrate=arguments.bitrate) as bus:
        if not arguments.all:
            filter_robots(bus)
        try:
            if sys.stdout.isatty():
                watch_table(bus, watch, arguments.bus, sys.stdout, limit_s)
            else:
                watch_lines(bus, watch, sys.stdout, limit_s)
        except KeyboardInterrupt:
            sys.stdout.flush()  # here, where a reader that is gone is noticed
    return 0
