"""`tools/octet replay`: compares a recorded log with the current firmware, or writes it as a page."""

import argparse
import sys
from typing import TYPE_CHECKING, Any

from host_sim.base.errors import UsageError
from host_sim.base.paths import PAGE_WASM, as_called
from host_sim.cli.own_source import add_source_options, check_own, log_words, own_of
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path
from host_sim.cli.run_options import add_log_options, resimulated

if TYPE_CHECKING:
    from host_sim.recording.resimulation import Resimulation

_SHOWN_MAX = 10
_EXAMPLES = """\
examples:
  tools/octet replay out/run.log                     does the current firmware do the same?
  tools/octet replay out/run.log --protocol          does the robot, with any firmware, keep to the protocol?
  tools/octet replay out/run.log --html run.html     write the run as a page to play in a browser
  tools/octet replay out/run.log --html run.html --what-if     a page on which the firmware runs on from any tick
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "replay",
        _replay,
        summary="compare a recorded log with the current firmware, or write it as a page",
        description="Feeds the senses of a recorded log to the current firmware and compares its drives with the\n"
        "log's. The exit code is 1 if they differ.",
        epilog=_EXAMPLES,
        check=_check,
        stages=lambda arguments: ["page" if arguments.what_if else "run"],
    )
    add_log_options(parser)
    page = "instead, write the run to FILE as a page to play in a browser"
    parser.add_argument("--html", type=file_path, metavar="FILE", help=page)
    add_source_options(parser)
    parser.add_argument("--protocol", action="store_true", help="check only that the robot keeps to the protocol")
    built = "with --html: build the firmware for pages first, so that the page can run on from any tick with"
    parser.add_argument("--what-if", action="store_true", help=f"{built}\nyour changes")


def _check(arguments: argparse.Namespace) -> None:
    if arguments.protocol and arguments.html is not None:
        raise UsageError("--protocol checks a log, and writes no page: leave out --html or --protocol")
    if arguments.what_if and arguments.html is None:
        raise UsageError("--what-if is for a page: name it with --html FILE")
    check_outputs("replay", arguments.log, {"--html": arguments.html})


def _replay(arguments: argparse.Namespace) -> int:
    if arguments.protocol:
        return _check_protocol(arguments)
    return _compare(arguments) if arguments.html is None else _write_page(arguments)


def _check_protocol(arguments: argparse.Namespace) -> int:
    """Checks only the protocol, for the robots from a node on."""
    from host_sim.protocol.codec import Protocol
    from host_sim.recording.conversation import check_conversation
    from host_sim.recording.log_reader import nodes_in, read_log

    log, first_node = arguments.log, arguments.node
    lines, sound = read_log(log, arguments.channel), True
    for node in sorted({first_node, *(node for node in nodes_in(lines) if node > first_node)}):
        found = check_conversation(lines, Protocol(node))
        counts = f"{found.commands} commands and {found.drives} senses answered, {len(found.problems)} problems"
        print("\n  ".join([f"{log}, node {node}: {counts}", *found.problems[:_SHOWN_MAX]]))
        sound = sound and not found.problems
    return 0 if sound else 1


def _compare(arguments: argparse.Namespace) -> int:
    """Compares the robots from a node on; the log must contain the first of them."""
    from host_sim.protocol.codec import Protocol
    from host_sim.recording.log_reader import nodes_in, read_log
    from host_sim.recording.replay import replay, report
    from host_sim.recording.world_file import read_world, world_path
    from host_sim.sim.in_process_link import Program

    log, first_node = arguments.log, arguments.node
    lines, world = read_log(log, arguments.channel), world_path(log)
    record = read_world(world) if world.exists() and not arguments.no_world else None
    own, equal = own_of(arguments, record), True
    nodes = sorted({first_node, *(node for node in nodes_in(lines) if node > first_node)})
    for node in nodes:
        protocol = Protocol(node)
        outcome = replay(lines, protocol, own)
        print(report(outcome, f"{log}, node {node}" if len(nodes) > 1 else str(log), protocol))
        equal = equal and outcome.difference is None
        if outcome.difference and not outcome.drives and not own:
            check_own(arguments, (line.frame for line in lines), protocol)
        if outcome.difference and not isinstance(own, Program):
            where = f"--node {node} --at {outcome.difference.time_us / 1e6:.6f}".rstrip("0").rstrip(".")
            print(as_called(f"  debugger  tools/octet debug {log_words(log, own.name if own else None)} {where}"))
    if note := lines.note():
        print(f"octet: {note}", file=sys.stderr)
    return 0 if equal else 1


def _write_page(arguments: argparse.Namespace) -> int:
    from host_sim.report.laboratory import NO_FIRMWARE
    from host_sim.report.replay_page import write_page

    result = resimulated(arguments)
    laboratory = _laboratory(arguments, result) if arguments.what_if or PAGE_WASM.exists() else NO_FIRMWARE
    log = log_words(arguments.log, arguments.profile)
    write_page(arguments.html, result.trajectory, result.title, laboratory, log=log)
    print(f"wrote     {arguments.html}")
    return 0


def _laboratory(arguments: argparse.Namespace, result: "Resimulation") -> dict[str, Any]:
    """The data that the page needs to ask "What if?"."""
    from host_sim.recording.log_reader import read_log
    from host_sim.report.laboratory import commands_in, laboratory, world_beside

    commands = commands_in(read_log(arguments.log, arguments.channel))
    found = laboratory(world_beside(arguments.log), result.trajectory, result.record, commands)
    if "why" in found and arguments.what_if:
        print(f"octet: {found['why']}", file=sys.stderr)
    return found
