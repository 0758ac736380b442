"""The options of a run, as data: from the parsed command line to what a run is made of."""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from host_sim.base.compressed_file import COMPRESSED
from host_sim.base.errors import UsageError
from host_sim.sim.run_config import RunConfig
from host_sim.transport.bit_rates import BIT_RATE
from host_sim.world.physics_names import PYMUNK

LOGS = ("run.log", f"run.log{COMPRESSED}")
"""The log in a run's output folder: the plain one and the compressed one."""

FLEET_TABLE = "robots.csv"
"""The table of a fleet in its output folder."""

_NO_ADAPTER = ("auto", "none", "fd", "socketcan")
"""The interfaces whose bit rate is not set up here."""


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


def watch_options(arguments: argparse.Namespace, **others: Any) -> WatchOptions:
    """How people watch a run, as the command line and the command say."""
    port = WatchOptions().port if arguments.port is None else arguments.port
    return WatchOptions(arguments.listen, port, **others)


def check_no_page(arguments: argparse.Namespace, instead: str) -> None:
    """Refuses options for a page where there is none.

    Args:
        arguments: The parsed command line.
        instead: What to do about it.

    Raises:
        UsageError: There are such options.
    """
    given = {"--listen": arguments.listen, "--port": arguments.port}
    option = next((option for option, value in given.items() if value is not None), None)
    if option is not None:
        raise UsageError(f"{option} is for a page in the browser: {instead}, or leave {option} out")


def run_options(arguments: argparse.Namespace, bus: str, watch: WatchOptions | None = None) -> RunOptions:
    """The options of a run.

    Args:
        arguments: The parsed command line.
        bus: The bus, resolved.
        watch: How people watch the run; None if they do not.
    """
    from host_sim.world.changes import read_changes

    changes = tuple(change for text in arguments.change for change in read_changes(text))
    names = {field.name for field in fields(RunConfig)} & vars(arguments).keys()
    given = {name: getattr(arguments, name) for name in names}
    faults = _rules(arguments.fault)
    config = RunConfig(**{**given, **_resolved(arguments), "bus": bus, "faults": faults, "changes": changes})
    return RunOptions(
        config,
        arguments.memory,
        arguments.out,
        compress_log=arguments.compress_log,
        quiet=arguments.quiet,
        json=arguments.json,
        watch=watch,
    )


def check_run(arguments: argparse.Namespace) -> RunConfig:
    """Refuses options that contradict each other; the standard library is enough for that.

    Returns:
        The configuration of the run, with the bus as it was given.

    Raises:
        UsageError: There are such options.
    """
    from host_sim.backends.bus_choice import check_robot

    if arguments.board and arguments.robot != "emulated":
        raise UsageError(f"--board {arguments.board} is for --robot emulated: add that, or leave --board out")
    _check_bitrate(arguments.bitrate, arguments.bus)
    options = run_options(arguments, arguments.bus)
    if options.config.is_fleet:
        _check_fleet(options)
    else:
        check_robot(arguments.bus, arguments.robot, options.config.nodes)
    return options.config


def run_stages(arguments: argparse.Namespace) -> list[str]:
    """The stages of tools/setup that a run needs."""
    robot = {"qemu": ["images"], "emulated": ["images", "emulator"]}.get(arguments.robot, ["run"])
    return robot if arguments.listen is None else [*robot, "classroom"]


def _check_fleet(options: RunOptions) -> None:
    """Refuses what a fleet does not have."""
    config, default = options.config, RunConfig()
    fleets = "a fleet (more than 31 robots, or --worlds own)"
    if config.bus not in {"auto", "none"}:
        raise UsageError(f"{fleets} has no bus: leave --bus {config.bus} out, or run fewer robots in one world")
    unsuited = {
        "--robot": config.robot != default.robot,
        "--node": config.node != default.node,
        "--physics pymunk": config.physics == PYMUNK,
        "--change": config.changes != default.changes,
        "--fault": config.faults != default.faults,
        "--memory": options.memory is not None,
        "--compress-log": options.compress_log,
        "--real-time": config.real_time,
    }
    for name in (name for name, given in unsuited.items() if given):
        raise UsageError(f"{fleets} has no bus and keeps its memories in {FLEET_TABLE}: leave {name} out")


def _check_bitrate(bitrate: int, bus: str) -> None:
    """Refuses a bit rate where there is nothing to set it up in."""
    if bitrate != BIT_RATE and bus.partition(":")[0] in _NO_ADAPTER:
        raise UsageError(
            f"--bitrate is for an adapter that is not the kernel's, not for --bus {bus}: leave --bitrate out"
        )


def _resolved(arguments: argparse.Namespace) -> dict[str, Any]:
    """What the command line gives in another form than the configuration has it."""
    return {"settings": dict(arguments.set), "board": arguments.board or ""}


def _rules(texts: Sequence[str]) -> tuple[str, ...]:
    """The rules that the command line gives for faults."""
    if not texts:
        return ()
    from host_sim.faults.rule import read_rules

    return tuple(rule for text in texts for rule in read_rules(text))
