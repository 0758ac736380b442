"""The options of `run` and `watch`: `RunConfig`, output files and views; and the options that name a log."""

import argparse
import sys
from argparse import Namespace
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from host_sim.base.errors import UsageError
from host_sim.base.files import COMPRESSED
from host_sim.cli.parsing import file_path, number, settings, word_or_file
from host_sim.protocol.words import NODE_MAX
from host_sim.sim.access import BOARDS, PICO, check_robot
from host_sim.sim.option import Option, flag_of, option, options_of
from host_sim.sim.run_config import C_FILE, PROGRAM_FILE, RunConfig
from host_sim.transport.link import BIT_RATE
from host_sim.transport.rule import read_rules
from host_sim.world.body_kinds import PINS
from host_sim.world.changes import read_changes
from host_sim.world.names import PYMUNK

if TYPE_CHECKING:
    from host_sim.recording.resimulation import Resimulation

LOGS = ("run.log", f"run.log{COMPRESSED}")
"""The log in a run's output folder: the defaults one and the compressed one."""

FLEET_TABLE = "robots.csv"
"""The table of a fleet in its output folder."""

_NO_ADAPTER = ("auto", "none", "fd", "socketcan")
"""Interfaces whose bit rate the kernel or the process sets, not python-can."""

_FLEETS = f"a fleet (more than {NODE_MAX} robots, or --worlds own)"
_PARSERS: dict[Any, Callable[[str], Any]] = {
    Path | None: file_path,
    Path: file_path,
    dict[str, int]: settings,
    int: int,
}


_GROUPS = {
    "common options": (
        *("environments", "seed", "world", "profile", "settings", "robots", "memory", "out", "watch", "terminal"),
        *("real_time", "limit_s", "body", "changes", "robot"),
    ),
    "world": ("worlds", "physics"),
    "robot and bus": (*("bus", "bitrate", "robot_command", "board", "node", "owner", "reconnect_s", "fast", "gdb"),),
    "faults, and limits of a reliable result": ("faults", "fault_seed", "unanswered_max", "gap_max_s", "late_max"),
}
"""The options by their groups in the help text; the rest are output options."""
_OUTPUT = "output"
OTHER_GROUPS = (*list(_GROUPS)[1:], _OUTPUT)
"""The groups that only --help-all shows."""


@dataclass(frozen=True)
class RunOptions(RunConfig):
    """A run, its output files, and the views of it.

    Attributes:
        speed: Initial speed of a watched run, as a multiple of real time; 0 is as fast as possible.
        stays: Whether the page is still served after the last environment.
    """

    bus: str = field(default="auto", metadata=RunConfig.__dataclass_fields__["bus"].metadata)
    memory: Path | None = option(
        None,
        "load the eight bytes from FILE before the run, if it exists; save them afterwards",
        metavar="FILE",
        unset="no file",
        fleet=False,
    )
    out: Path = option(Path("out"), "folder for page, picture, summary and log", metavar="DIR")
    compress_log: bool = option(False, f"write the log compressed, as {LOGS[True]}", fleet=False)
    json: bool = option(False, "print only the summary, as JSON")
    quiet: bool = option(False, "print nothing")
    watch: bool = option(False, "show the run in the browser", commands=("run",))
    terminal: bool = option(False, "draw the run in this terminal instead of a browser", commands=("watch",))
    port: int = option(8138, "port to serve the page on; 0 for any free port", limits=(0, 65535), metavar="PORT")
    listen: str | None = option(
        None,
        "serve the page to other machines, with a token: on all interfaces, or on one address; with several robots, "
        "each page gets one of its own",
        metavar="ADDRESS",
        unset="this machine only",
        const="0.0.0.0",
    )
    speed: float = 1.0
    stays: bool = False

    @property
    def log(self) -> Path:
        """The file for the log."""
        return self.out / LOGS[self.compress_log]

    @property
    def verbose(self) -> bool:
        """Whether to print progress and results as text."""
        return not (self.quiet or self.json)

    @property
    def stages(self) -> list[str]:
        """The stages of tools/setup that the run needs."""
        emulated = [self.board or BOARDS[0]]
        if self.board != PICO or self.body == PINS:
            emulated.append("emulator")
        robot = {"qemu": ["qemu"], "emulated": emulated}.get(self.robot, ["run"])
        robot = ["run", *robot] if self.profile.endswith(C_FILE) and robot != ["run"] else robot
        if self.gdb:
            robot = {"spawn": ["debug"], "emulated": ["emulator", "debug-images"]}.get(self.robot, ["debug-images"])
        return robot if self.listen is None else [*robot, "classroom"]


