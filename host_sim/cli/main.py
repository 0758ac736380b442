"""The command line: `tools/octet COMMAND ...`."""

import argparse
import math
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from host_sim.cli.run_options import BOARDS, ROBOTS, RunOptions, WatchOptions
from host_sim.errors import OctetError, UsageError
from host_sim.live.orders import FULL_SPEED
from host_sim.protocol.codec import NODE_MAX, Protocol

if TYPE_CHECKING:
    from host_sim.recording.resimulation import Resimulation

_VALUE_MAX = 65535
_BUS_HELP = "auto, fd (socket pair), none (in this process), or python-can's INTERFACE:CHANNEL"
_ROBOT_HELP = "start one, wait for one on the bus, or run the flash image in QEMU or emulated (spawn)"
_RUN_EXAMPLES = """\
examples:
  tools/run                                          five environments, as in the article
  tools/run --seed 7 --environments 1 --real-time    one, as fast as a real robot
  tools/run --memory robot.mem                       go on with what was learned last time
  tools/run --set turn_deg=20 --set boredom_limit=6  another character
  tools/run --robot emulated --board stm32f103       the very image that is flashed
  tools/run --bus socketcan:can0 --robot external --real-time
                                                     a real robot on a real bus
"""
_WATCH_EXAMPLES = """\
examples:
  tools/octet watch                                  one robot, five environments, your browser
  tools/octet watch --seed 7 --memory robot.mem      other environments, and what was learned last time
  tools/octet watch --listen 0.0.0.0                 for a classroom: prints an address with a token
  tools/octet watch --terminal                       where there is no browser, as over ssh
"""
_REPLAY_EXAMPLES = """\
examples:
  tools/octet replay out/run.log                     does today's firmware do the same?
  tools/octet replay out/run.log --html run.html     a page to look at and keep
"""
_PICTURE_EXAMPLES = """\
examples:
  tools/octet picture out/run.log --png run.png                    the whole run, as `run` leaves it
  tools/octet picture out/run.log --gif trial.gif --from 12 --to 20
"""


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message}; see {self.prog} --help")


def _number(low: float, high: float, kind: type[int] | type[float] = int) -> Callable[[str], int | float]:
    """An argument type: a number within a range."""

    def parse(text: str) -> int | float:
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"a number from {low:.0f} to {high:.0f} is wanted, not {text!r}")
        return value

    return parse


def _setting(text: str) -> tuple[str, int]:
    """An argument type: NAME=VALUE of a parameter."""
    name, _, value = text.partition("=")
    names = Protocol().choices("COMMAND", "parameter")
    if name not in names:
        raise argparse.ArgumentTypeError(f"no parameter {name!r}; there are {', '.join(names)}")
    if not value.isdecimal() or int(value) > _VALUE_MAX:
        raise argparse.ArgumentTypeError(f"{name} takes a number from 0 to {_VALUE_MAX}, not {value!r}")
    return name, int(value)


