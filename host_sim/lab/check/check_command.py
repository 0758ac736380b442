"""`tools/octet check`: checks a robot against docs/protocol.md, sentence by sentence."""

import argparse
import sys
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.base.terminal import GREEN, RED, coloured
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, number, output_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from host_sim.lab.check.checking import Verdict

_JOBS, _TRIES = 4, 3
"""Robots at once, each on a bus of its own, since they mostly wait; and the number of attempts per check."""

_EXAMPLES = """\
examples:
  tools/octet check --robot-command 'python3 examples/robot/robot.py'
  tools/octet check --bus socketcan:can0 --node 3 --junit robot.xml

The command finds its bus in CAN_INTERFACE and CAN_CHANNEL, and its number in OCTET_NODE: see docs/bench.md. A
sentence fails if its check fails three times, since a busy host may itself be late. Exit code 1 if a sentence does
not hold, 2 if no robot answers.
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "check",
        _judge_robot,
        summary="check a robot of your own against docs/protocol.md",
        description="Checks a robot against docs/protocol.md, sentence by sentence.",
        epilog=_EXAMPLES,
        check=_check,
    )
    add = parser.add_argument
    add("--robot-command", metavar="CMD", help="start this program as the robot, for each check")
    bus = "fd (a socket pair, with --robot-command), or INTERFACE:CHANNEL (default: fd)"
    add("--bus", default="fd", metavar="BUS", help=bus)
    add("--node", type=number(1, 31), default=1, help="the robot's node number, 1..31 (default: 1)")
    add("--json", type=output_of(".json"), metavar="FILE.json", help="also write the results as JSON")
    add("--junit", type=output_of(".xml"), metavar="FILE.xml", help="also write the results as JUnit XML")
    add("--all", action="store_true", help="also print the sentences that hold")


def _check(arguments: argparse.Namespace) -> None:
    if arguments.robot_command is None and arguments.bus == "fd":
        raise UsageError("check needs a robot: give --robot-command CMD, or --bus INTERFACE:CHANNEL")
    check_outputs("check", None, {"--json": arguments.json, "--junit": arguments.junit})


def _judge_robot(arguments: argparse.Namespace) -> int:
    from host_sim.base.result_files import Case, write_results
    from host_sim.lab.check.checking import check_robot, external, started

    command, bus, node = arguments.robot_command, arguments.bus, arguments.node
    if command is not None:
        verdicts = check_robot(lambda: started(command, bus, node), jobs=_JOBS if bus == "fd" else 1, tries=_TRIES)
    else:
        verdicts = check_robot(lambda: external(bus, node), missing=("T1", "S6"), tries=_TRIES)
    for verdict in verdicts:
        if verdict.state == "fails" or arguments.all:
            _print(verdict)
    cases = [
        Case(f"{each.number}: {each.text}", _WORDS[each.state], "\n".join([each.why, *each.frames]).strip())
        for each in verdicts
    ]
    write_results("check", cases, arguments.json, arguments.junit)
    print(_summary(verdicts))
    return int(any(verdict.state == "fails" for verdict in verdicts))


_WORDS = {"holds": "passed", "fails": "failed", "not checked": "skipped"}


def _print(verdict: "Verdict") -> None:
    state = coloured(verdict.state, RED if verdict.state == "fails" else GREEN, sys.stdout)
    print(f"{state} {verdict.number}: {verdict.text}")
    if verdict.why:
        print(f"  {verdict.why}")
    for line in verdict.frames:
        print(f"    {line}")


def _summary(verdicts: "Sequence[Verdict]") -> str:
    count = {state: sum(verdict.state == state for verdict in verdicts) for state in _WORDS}
    failed = [verdict.number for verdict in verdicts if verdict.state == "fails"]
    names = f": {', '.join(failed)}" if failed else ""
    return f"{count['holds']} sentences hold, {count['not checked']} are not checked, {len(failed)} fail{names}"
