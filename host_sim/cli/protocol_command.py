"""`tools/octet protocol`: prints the description of the bus protocol."""

import argparse
import sys

from host_sim.cli.parsing import Subparsers, add_command


def add(commands: Subparsers) -> None:
    """Adds the command."""
    add_command(
        commands,
        "protocol",
        _protocol,
        summary="print the description of the bus protocol",
        description="Prints docs/protocol.md, generated from hal/protocol/octet.dbc.",
        epilog="example:\n  tools/octet protocol > docs/protocol.md",
    )


def _protocol(_arguments: argparse.Namespace) -> int:
    from host_sim.report.protocol_page import page

    sys.stdout.write(page())
    return 0