def add_options(parser: argparse.ArgumentParser, command: str) -> None:
    """Adds a command's options; only those given on the command line are set."""
    rows = options_of(RunOptions)
    others = [name for name in rows if not any(name in names for names in _GROUPS.values())]
    for title, names in {**_GROUPS, _OUTPUT: others}.items():
        group = parser.add_argument_group(title)
        for name in names:
            if command in rows[name][1].commands:
                add_option(group, name, argparse.SUPPRESS)


def add_option(parser: argparse._ActionsContainer, name: str, default: object = None) -> None:
    """Adds an option of a run to any command, by default with the run's default."""
    it, row = options_of(RunOptions)[name]
    value = it.default if default is None else default
    parser.add_argument(flag_of(name, row), dest=name, default=value, **_argument(it, row))


def run_options(arguments: Namespace, **others: Any) -> RunOptions:
    """The options from a command line, and others.

    Raises:
        UsageError: The options contradict each other, or an option file cannot be read.
    """
    given = {name: value for name, value in vars(arguments).items() if name in options_of(RunOptions)}
    given["settings"] = {name: value for each in given.get("settings", ()) for name, value in each.items()}
    given["changes"] = tuple(change for text in given.get("changes", ()) for change in read_changes(text))
    given["faults"] = tuple(rule for text in given.get("faults", ()) for rule in read_rules(text))
    if given.get("robots", 1) > NODE_MAX:
        given.setdefault("worlds", "own")
    if not given.get("robot_command", "any").strip():
        raise UsageError("--robot-command is empty: name a program, or leave it out")
    options = RunOptions(**{**given, **others})
    _check(options)
    if (options.robot_command or options.gdb) and options.bus == "auto":
        return replace(options, bus="fd")
    return options


def _argument(it: Any, row: Option) -> dict[str, Any]:
    """An option as arguments for `ArgumentParser.add_argument`."""
    if it.type is bool:
        return {"action": "store_true", "help": row.text}
    kind = it.type
    default = f"{it.default:g}" if kind is float else str(it.default)
    values = [row.range] if row.limits or (row.metavar and row.choices) else []
    values += [f"default: {row.unset or default}"] if row.unset or it.default else []
    text = f"{row.text} ({'; '.join(values)})" if values else row.text
    how: dict[str, Any] = {"help": text.replace("%", "%%"), "metavar": row.metavar}
    how["type"] = number(*row.limits, kind) if row.limits else _PARSERS.get(kind, str)
    if row.endings:
        how["type"] = word_or_file(row.choices, row.endings)
    elif row.choices:
        how["choices"] = row.choices
    if row.const is not None:
        how |= {"nargs": "?", "const": row.const}
    if kind in (dict[str, int], tuple[str, ...]):
        how["action"] = "append"
    return how


def _check(options: RunOptions) -> None:
    """Refuses options that contradict each other, with the standard library only."""
    if not options.watch or options.terminal:
        for flag in _given(options, ("listen", "port")):
            instead = "leave --terminal out" if options.terminal else "add --watch"
            raise UsageError(f"{flag} is for a page in the browser: {instead}, or leave {flag} out")
    if options.robot_command and (options.bus == "none" or options.robot != "spawn"):
        other = "--bus none" if options.bus == "none" else f"--robot {options.robot}"
        raise UsageError(f"--robot-command starts a program on fd or socketcan: leave {other} out")
    _check_gdb(options)
    if options.board and options.robot != "emulated":
        raise UsageError(f"--board {options.board} is for --robot emulated: add that, or leave --board out")
    if options.bitrate != BIT_RATE and options.bus.partition(":")[0] in _NO_ADAPTER:
        raise UsageError(
            f"--bitrate is for adapters that python-can configures, not for --bus {options.bus}: leave --bitrate out"
        )
    if options.is_fleet:
        _check_fleet(options)
    elif options.robot == "observe":
        _check_observer(options)
    else:
        check_robot(options.bus, options.robot, options.nodes)


