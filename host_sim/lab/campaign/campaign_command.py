"""`tools/octet campaign`: runs each fault in each configuration, and writes a report of the outcomes."""

import argparse
import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, number, output_of
from host_sim.protocol.words import PROFILES
from host_sim.sim.access import BOARDS

if TYPE_CHECKING:
    from host_sim.lab.campaign.cell import Cell, Outcome

_LINKS = ("none", "fd", "external", "slcan", "vcan", *BOARDS, "pins")
_JOBS = 16
"""Runs in lockstep at once: those with a robot in a process of its own mostly wait."""

_PROFILES_HELP = f"behaviours: {', '.join(PROFILES)} (default: all)"
_LINKS_HELP = (
    "how to reach the robot: none (in this process), fd (socket pair), external (your own program), slcan (serial "
    f"line), vcan (inside tools/with-vcan), or an emulated board: {', '.join(BOARDS)}; or pins: a stand-alone robot "
    "on a Blue Pill (default: none)"
)
_EXAMPLES = """\
examples:
  tools/octet campaign --html out/campaign.html              every behaviour in lockstep, within this process
  tools/octet campaign --html out/real.html --links fd slcan feather_stm32f405 --real-time --profiles article adaptive
  tools/with-vcan tools/octet campaign --html out/vcan.html --links vcan
  tools/octet campaign --walk 40 --links none fd slcan --limit-s 8
  tools/octet campaign --repeat 'article fd lockstep seed=12 limit=8 event=hang:300@100'
  tools/octet campaign --shrink 'article none lockstep seed=12 limit=30 fault=drop:30% fault=forge:stop@300/to'

Exit code 1 if in any run a fault went unnoticed, wheels kept turning for more than 100 ms, something wrong was
learned, the run's files lacked something without a message, or an unexpected error occurred.
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "campaign",
        _campaign,
        summary="inject every fault, and report the outcomes",
        description="Injects every fault into every configuration, and writes an HTML report.",
        epilog=_EXAMPLES,
        check=_check,
        stages=_stages,
    )
    add = parser.add_argument
    add("--html", type=output_of(".html"), metavar="FILE.html", help="write the report here")
    profiles, links = list(PROFILES), ["none"]
    add("--profiles", nargs="+", choices=PROFILES, default=profiles, metavar="NAME", help=_PROFILES_HELP)
    add("--links", nargs="+", choices=_LINKS, default=links, metavar="LINK", help=_LINKS_HELP)
    add("--robot-command", default="", metavar="CMD", help="program to start as the robot, for --links external")
    add("--json", type=output_of(".json"), metavar="FILE.json", help="also write the outcomes as JSON")
    add("--junit", type=output_of(".xml"), metavar="FILE.xml", help="also write the outcomes as JUnit XML")
    add("--real-time", action="store_true", help="also run in real time (not with --links none)")
    limit = "robot time of each run, 1..600 s (default: 60, in real time 10); longer for faults that show later"
    add("--limit-s", type=number(1, 600, float), metavar="S", help=limit)
    jobs = f"runs at once, each in a process (default: {_JOBS}; in real time and on vcan 1)"
    add("--jobs", type=number(1, 64), metavar="N", help=jobs)
    walk = "instead of each fault by itself, N random schedules of 1 to 6 faults; those that fail are shrunk"
    add("--walk", type=number(1, 100_000), default=0, metavar="N", help=walk)
    add("--seed", type=number(0, 2**32 - 1), default=1, help="seed of these schedules (default: %(default)d)")
    add("--repeat", metavar="RUN", help="rerun one run of a report and print its outcome")
    add("--shrink", metavar="RUN", help="find the smallest schedule of faults with the same outcome")


def _check(arguments: argparse.Namespace) -> None:
    if arguments.html is None and not arguments.walk and arguments.repeat is arguments.shrink is None:
        raise UsageError("campaign needs --html FILE.html for the report, or --walk, --repeat or --shrink")
    check_outputs("campaign", None, {"--html": arguments.html, "--json": arguments.json, "--junit": arguments.junit})
    links = (arguments.repeat or arguments.shrink or "").split() or arguments.links
    if bool(arguments.robot_command.strip()) != ("external" in links):
        raise UsageError("--links external and --robot-command CMD go together: give both")
    if (arguments.jobs or 1) > 1 and "vcan" in arguments.links:
        raise UsageError("vcan0 is one bus for one robot at a time: leave out --jobs")


def _stages(arguments: argparse.Namespace) -> Sequence[str]:
    links = (arguments.repeat or arguments.shrink or "").split() or arguments.links
    return ["images", "emulator"] if {*BOARDS, "pins"} & set(links) else ["run"]


def _campaign(arguments: argparse.Namespace) -> int:
    if arguments.repeat is not None:
        return _repeat(arguments.repeat, arguments.robot_command)
    if arguments.shrink is not None:
        return _shrink(arguments.shrink, arguments.robot_command)
    from host_sim.base.files import write_bytes
    from host_sim.base.result_files import Case, write_results
    from host_sim.lab.campaign.cell import unreached
    from host_sim.lab.campaign.html_report import page, summary, verdict

    outcomes = _all_outcomes(arguments)
    if arguments.html is not None:
        write_bytes(arguments.html, page(outcomes).encode())
    cases = [
        Case(
            f"{it.cell.configuration}: {it.cell.fault or 'no fault'}",
            "failed" if it.problems else "passed" if it.reach in {"", "reached"} else "skipped",
            "\n".join((verdict(it), *[f"fault: {it.reach}"] * bool(it.reach), it.cell.command())),
        )
        for it in outcomes
    ]
    write_results("campaign", cases, arguments.json, arguments.junit)
    print(summary(outcomes))
    if arguments.html is not None:
        print(f"wrote {arguments.html}")
    is_idle = not arguments.walk and bool(unreached(outcomes, ("never came",)))
    return int(any(outcome.problems for outcome in outcomes) or is_idle)


def _all_outcomes(arguments: argparse.Namespace) -> "list[Outcome]":
    """Runs everything, with a progress line, and prints the problems."""
    from host_sim.base.terminal import ProgressLine
    from host_sim.lab.campaign.running import run_all

    outcomes, cells = [], _cells(arguments)
    jobs = arguments.jobs or (1 if arguments.real_time or "vcan" in arguments.links else _JOBS)
    with ProgressLine(len(cells)) as line:
        for outcome in run_all(cells, jobs):
            outcomes.append(outcome)
            if outcome.problems:
                line.clear()
                _print_problem(outcome, is_shrunk=bool(arguments.walk))
            if line.is_due():
                line.show("runs", len(outcomes))
    return outcomes


def _print_problem(outcome: "Outcome", *, is_shrunk: bool) -> None:
    from host_sim.lab.campaign.html_report import verdict

    cell = outcome.cell
    print(f"{verdict(outcome)}: {outcome.end or cell.fault}: {cell.command()}", file=sys.stderr)
    if is_shrunk:
        *_, shortest = _shrunk(cell)
        print(f"  shortest: {shortest.cell.command()}", file=sys.stderr)


def _cells(arguments: argparse.Namespace) -> "list[Cell]":
    """The cells of all configurations."""
    from dataclasses import replace

    from host_sim.lab.campaign.cell import PACES
    from host_sim.lab.campaign.matrix import default_limit_s, groups
    from host_sim.lab.campaign.walk import walk

    paces = PACES if arguments.real_time else PACES[:1]
    limits_s = {pace: arguments.limit_s or default_limit_s(pace) for pace in paces}
    where = arguments.links, arguments.profiles, limits_s[PACES[0]]
    drawn = walk(arguments.walk, arguments.seed, *where)
    every = drawn or groups(arguments.profiles, arguments.links, paces, lambda pace: limits_s[pace])
    return [replace(cell, command_of_own=arguments.robot_command) for cells in every for cell in cells]


def _repeat(text: str, program: str) -> int:
    from dataclasses import replace

    from host_sim.lab.campaign.cell import Cell
    from host_sim.lab.campaign.html_report import account
    from host_sim.lab.campaign.matrix import recognised
    from host_sim.lab.campaign.running import run_one

    outcome = run_one(replace(recognised(Cell.parse(text)), command_of_own=program))
    print(account(outcome))
    return int(bool(outcome.problems))


def _shrink(text: str, program: str) -> int:
    from dataclasses import replace

    from host_sim.lab.campaign.cell import Cell

    for outcome in _shrunk(replace(Cell.parse(text), command_of_own=program)):
        print(f"{outcome.kind}: {outcome.cell}", flush=True)
    return 0


def _shrunk(cell: "Cell") -> "Iterator[Outcome]":
    """The outcomes of ever smaller cells of the same kind."""
    from host_sim.lab.campaign.running import run_one
    from host_sim.lab.campaign.walk import shrink

    return shrink(cell, run_one)
