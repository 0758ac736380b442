"""`tools/octet dbc`: prints a DBC file for any nodes."""

import argparse
import re
import sys

from host_sim.cli.parsing import Subparsers, add_command, number
from host_sim.protocol.words import NODE_MAX

_EXAMPLES = """\
examples:
  tools/octet dbc --nodes 1-8 > robots.dbc       the robots 1 to 8
  tools/octet dbc --node 3 > robot.dbc           robot 3 alone
"""
_SPAN = re.compile(r"(\d{1,3})(?:-(\d{1,3}))?")


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "dbc",
        _dbc,
        summary="print a DBC file for any nodes",
        description="Prints the messages of any nodes as a DBC file: with cycle times, send types, start values,\n"
        "the parameters of the end-to-end protection, and unique names per node, such as N3_SENSES_feel.",
        epilog=_EXAMPLES,
    )
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--nodes", type=nodes, metavar="FIRST-LAST", help="node numbers, such as 1-8 or 1,3,5-7")
    which.add_argument("--node", type=number(1, NODE_MAX), metavar="NODE", help="one node number")


def nodes(text: str) -> list[int]:
    """An argument type: node numbers and ranges, separated by commas. Returns them sorted, without duplicates."""
    spans = [_SPAN.fullmatch(part) for part in text.split(",")]
    ends = [(int(span[1]), int(span[2] or span[1])) for span in spans if span]
    if len(ends) < len(spans) or any(not 1 <= first <= last <= NODE_MAX for first, last in ends):
        raise argparse.ArgumentTypeError(f"{text!r} is no list of nodes from 1 to {NODE_MAX}: write 1-8 or 1,3,5-7")
    return sorted({node for first, last in ends for node in range(first, last + 1)})


def _dbc(arguments: argparse.Namespace) -> int:
    from host_sim.report.dbc_file import dbc_text

    sys.stdout.write(dbc_text(arguments.nodes or [arguments.node]))
    return 0