def _add_run(commands: "argparse._SubParsersAction[_Parser]") -> None:
    run = commands.add_parser(
        "run",
        help="let a robot learn in the simulated arena",
        description="A robot made of the real firmware learns to find its food in random environments.",
        epilog=_RUN_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_run_options(run)
    add = run.add_argument
    add("--real-time", action="store_true", help="keep the wall's time instead of racing")
    add("--watch", action="store_true", help="show it in the browser meanwhile")
    _add_watch_options(run)
    run.set_defaults(command=_run)


def _add_watch(commands: "argparse._SubParsersAction[_Parser]") -> None:
    watch = commands.add_parser(
        "watch",
        help="watch a robot learn in the browser, and meddle",
        description="The same run as `run`, in real time in the browser, with controls. Ctrl-C ends it.",
        epilog=_WATCH_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_run_options(watch)
    _add_watch_options(watch)
    watch.add_argument("--terminal", action="store_true", help="draw it in this terminal instead, as over ssh")
    watch.set_defaults(command=_watch)


def _add_watch_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--port", type=_number(0, 65535), default=8138, help="where the browser finds it; 0 for any free port (8138)")
    add("--listen", metavar="ADDRESS", help="let other machines watch, who know the token (this machine only)")


def _add_run_options(parser: argparse.ArgumentParser) -> None:
    profiles = tuple(Protocol().choices("COMMAND", "profile"))
    add = parser.add_argument
    add("--seed", type=_number(0, 2**32 - 1), default=1, help="of environments and random turns (1)")
    add("--environments", type=_number(1, 1000), default=5, metavar="N", help="how many, one after the other (5)")
    add("--profile", choices=profiles, default=profiles[0], help=f"how it behaves ({profiles[0]})")
    add("--set", type=_setting, action="append", default=[], metavar="NAME=VALUE", help="change a parameter")
    add("--bus", default="auto", help=_BUS_HELP)
    add("--robot", choices=ROBOTS, default=ROBOTS[0], help=_ROBOT_HELP)
    add("--board", choices=BOARDS, default=BOARDS[0], help=f"the one that is emulated ({BOARDS[0]})")
    add("--node", type=_number(1, NODE_MAX), default=1, help="the robot's number on the bus (1)")
    add("--limit-s", type=_number(1, 36000, float), default=600.0, help="robot time for each environment (600)")
    add("--memory", type=Path, metavar="FILE", help="load the eight bytes from FILE before, save them after")
    add("--out", type=Path, default=Path("out"), metavar="DIR", help="where log, summary and picture go (out)")
    add("--json", action="store_true", help="print the summary, and nothing else")
    add("--quiet", action="store_true", help="print nothing")


def _add_replay(commands: "argparse._SubParsersAction[_Parser]") -> None:
    replay = commands.add_parser(
        "replay",
        help="compare a recorded log with the firmware, or make a page of it",
        description="Feeds the senses of a recorded log to the firmware and compares its drives with the log's.",
        epilog=_REPLAY_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_log_options(replay)
    replay.add_argument("--html", type=Path, metavar="FILE", help="make a page of it instead, to play in a browser")
    replay.set_defaults(command=_replay)


def _add_picture(commands: "argparse._SubParsersAction[_Parser]") -> None:
    picture = commands.add_parser(
        "picture",
        help="make an animation or a picture of a recorded log",
        description="Draws a recorded run, for a README or a lesson.",
        epilog=_PICTURE_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_log_options(picture)
    add = picture.add_argument
    add("--gif", type=Path, metavar="FILE", help="an animation, for at most some 45 s")
    add("--png", type=Path, metavar="FILE", help="one picture of the whole run")
    time = _number(0, 1e9, float)
    add("--from", type=time, default=0.0, metavar="S", dest="from_s", help="robot time at which it begins (0)")
    add("--to", type=time, metavar="S", dest="to_s", help="robot time at which it ends (the run's end)")
    add("--speed", type=_number(0.1, 1000, float), default=1.0, metavar="X", help="times real time (1)")
    add("--width", type=_number(320, 1280), default=640, metavar="PX", help="of the animation (640)")
    picture.set_defaults(command=_picture)


def _add_log_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("log", type=Path, metavar="RUN.LOG", help="as a run left it, or candump -L")
    add("--node", type=_number(1, NODE_MAX), default=1, help="the robot's number on the bus (1)")
    add("--no-world", action="store_true", help="draw the way by the odometers alone, as for a log of a real body")


def _add_protocol(commands: "argparse._SubParsersAction[_Parser]") -> None:
    protocol = commands.add_parser(
        "protocol",
        help="print the description of the wire",
        description="Prints docs/protocol.md, made from hal/protocol/octet.dbc.",
    )
    protocol.set_defaults(command=_protocol)


def _run(arguments: argparse.Namespace) -> int:
    if arguments.watch:
        speed = 1.0 if arguments.real_time else FULL_SPEED
        return _run_watched(arguments, WatchOptions(arguments.listen, arguments.port, speed, stays=False))
    from host_sim.backends.bus_choice import choose_bus
    from host_sim.cli.run_command import run

    run(_run_options(arguments, choose_bus(arguments.bus, arguments.robot)))
    return 0


def _watch(arguments: argparse.Namespace) -> int:
    return _run_watched(arguments, WatchOptions(arguments.listen, arguments.port, terminal=arguments.terminal))


def _run_watched(arguments: argparse.Namespace, watch: WatchOptions) -> int:
    """The page keeps the time, so the robot waits for it; a bus in a network of its own would hide the page."""
    from host_sim.cli.run_command import run

    options = _run_options(arguments, "fd" if arguments.bus == "auto" else arguments.bus)
    run(replace(options, real_time=False, watch=watch))
    return 0


def _run_options(arguments: argparse.Namespace, bus: str) -> RunOptions:
    names = {option.name for option in fields(RunOptions)} - {"watch"}
    given = {name: value for name, value in vars(arguments).items() if name in names}
    return RunOptions(**{**given, "settings": dict(arguments.set), "bus": bus})


def _replay(arguments: argparse.Namespace) -> int:
    if arguments.html is not None:
        return _replay_page(arguments)
    from host_sim.cli.replay_command import replay, tell

    protocol = Protocol(arguments.node)
    outcome = replay(arguments.log, protocol)
    print(tell(outcome, arguments.log, protocol))
    return 0 if outcome.difference is None else 1


def _replay_page(arguments: argparse.Namespace) -> int:
    from host_sim.report.replay_page import write_page

    found = _retrace(arguments)
    write_page(arguments.html, found.trajectory, found.title)
    print(f"left      {arguments.html}")
    return 0


def _picture(arguments: argparse.Namespace) -> int:
    from host_sim.report.animation import Clip, write_gif
    from host_sim.report.still import write_still

    if arguments.gif is None and arguments.png is None:
        raise UsageError("say --gif FILE for an animation, or --png FILE for a picture")
    trajectory = _retrace(arguments).trajectory
    if arguments.gif is not None:
        write_gif(arguments.gif, trajectory, Clip(arguments.from_s, arguments.to_s, arguments.speed, arguments.width))
    if arguments.png is not None:
        write_still(arguments.png, trajectory)
    print(f"left      {', '.join(str(path) for path in (arguments.gif, arguments.png) if path is not None)}")
    return 0


def _retrace(arguments: argparse.Namespace) -> "Resimulation":
    from host_sim.recording.resimulation import resimulate

    found = resimulate(arguments.log, Protocol(arguments.node), in_the_open=arguments.no_world)
    if not found.stopped:
        print(f"octet: {arguments.log} ends before its run does: this is what it has", file=sys.stderr)
    return found


def _protocol(arguments: argparse.Namespace) -> int:
    from host_sim.cli.protocol_page import page

    del arguments
    sys.stdout.write(page())
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what the command line says.

    Args:
        arguments: The words after the program's name; None for those that it was started with.

    Returns:
        The exit code: 0 done, 1 fault, 2 wrong usage, 130 interrupted.
    """
    parser = _Parser(prog="tools/octet", description="Octet: a robot that learns with eight bytes of memory.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)
    _add_run(commands)
    _add_watch(commands)
    _add_replay(commands)
    _add_picture(commands)
    _add_protocol(commands)
    try:
        parsed = parser.parse_args(arguments)
        code: int = parsed.command(parsed)
    except OctetError as error:
        print(f"octet: {error}", file=sys.stderr)
        code = error.exit_code
    except BrokenPipeError:
        # Whoever read our output has had enough; what is left of it must not fail a second time at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 1
    except KeyboardInterrupt:
        print("octet: interrupted; what was recorded is kept", file=sys.stderr)
        code = 130
    return code
