"""The command line of a run: what `run` and `watch` share, and what serving a page adds."""

import argparse
from pathlib import Path

from host_sim.backends.images import BOARDS
from host_sim.cli.parsing import DEFAULT, add_bitrate, file_path, number, setting
from host_sim.cli.run_options import WatchOptions
from host_sim.faults.rule import FAULT_NAMES
from host_sim.protocol.words import NODE_MAX, PROFILES
from host_sim.sim.run_config import ROBOTS, RunConfig
from host_sim.world.physics_names import PHYSICS
from host_sim.world.world_names import WORLD_NAMES

_BUS_HELP = (
    "where the robot is: none (in this process), fd (socket pair), python-can's INTERFACE:CHANNEL, or "
    "auto (virtual CAN if available, else fd)" + DEFAULT
)
_ROBOT_HELP = (
    "spawn: start the firmware here; external: wait for a robot on the bus; "
    "qemu, emulated: run the flash image in QEMU or on an emulated board" + DEFAULT
)


def add_run_options(parser: argparse.ArgumentParser, robots_max: int = NODE_MAX) -> None:
    """Adds the options that `run` and `watch` share.

    Args:
        parser: Parser of the command.
        robots_max: Maximum number of robots.
    """
    _add_world_options(parser)
    _add_robot_options(parser, robots_max)
    _add_bus_options(parser)
    _add_session_options(parser)
    _add_output_options(parser)


def _add_world_options(parser: argparse.ArgumentParser) -> None:
    """Adds what the environments are, and what changes in them."""
    add, default = parser.add_argument, RunConfig()
    add(
        "--seed",
        type=number(0, 2**32 - 1),
        default=default.seed,
        metavar="SEED",
        help="seed for environments and random turns, 0..4294967295" + DEFAULT,
    )
    add(
        "--environments",
        type=number(1, 1000),
        default=default.environments,
        metavar="N",
        help="number of environments, one after the other" + DEFAULT,
    )
    add(
        "--world",
        default=default.world,
        metavar="WORLD",
        help=f"what they are drawn from: {', '.join(WORLD_NAMES)}, or a file of your own, such as my.toml" + DEFAULT,
    )
    add(
        "--physics",
        choices=PHYSICS,
        help="physics engine: pymunk, the reference, or fast, which gives the same bytes and takes a fraction of the "
        "time (default: pymunk on a CAN bus, else fast)",
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


def _add_robot_options(parser: argparse.ArgumentParser, robots_max: int) -> None:
    """Adds how many robots there are, and how they behave."""
    add, default = parser.add_argument, RunConfig()
    add(
        "--robots",
        type=number(1, robots_max),
        default=default.robots,
        metavar="N",
        help=f"number of robots, up to {robots_max}" + DEFAULT,
    )
    add("--profile", choices=PROFILES, default=default.profile, help="the robot's behaviour" + DEFAULT)
    add(
        "--set",
        type=setting,
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="change a parameter; may be repeated (default: the values below)",
    )


def _add_bus_options(parser: argparse.ArgumentParser) -> None:
    """Adds where the robots are."""
    add, default = parser.add_argument, RunConfig()
    add("--bus", default="auto", help=_BUS_HELP)
    add_bitrate(parser)
    add("--robot", choices=ROBOTS, default=default.robot, help=_ROBOT_HELP)
    add("--board", choices=BOARDS, help=f"the board for --robot emulated (default: {BOARDS[0]})")
    add(
        "--node",
        type=number(1, NODE_MAX),
        default=default.node,
        metavar="NODE",
        help=f"the robot's number on the bus, 1..{NODE_MAX}; further robots get the next ones" + DEFAULT,
    )


def _add_session_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options for a bus that others use too, or that fails."""
    add, default = parser.add_argument, RunConfig()
    add(
        "--owner",
        type=number(1, 255),
        default=default.owner,
        metavar="N",
        help="owner ID of this simulator, 1..255; a robot on a shared bus obeys only its owner (default: 1 for "
        "robots started here, drawn from the seed for external ones)",
    )
    add(
        "--reconnect-s",
        type=number(0, 3600, float),
        default=default.reconnect_s,
        metavar="S",
        help="time to wait for a bus or an adapter that is gone, s (default: %(default)g)",
    )
    for option, most, unit, what in (
        ("--unanswered-max", 100, "PERCENT", "share of ticks without an answer, %%"),
        ("--gap-max-s", 3600, "S", "longest time without an answer, s"),
        ("--late-max", 100, "PERCENT", "share of ticks that this host begins late, %%"),
    ):
        value = getattr(default, option[2:].replace("-", "_"))
        text = f"real time: {what}; beyond it, the result is doubtful (default: %(default)g)"
        add(option, type=number(0, most, float), default=value, metavar=unit, help=text)
    add(
        "--fault",
        action="append",
        default=[],
        metavar="RULE",
        help="make a fault on the way to the robot and back: NAME[:CHANCE%%][:SIZE][@FIRST[-LAST]][/to|/from], where "
        f"NAME is {', '.join(FAULT_NAMES)} and frames are counted from 1; @FILE: rules from a file; may be repeated",
    )
    add(
        "--fault-seed",
        type=number(0, 2**32 - 1),
        default=default.fault_seed,
        metavar="SEED",
        help="seed for the faults" + DEFAULT,
    )


def _add_output_options(parser: argparse.ArgumentParser) -> None:
    """Adds how long an environment may take, and what a run leaves behind."""
    add, default = parser.add_argument, RunConfig()
    add(
        "--limit-s",
        type=number(1, 36000, float),
        default=default.limit_s,
        metavar="S",
        help="time limit for each environment, s of robot time (default: %(default)g)",
    )
    add(
        "--memory",
        type=file_path,
        metavar="FILE",
        help="load the eight bytes from FILE before the run, if it exists; save them afterwards (default: no file)",
    )
    add(
        "--out",
        type=file_path,
        default=Path("out"),
        metavar="DIR",
        help="folder for page, picture, summary and log" + DEFAULT,
    )
    add("--compress-log", action="store_true", help="write the log compressed, as run.log.gz")
    add("--json", action="store_true", help="print only the summary, as JSON")
    add("--quiet", action="store_true", help="print nothing")


def add_watch_options(parser: argparse.ArgumentParser) -> None:
    """Adds the options for serving a page."""
    add = parser.add_argument
    add(
        "--port",
        type=number(0, 65535),
        metavar="PORT",
        help=f"port that the page is served on; 0 for any free port (default: {WatchOptions().port})",
    )
    add(
        "--listen",
        nargs="?",
        const="0.0.0.0",
        metavar="ADDRESS",
        help="serve the page to other machines, with a token: in all networks, or at one address of this machine; "
        "with several robots, each page gets one of its own (default: this machine only)",
    )
