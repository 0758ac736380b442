"""`tools/octet campaign`: each fault in each configuration, and a report of what came of it."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.cli.parsing import add_command, number
from host_sim.protocol.generated import PROFILES

if TYPE_CHECKING:
    from host_sim.cli.parsing import Subparsers

_EXAMPLES = """\
examples:
  tools/octet campaign out/campaign.html                     every behaviour in lockstep, within this process
  tools/octet campaign out/real.html --links fd --real-time --profiles article adaptive

The exit code is 1 if a fault was not seen, wheels turned on for more than 100 ms, a run broke, or something wrong was
learned from a bad bus without a word.
"""


def add(commands: "Subparsers") -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "campaign",
        _campaign,
        summary="make every fault happen, and report what came of it",
        description="Makes every fault happen in every configuration, and writes a report: a page for a browser.",
        epilog=_EXAMPLES,
    )
    add = parser.add_argument
    add("html", type=Path, metavar="FILE.html", help="where to write the report")
    add("--profiles", nargs="+", choices=PROFILES, default=list(PROFILES), metavar="NAME", help="(default: all)")
    add(
        "--links", nargs="+", choices=("none", "fd"), default=["none"], metavar="BUS", help="none, fd (default: none)"
    )
    add("--real-time", action="store_true", help="in real time, too, where the robot is a process of its own")
    add("--limit-s", type=number(1, 600, float), default=30.0, help="robot time of each run (default: %(default)g)")


def _campaign(arguments: argparse.Namespace) -> int:
    from host_sim.atomic_file import write_bytes
    from host_sim.campaign.cells import cells
    from host_sim.campaign.html_report import page, summary, verdict
    from host_sim.campaign.outcome import run_all

    paces = (False, True) if arguments.real_time else (False,)
    outcomes = []
    for outcome in run_all(cells(arguments.profiles, arguments.links, paces, arguments.limit_s)):
        outcomes.append(outcome)
        if outcome.problems:
            print(
                f"{verdict(outcome)}: {outcome.end or outcome.cell.fault}: {outcome.cell.command()}", file=sys.stderr
            )
    write_bytes(arguments.html, page(outcomes).encode())
    print(summary(outcomes))
    print(f"wrote {arguments.html}")
    return int(any(outcome.problems for outcome in outcomes))
