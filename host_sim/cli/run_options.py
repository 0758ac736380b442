"""What a person can say about a run, on the command line."""

import argparse
from dataclasses import dataclass, fields
from pathlib import Path

from host_sim.backends.images import BOARDS
from host_sim.cli.parsing import number, setting
from host_sim.protocol.generated import NODE_MAX, PROFILES
from host_sim.sim.run_config import ROBOTS, RunConfig

_DEFAULT = " (default: %(default)s)"
_BUS_HELP = "auto, fd (socket pair), none (in this process), or python-can's INTERFACE:CHANNEL (default: %(default)s)"
_ROBOT_HELP = "start one, wait for one on the bus, or run the flash image in QEMU or on an emulated board" + _DEFAULT


@dataclass(frozen=True)
class WatchOptions:
    """How people watch a run.

    Attributes:
        listen: Address for others to reach us at; None for this machine only.
        port: Where to listen; 0 for any port that is free.
        speed: To begin with, times real time; 0 is as fast as it goes.
        stays: Whether to go on serving after the last environment.
        terminal: Whether to draw it in the terminal instead of serving it.
    """

    listen: str | None = None
    port: int = 8138
    speed: float = 1.0
    stays: bool = True
    terminal: bool = False


@dataclass(frozen=True)
class RunOptions:
    """A run, and what is to become of it.

    Attributes:
        config: The run.
        memory: File to load the memory from before, and to save it to after.
        out: Folder for what the run leaves behind.
        quiet: Say nothing.
        json: Print the summary alone.
        watch: How to show it to people; None for not at all.
    """

    config: RunConfig
    memory: Path | None = None
    out: Path = Path("out")
    quiet: bool = False
    json: bool = False
    watch: WatchOptions | None = None

    @property
    def talks(self) -> bool:
        """Whether to tell people how it goes."""
        return not (self.quiet or self.json)


def add_run_options(parser: argparse.ArgumentParser) -> None:
    """Adds what `run` and `watch` have in common."""
    add, default = parser.add_argument, RunConfig()
    add("--seed", type=number(0, 2**32 - 1), default=default.seed, help="of environments and random turns" + _DEFAULT)
    add(
        "--environments",
        type=number(1, 1000),
        default=default.environments,
        metavar="N",
        help="how many, one after the other" + _DEFAULT,
    )
    add(
        "--robots",
        type=number(1, NODE_MAX),
        default=default.robots,
        metavar="N",
        help="how many, in the same environments" + _DEFAULT,
    )
    add("--profile", choices=tuple(PROFILES), default=default.profile, help="what the robot behaves like" + _DEFAULT)
    add(
        "--set", type=setting, action="append", default=[], metavar="NAME=VALUE", help="change a parameter; see below"
    )
    add("--bus", default="auto", help=_BUS_HELP)
    add("--robot", choices=ROBOTS, default=default.robot, help=_ROBOT_HELP)
    add("--board", choices=BOARDS, default=BOARDS[0], help="the board that is emulated" + _DEFAULT)
    add("--node", type=number(1, NODE_MAX), default=default.node, help="the robot's number on the bus" + _DEFAULT)
    add(
        "--limit-s",
        type=number(1, 36000, float),
        default=default.limit_s,
        help="robot time for each environment, s" + _DEFAULT,
    )
    add("--memory", type=Path, metavar="FILE", help="load the eight bytes from FILE before, save them after")
    add("--out", type=Path, default=Path("out"), metavar="DIR", help="where log, summary and pictures go" + _DEFAULT)
    add("--json", action="store_true", help="print the summary, and nothing else")
    add("--quiet", action="store_true", help="print nothing")


def add_watch_options(parser: argparse.ArgumentParser) -> None:
    """Adds where a page is served."""
    add = parser.add_argument
    add(
        "--port",
        type=number(0, 65535),
        default=WatchOptions().port,
        help="the port of the page; 0 for any free port" + _DEFAULT,
    )
    add(
        "--listen",
        metavar="ADDRESS",
        help="let other machines with the token watch (default: this machine only)",
    )


def run_options(arguments: argparse.Namespace, bus: str, watch: WatchOptions | None = None) -> RunOptions:
    """The options in parsed arguments."""
    names = {field.name for field in fields(RunConfig)} & vars(arguments).keys()
    given = {name: getattr(arguments, name) for name in names}
    config = RunConfig(**{**given, "settings": dict(arguments.set), "bus": bus})
    return RunOptions(config, arguments.memory, arguments.out, arguments.quiet, arguments.json, watch)
