"""`tools/octet talk`: asks a robot about a run, or talks to ELIZA."""

import argparse
import sys
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.cli.parsing import DEFAULT, Subparsers, add_command, file_path, number
from host_sim.cli.run_options import add_channel, resimulated
from host_sim.protocol.words import NODE_MAX

if TYPE_CHECKING:
    from host_sim.talk.conversation import Conversation, Source

_LINE_MAX = 2_000_000
_ROBOT = "robot"
_EXAMPLES = """\
examples:
  tools/octet talk                                 ask the robot of the last run
  tools/octet talk --at 41.9                       the robot as it was after 41.9 s
  tools/octet talk --script robot-de               ask it in German
  tools/octet talk --script eliza                  talk to ELIZA (1966), with a script written for Octet
  echo "Why did you turn left?" | tools/octet talk
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "talk",
        _talk,
        summary="ask the robot what it has learned and why it acted as it did",
        description="Answers sentences in the manner of ELIZA. [log] marks an answer with facts from the log, and\n"
        "cites the lines; [words] marks one without facts. Ctrl-D ends the conversation.",
        epilog=_EXAMPLES,
        check=_check,
    )
    add = parser.add_argument
    add("--log", type=file_path, metavar="RUN.LOG", help="log of the run to ask about (default: out/run.log)")
    add("--at", type=number(0, 1e9, float), metavar="S", help="robot time to ask about, s (default: end of the run)")
    add("--node", type=number(1, NODE_MAX), default=1, metavar="NODE", help="the robot's number" + DEFAULT)
    add("--no-world", action="store_true", help="ignore seed and world file, as for a real body")
    add_channel(parser)
    add("--memory", type=file_path, metavar="FILE", help="ask about a memory file alone, without a log")
    add("--script", default=_ROBOT, metavar="FILE", help="robot, robot-de, eliza, eliza-de or a file" + DEFAULT)


def _check(arguments: argparse.Namespace) -> None:
    if arguments.memory is not None and (arguments.log is not None or arguments.at is not None):
        raise UsageError("--memory is for a robot without a log: leave out --log and --at")


def _talk(arguments: argparse.Namespace) -> int:
    conversation, source = _begin(arguments)
    if sys.stdin.isatty():
        _complete([word.lower() for word in conversation.script.rules])
    sys.stdin.reconfigure(errors="replace")  # type: ignore[union-attr]
    print(conversation.script.greeting, flush=True)
    while True:
        try:
            sentence = input("> ") if sys.stdin.isatty() else sys.stdin.readline(_LINE_MAX)
        except EOFError:
            print()
            return 0
        if not sentence and not sys.stdin.isatty():
            return 0
        said = conversation.answer(sentence)
        print(source.line_of(said) if source else f"[{said.mark}] {said.text}", flush=True)


def _complete(words: list[str]) -> None:
    """Gives the console a history and tab completion for the words that a script knows."""
    try:
        import readline
    except ImportError:
        return  # the Windows console provides both

    def completed(begun: str, number: int) -> str | None:
        return next(islice((word for word in words if word.startswith(begun.lower())), number, None), None)

    readline.set_completer(completed)
    readline.parse_and_bind("tab: complete")


def _begin(arguments: argparse.Namespace) -> "tuple[Conversation, Source | None]":
    from host_sim.talk.conversation import about_memory, about_nothing, about_run

    if arguments.memory is not None:
        return about_memory(arguments.script, arguments.memory)
    if arguments.log is None:
        conversation = about_nothing(arguments.script)
        if not conversation.script.facts:
            return conversation, None
        arguments.log = Path("out/run.log")
        if not arguments.log.exists():
            raise UsageError(
                "there is no run in out/ to talk about: make one with tools/run, or give --log or --memory"
            )
    trajectory = resimulated(arguments).trajectory
    return about_run(arguments.script, trajectory, arguments.log, arguments.node, arguments.at)