def _check_gdb(options: RunOptions) -> None:
    """Refuses options that do not work while the robot waits at a breakpoint."""
    here = {"spawn": ("auto", "fd"), **dict.fromkeys(("qemu", "emulated"), ("auto", "none", "fd"))}
    if options.gdb and options.bus not in here.get(options.robot, ()):
        raise UsageError(
            "--gdb starts the robot, on a socket pair or in an emulator: leave --bus and --robot out, or take qemu "
            "or emulated"
        )
    if options.gdb and (options.board == PICO or options.body == PINS):
        raise UsageError("--gdb is not for a pico or a body on pins: leave --gdb out, or name another board")
    if options.gdb and options.profile.endswith(PROGRAM_FILE):
        raise UsageError(f"--gdb stops in C, and {options.profile} is a program: leave --gdb out")
    for flag in _given(options, ("real_time", "watch", "robots", "robot_command")) if options.gdb else ():
        raise UsageError(f"--gdb debugs one robot in lockstep: leave {flag} out")


def _check_fleet(options: RunOptions) -> None:
    """Refuses options that do not apply to a fleet."""
    if options.watch:
        raise UsageError(f"a fleet cannot be watched: take up to {NODE_MAX} robots in one world, or run it unwatched")
    if options.bus not in {"auto", "none"}:
        raise UsageError(f"{_FLEETS} has no bus: leave --bus {options.bus} out, or run fewer robots in one world")
    unsuited = _given(options, [name for name, (_, row) in options_of(RunOptions).items() if not row.fleet])
    unsuited += ["--physics pymunk"] if options.physics == PYMUNK else []
    if unsuited:
        raise UsageError(f"{_FLEETS} has no bus and keeps its memories in {FLEET_TABLE}: leave {unsuited[0]} out")


def _check_observer(options: RunOptions) -> None:
    """Refuses options that have no effect on an observed robot."""
    check_robot(options.bus, options.robot, options.nodes)
    used = ("bus", "bitrate", "robot", "node", "limit_s", "out", "watch", "terminal")
    if ignored := _given(options, [it for it in options_of(RunOptions) if it not in used]):
        raise UsageError(f"--robot observe only looks on, at a robot that runs by itself: leave {ignored[0]} out")


def _given(options: RunOptions, names: Iterable[str]) -> list[str]:
    """The flags of those options whose values differ from the defaults."""
    rows, defaults = options_of(RunOptions), RunOptions()
    return [flag_of(it, rows[it][1]) for it in names if getattr(options, it) != getattr(defaults, it)]


def add_channel(parser: argparse.ArgumentParser) -> None:
    """Adds the option that selects one bus of a log."""
    which = "the interface or channel, such as can0, if the log has robots on several"
    parser.add_argument("--channel", metavar="NAME", help=which)


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options that `replay` and `picture` share."""
    add = parser.add_argument
    add("log", type=file_path, metavar="RUN.LOG", help="log of a run, of candump or of python-can")
    add_channel(parser)
    add_option(parser, "node")
    drawn = "ignore seed and world file and draw the path from the odometers only, as for a real body"
    add("--no-world", action="store_true", help=drawn)


def resimulated(arguments: argparse.Namespace) -> "Resimulation":
    """The run in a log; a log that is cut short is reported on stderr."""
    from host_sim.recording.resimulation import resimulate

    result = resimulate(arguments.log, arguments.node, ignore_world=arguments.no_world, channel=arguments.channel)
    if result.note:
        print(f"octet: {result.note}", file=sys.stderr)
    if not result.stopped:
        print(f"octet: {arguments.log} ends before the run does; showing what it has", file=sys.stderr)
    return result
