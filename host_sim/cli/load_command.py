"""`tools/octet load`: the bus load, at worst or in a log."""

import argparse
import sys

from host_sim.cli.parsing import Subparsers, add_command, file_path

_EXAMPLES = """\
examples:
  tools/octet load                   worst case of 1, 2, 3... robots at each bit rate
  tools/octet load out/run.log       the load in a log, with stuff bits, beside the worst case
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "load",
        _load,
        summary="print the bus load",
        description="Prints the bus load: the worst case from octet.dbc, or as measured in a log.\n"
        "Figures in brackets are for robots that ask for RANGES.",
        epilog=_EXAMPLES,
    )
    parser.add_argument("log", type=file_path, nargs="?", metavar="LOG", help="log to measure (default: worst case)")


def _load(arguments: argparse.Namespace) -> int:
    from host_sim.recording.log_reader import read_log
    from host_sim.report.bus_load import load_tables, measure, measured_text

    if arguments.log is None:
        sys.stdout.write(load_tables())
        return 0
    log = read_log(arguments.log)
    sys.stdout.write(measured_text(measure(log)))
    if note := log.note():
        print(f"octet: {note}", file=sys.stderr)
    return 0
