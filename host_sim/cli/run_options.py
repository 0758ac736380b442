"""The command-line options for a run."""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path

from host_sim.backends.images import BOARDS
from host_sim.cli.parsing import add_bitrate, number, setting
from host_sim.client.frame_log import COMPRESSED
from host_sim.faults.bus_faults import FAULTS
from host_sim.protocol.generated import NODE_MAX, PROFILES
from host_sim.sim.run_config import ROBOTS, RunConfig
from host_sim.world.world_names import WORLD_NAMES

_DEFAULT = " (default: %(default)s)"
_BUS_HELP = (
    "where the robot is: none (in this process), fd (socket pair), python-can's INTERFACE:CHANNEL, or "
    "auto (virtual CAN if available, else fd)" + _DEFAULT
)
_ROBOT_HELP = (
    "spawn: start the firmware here; external: wait for a robot on the bus; "
    "qemu, emulated: run the flash image in QEMU or on an emulated board" + _DEFAULT
)


LOGS = ("run.log", f"run.log{COMPRESSED}")
"""The log in a run's output folder: the plain one and the compressed one."""


@dataclass(frozen=True)
class WatchOptions:
    """How people watch a run.

    Attributes:
        listen: Address to listen on for other machines; None for this machine only.
        port: Port to listen on; 0 for any free port.
        speed: Initial speed as a multiple of real time; 0 is as fast as possible.
        stays: Whether the page is still served after the last environment.
        terminal: Whether the run is drawn in the terminal rather than served.
    """

    listen: str | None = None
    port: int = 8138
    speed: float = 1.0
    stays: bool = True
    terminal: bool = False


@dataclass(frozen=True)
class RunOptions:
    """A run and its outputs.

    Attributes:
        config: Configuration of the run.
        memory: File to load the memory from before the run, and to save it to afterwards; None for no file.
        out: Folder for the output files.
        compress_log: Whether the log is compressed.
        quiet: Whether to print nothing.
        json: Whether to print only the summary, as JSON.
        watch: How people watch the run; None if they do not.
    """

    config: RunConfig
    memory: Path | None = None
    out: Path = Path("out")
    compress_log: bool = False
    quiet: bool = False
    json: bool = False
    watch: WatchOptions | None = None

    @property
    def log(self) -> Path:
        """The file for the log."""
        return self.out / LOGS[self.compress_log]

    @property
    def talks(self) -> bool:
        """Whether to print progress and results as text."""
        return not (self.quiet or self.json)


def add_run_options(parser: argparse.ArgumentParser, robots_max: int = NODE_MAX) -> None:
    """Adds the options that `run` and `watch` share.

    Args:
        parser: Parser of the command.
        robots_max: Maximum number of robots.
    """
    add, default = parser.add_argument, RunConfig()
    add(
        "--seed",
        type=number(0, 2**32 - 1),
        default=default.seed,
        metavar="SEED",
        help="seed for environments and random turns, 0..4294967295" + _DEFAULT,
    )
    add(
        "--environments",
        type=number(1, 1000),
        default=default.environments,
        metavar="N",
        help="number of environments, one after the other" + _DEFAULT,
    )
    add(
        "--world",
        default=default.world,
        metavar="WORLD",
        help=f"what they are drawn from: {', '.join(WORLD_NAMES)}, or a file of your own, such as my.toml" + _DEFAULT,
    )
    add(
        "--change",
        action="append",
        default=[],
        metavar="CHANGE",
        help="let something change: NAME@120s, NAME@env6 or NAME@env6+20s of robot time, where NAME is plant, grow, "
        "swap-motors, mirror, stuck-on:SENSOR, stuck-off:SENSOR, noise:10/1000, weak-motor:left:60%%, "
        "swap-odometers, odometer:left:0%%, false-beacon:100 or repair, and /2 at the end means the second robot "
        "only; or a file with a change in each line; may be repeated",
    )
    add(
        "--robots",
        type=number(1, robots_max),
        default=default.robots,
        metavar="N",
        help=f"number of robots, up to {robots_max}" + _DEFAULT,
    )
    add("--profile", choices=tuple(PROFILES), default=default.profile, help="the robot's behaviour" + _DEFAULT)
    add(
        "--set",
        type=setting,
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="change a parameter; may be repeated (default: the values below)",
    )
    add("--bus", default="auto", help=_BUS_HELP)
    add_bitrate(parser)
    add("--robot", choices=ROBOTS, default=default.robot, help=_ROBOT_HELP)
    add("--board", choices=BOARDS, default=BOARDS[0], help="the board for --robot emulated" + _DEFAULT)
    add(
        "--node",
        type=number(1, NODE_MAX),
        default=default.node,
        metavar="NODE",
        help=f"the robot's number on the bus, 1..{NODE_MAX}; further robots get the next ones" + _DEFAULT,
    )
    _add_session_options(parser)
    add(
        "--limit-s",
        type=number(1, 36000, float),
        default=default.limit_s,
        metavar="S",
        help="time limit for each environment, s of robot time (default: %(default)g)",
    )
    add(
        "--memory",
        type=Path,
        metavar="FILE",
        help="load the eight bytes from FILE before the run, if it exists; save them afterwards (default: no file)",
    )
    add(
        "--out",
        type=Path,
        default=Path("out"),
        metavar="DIR",
        help="folder for page, picture, summary and log" + _DEFAULT,
    )
    add("--compress-log", action="store_true", help="write the log compressed, as run.log.gz")
    add("--json", action="store_true", help="print only the summary, as JSON")
    add("--quiet", action="store_true", help="print nothing")


