"""`tools/octet monitor`: shows the traffic on a bus, live."""

import argparse
import math
import sys

from host_sim.cli.parsing import Subparsers, add_command, number
from host_sim.cli.run_options import add_option

_EXAMPLES = """\
examples:
  tools/octet monitor socketcan:can0              a table of the robots, on a terminal
  tools/octet monitor socketcan:can0 | grep '!'   only warnings, from the output of one line per frame
  tools/octet monitor slcan:/dev/ttyACM0 --all    other frames too
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "monitor",
        _monitor,
        summary="show what is on a bus, live",
        description="Shows the robots on a bus, live: their state, rates, lost and damaged frames, and what looks\n"
        "wrong. Prints one line per frame if the output is not a terminal. Ctrl-C ends it.",
        epilog=_EXAMPLES,
    )
    add = parser.add_argument
    add("bus", metavar="BUS", help="any bus of python-can: INTERFACE:CHANNEL, such as socketcan:can0")
    add("--all", action="store_true", help="show all frames (default: only the robots'; the kernel filters the rest)")
    add_option(parser, "bitrate")
    add(
        "--limit-s",
        type=number(0.1, 1e9, float),
        default=math.inf,
        metavar="S",
        help="end after S seconds (default: at Ctrl-C)",
    )


def _monitor(arguments: argparse.Namespace) -> int:
    from host_sim.cli.interruption import until_ctrl_c
    from host_sim.lab.monitor.bus_watch import BusWatch
    from host_sim.lab.monitor.kernel_queue import lengthen
    from host_sim.lab.monitor.monitor import filter_robots, watch_lines, watch_table
    from host_sim.transport.buses import open_bus

    watch = BusWatch(arguments.bitrate)
    with until_ctrl_c(arguments.limit_s) as goes_on, open_bus(arguments.bus, bitrate=arguments.bitrate) as bus:
        lengthen(bus)
        if not arguments.all:
            filter_robots(bus)
        if sys.stdout.isatty():
            watch_table(bus, watch, arguments.bus, sys.stdout, goes_on)
        else:
            watch_lines(bus, watch, sys.stdout, goes_on)
    return 0
