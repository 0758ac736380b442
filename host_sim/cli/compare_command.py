"""`tools/octet compare`: behaviours side by side in the same worlds."""

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from typing import TYPE_CHECKING

from host_sim.cli.parsing import add_command, number, setting
from host_sim.protocol.generated import PROFILES
from host_sim.study.faults import FAULTS
from host_sim.study.table import table
from host_sim.study.trial import Trial, run_trial

if TYPE_CHECKING:
    from host_sim.cli.parsing import Subparsers

_EXAMPLES = """\
examples:
  tools/octet compare article fixed never --seeds 40         what learning and remembering are worth
  tools/octet compare article forgetful --fault swapped      with the motors' plugs exchanged
"""
_DEFAULT = " (default: %(default)s)"


def add(commands: "Subparsers") -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "compare",
        _compare,
        summary="measure behaviours in the same worlds",
        description="Runs each profile with the same seeds, in process and on all cores, and prints a table.",
        epilog=_EXAMPLES,
    )
    add = parser.add_argument
    add("profiles", nargs="+", choices=PROFILES, metavar="PROFILE", help=f"one of {', '.join(PROFILES)}")
    add("--seeds", type=number(1, 100_000), default=20, metavar="N", help="number of seeds, from 1 on" + _DEFAULT)
    add("--first", type=number(0, 2**31), default=1, metavar="SEED", help="first seed" + _DEFAULT)
    add("--environments", type=number(1, 1000), default=5, metavar="N", help="environments a seed" + _DEFAULT)
    add("--set", type=setting, action="append", default=[], metavar="NAME=VALUE", help="change a parameter for all")
    add("--fault", choices=FAULTS, default="none", help="what is wrong with the body" + _DEFAULT)
    add("--fault-from", type=number(1, 1000), default=1, metavar="N", help="from environment N on" + _DEFAULT)
    add("--jobs", type=number(1, 1024), default=os.cpu_count(), metavar="N", help="processes" + _DEFAULT)


def _compare(arguments: argparse.Namespace) -> int:
    a = arguments
    trials = [
        Trial(profile, seed, a.environments, dict(a.set), a.fault, a.fault_from)
        for seed in range(a.first, a.first + a.seeds)
        for profile in dict.fromkeys(a.profiles)
    ]
    rows = []
    with ProcessPoolExecutor(a.jobs) as processes:
        for done, result in enumerate(processes.map(run_trial, trials), 1):
            rows += result
            if sys.stderr.isatty():
                print(f"\r{done} of {len(trials)} runs", end="" if done < len(trials) else "\n", file=sys.stderr)
    print(f"{a.seeds} seeds of {a.environments} environments each, body: {a.fault}")
    print(table(rows))
    return 0