def _add_session_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options for a bus that others use too, or that fails."""
    add, default = parser.add_argument, RunConfig()
    add(
        "--owner",
        type=number(1, 255),
        default=default.owner,
        metavar="N",
        help="number of this simulator, by which robots on a shared bus know whom they obey, 1..255" + _DEFAULT,
    )
    add(
        "--reconnect-s",
        type=number(0, 3600, float),
        default=default.reconnect_s,
        metavar="S",
        help="time to wait for a bus or an adapter that is gone, s (default: %(default)g)",
    )
    add(
        "--fault",
        action="append",
        default=[],
        metavar="RULE",
        help="make a fault on the way to the robot and back: NAME[:CHANCE%%][:SIZE][@FIRST[-LAST]][/to|/from], where "
        f"NAME is {', '.join(FAULTS)} and frames are counted from 1; @FILE: rules from a file; may be repeated",
    )
    add(
        "--fault-seed",
        type=number(0, 2**32 - 1),
        default=default.fault_seed,
        metavar="SEED",
        help="seed for the faults" + _DEFAULT,
    )


def add_watch_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options for serving a page."""
    add = parser.add_argument
    add(
        "--port",
        type=number(0, 65535),
        default=WatchOptions().port,
        metavar="PORT",
        help="port that the page is served on; 0 for any free port" + _DEFAULT,
    )
    add(
        "--listen",
        nargs="?",
        const="0.0.0.0",
        metavar="ADDRESS",
        help="serve the page to other machines, with a token: in all networks, or at one address of this machine; "
        "with several robots, each page gets one of its own (default: this machine only)",
    )


def run_options(arguments: argparse.Namespace, bus: str, watch: WatchOptions | None = None) -> RunOptions:
    """The options of a run.

    Args:
        arguments: The parsed command line.
        bus: The bus, resolved.
        watch: How people watch the run; None if they do not.
    """
    from host_sim.world.changes import read_changes
    from host_sim.world.worlds import world_of

    world_of(arguments.world)  # a mistake in it is found before anything is begun
    changes = tuple(change for text in arguments.change for change in read_changes(text))
    names = {field.name for field in fields(RunConfig)} & vars(arguments).keys()
    given = {name: getattr(arguments, name) for name in names}
    faults = _rules(arguments.fault)
    config = RunConfig(**{**given, "settings": dict(arguments.set), "bus": bus, "faults": faults, "changes": changes})
    return RunOptions(
        config,
        arguments.memory,
        arguments.out,
        compress_log=arguments.compress_log,
        quiet=arguments.quiet,
        json=arguments.json,
        watch=watch,
    )


def _rules(texts: Sequence[str]) -> tuple[str, ...]:
    """The rules that the command line gives for faults."""
    if not texts:
        return ()
    from host_sim.faults.rule import read_rules

    return tuple(rule for text in texts for rule in read_rules(text))
