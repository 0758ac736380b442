"""`tools/octet debug`: gdb on the robot of a log, at any tick."""

import argparse
import os
import shlex
import tempfile
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.cli.own_source import add_source_options, check_own, own_of
from host_sim.cli.parsing import Subparsers, add_command, file_path, number
from host_sim.cli.run_options import add_channel, add_option

if TYPE_CHECKING:
    from host_sim.lab.debug.feed import Feed

_TICK_MAX = 2**32 - 1
_OF_OWN = ["-ex", "break own_next", "-ex", "break guard_fail"]
_EXAMPLES = """\
examples:
  tools/octet debug out/run.log --tick 371              gdb, where tick 371 enters the robot's step
  tools/octet debug out/run.log --at 7.4                the same tick, by its time in s
  tools/octet debug out/run.log --decision 12           where the robot begins its 12th action
  tools/octet debug out/run.log --tick 371 --ex 'print *sensed' --ex backtrace     without a terminal

In gdb, `continue` goes on to the next tick, `goto 98` starts again and stops at tick 98, and `cells` prints the eight
bytes. docs/debugging.md has more, and how to use it from Visual Studio Code.
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "debug",
        _debug,
        summary="stop at any tick of a log in gdb",
        description="Feeds the senses of a recorded log to the firmware, built for debugging, and stops it in gdb\n"
        "where the tick enters the robot's step. On the way it compares its drives with the log's.",
        epilog=_EXAMPLES,
        stages=lambda _: ["debug"],
    )
    parser.add_argument("log", type=file_path, metavar="RUN.LOG", help="log of a run, of candump or of python-can")
    add_channel(parser)
    add_source_options(parser)
    add_option(parser, "node")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--tick", type=number(0, _TICK_MAX), default=0, metavar="N", help="the tick (default: 0)")
    seconds = number(0, _TICK_MAX, float)
    where.add_argument("--at", type=seconds, metavar="S", help="the tick at this time of the log, s")
    action = "the tick in which the robot begins its Nth action"
    where.add_argument("--decision", type=number(1, _TICK_MAX), metavar="N", help=action)
    there = "run a command of gdb there, and end; may be repeated"
    parser.add_argument("--ex", action="append", default=[], metavar="COMMAND", help=there)
    written = "instead, write the frames to DIR for an editor's debugger, and print gdb's command"
    parser.add_argument("--out", type=file_path, metavar="DIR", help=written)


def _debug(arguments: argparse.Namespace) -> int:
    from host_sim.lab.debug.feed import Feed
    from host_sim.protocol.codec import Protocol
    from host_sim.recording.log_reader import read_log
    from host_sim.recording.world_file import read_world, world_path
    from host_sim.sim.debugger import LOG_SCRIPT, OCTET_DEBUG, Gdb, debug_program, gdb_command
    from host_sim.sim.in_process_link import Program

    world = world_path(arguments.log)
    record = read_world(world) if world.exists() else None
    own, protocol = own_of(arguments, record), Protocol(arguments.node)
    if isinstance(own, Program):
        raise UsageError(f"the brain in {arguments.log} is a program, not C: the page shows it step by step")
    feed = Feed(read_log(arguments.log, arguments.channel), protocol, own)
    if own is None:
        check_own(arguments, (it.frame for it in feed.heard if it.frame), protocol)
    tick = _tick(arguments, feed)
    with ExitStack() as stack:
        folder = arguments.out or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="octet-debug-")))
        _write(folder, feed)
        program = os.fspath(own.debugger) if own else debug_program(OCTET_DEBUG)
        there = ["-ex", f"set cwd {folder.resolve()}", *_OF_OWN * (own is not None), "-ex", f"goto {tick}"]
        start = [program, "-x", LOG_SCRIPT, *there]
        if arguments.out:
            print(f"wrote     {folder / 'feed'}; to start: {shlex.join(gdb_command(start))}")
            return 0
        gdb = Gdb([*start, *(word for it in arguments.ex for word in ("-ex", it)), *["-batch"] * bool(arguments.ex)])
        stack.callback(gdb.close)
        return gdb.wait()


def _tick(arguments: argparse.Namespace, feed: "Feed") -> int:
    if arguments.decision is not None:
        return feed.tick_of_decision(arguments.decision)
    tick = arguments.tick if arguments.at is None else feed.tick_at(arguments.at)
    if tick > feed.senses[-1].tick:
        raise UsageError(f"{arguments.log} has no tick {tick}: the last one is {feed.senses[-1].tick}")
    return int(tick)


def _write(folder: Path, feed: "Feed") -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "feed").write_text(feed.text())
    except OSError as error:
        raise UsageError(f"cannot write to {folder}: {error.strerror}") from error
