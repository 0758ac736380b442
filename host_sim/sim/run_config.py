"""The options of a run as a table: the source of command line, help text, checks and `RunConfig`."""

import shlex
from dataclasses import dataclass, field, fields
from functools import cache
from typing import Any

from host_sim.backends.images import BOARDS
from host_sim.base.errors import UsageError
from host_sim.faults.rule import FAULT_NAMES
from host_sim.protocol.words import NODE_MAX, PARAMETERS, PROFILES
from host_sim.transport.bit_rates import BIT_RATE, BIT_RATES
from host_sim.world.body_kinds import PINS, body_kind
from host_sim.world.physics_names import FAST, PHYSICS, PYMUNK
from host_sim.world.world_names import CRATES, RANDOM, WORLD_NAMES

ROBOTS = ("spawn", "external", "qemu", "emulated", "observe")
"""The ways to get a robot."""

FLEET_MAX = 100_000
"""Maximum number of robots of a fleet."""

WORLDS = ("one", "own", "hall")
"""Whether the robots of a run share one world, each has its own, or all share a hall of as many as they need."""

_SEEDS = (0, 2**32 - 1)


@dataclass(frozen=True)
class Option:
    """A row of the table: the properties of an option besides its name, type and default.

    Attributes:
        text: Description for people.
        limits: Its minimum and maximum; None if it is not a number, or has choices.
        choices: The permitted values; empty if any.
        metavar: The placeholder of its value in the help text.
        unset: Description of the default, if its value does not say enough.
        flag: Its name on the command line, if it differs from the field's.
        const: The value if the flag is given without one; None if a value is required.
        commands: The commands that have it.
        fleet: Whether a fleet has it.
    """

    text: str
    limits: tuple[float, float] | None = None
    choices: tuple[Any, ...] = ()
    metavar: str | None = None
    unset: str = ""
    flag: str = ""
    const: str | None = None
    commands: tuple[str, ...] = ("run", "watch")
    fleet: bool = True

    def allows(self, value: Any) -> bool:
        """Whether a value is one of the choices and within the limits."""
        if self.limits is not None:
            return bool(self.limits[0] <= value <= self.limits[1])
        return not self.choices or value in self.choices

    @property
    def range(self) -> str:
        """The permitted values, for people; empty if any."""
        return "{:.10g}..{:.10g}".format(*self.limits) if self.limits else ", ".join(map(str, self.choices))


def option(default: Any, text: str, **row: Any) -> Any:
    """A field of a dataclass that is an option; the further arguments are those of `Option`."""
    given: dict[str, Any] = {"default_factory": dict} if default == {} else {"default": default}
    return field(metadata={"option": Option(text, **row)}, **given)


@cache
def options_of(config: Any) -> dict[str, tuple[Any, Option]]:
    """The options of a configuration: for each name, its field and its row."""
    return {it.name: (it, it.metadata["option"]) for it in fields(config) if "option" in it.metadata}


def flag_of(name: str, row: Option) -> str:
    """The name of an option on the command line."""
    return row.flag or f"--{name.replace('_', '-')}"


@dataclass(frozen=True)
class RunConfig:
    """The configuration of a run: its robots, their world, and how they are reached.

    Raises:
        UsageError: A value is out of range, or not one of the choices.
    """

    seed: int = option(1, "seed for environments and random turns", limits=_SEEDS, metavar="SEED")
    environments: int = option(5, "number of environments, one after the other", limits=(1, 1000), metavar="N")
    world: str = option(
        RANDOM,
        f"world to draw environments from: {', '.join(WORLD_NAMES)}, or your own file, such as my.toml",
        metavar="WORLD",
    )
    body: str = option(
        "ideal",
        "the robots' bodies: ideal; kit, with motors and sensors as they come off the bench and settings that suit "
        "them; pins, a kit that an emulated board drives by itself through its pins; or your own file, such as "
        "my_body.toml",
        metavar="BODY",
    )
    limit_s: float = option(
        600.0, "time limit for each environment, s of robot time", limits=(0.02, 86_400), metavar="S"
    )
    robots: int = option(
        1, f"number of robots; more than {NODE_MAX} are a fleet and need no bus", limits=(1, FLEET_MAX), metavar="N"
    )
    worlds: str = option(
        WORLDS[0],
        "one: the robots share a world; own: each has its own; hall: they share a hall as large as they need",
        choices=WORLDS,
        unset=f"one for up to {NODE_MAX} robots, else own",
        commands=("run",),
    )
    profile: str = option("article", "the robot's behaviour", choices=PROFILES)
    program: str = option(
        "",
        "the robot's brain is this program, in the language of the article's listing, such as "
        "host_sim/program/examples/article.bas",
        metavar="FILE",
        unset="the firmware's own",
        fleet=False,
    )
    settings: dict[str, int] = option(
        {}, "set a parameter; may be repeated", flag="--set", metavar="NAME=VALUE", unset="the values below"
    )
    bus: str = option(
        "none",
        "how to reach the robot: none (in this process), fd (socket pair), python-can's INTERFACE:CHANNEL, or auto "
        "(virtual CAN if available, else fd)",
    )
    bitrate: int = option(
        BIT_RATE,
        "bus bit rate, bit/s; only for adapters that python-can configures itself",
        choices=BIT_RATES,
        metavar="BITS",
    )
    robot: str = option(
        ROBOTS[0],
        "spawn: start the firmware here; external: wait for a robot on the bus; qemu, emulated: run the flash image "
        "in QEMU or on an emulated board; observe (watch only): look on while a robot on the bus runs by itself",
        choices=ROBOTS,
        fleet=False,
    )
    robot_command: str = option(
        "",
        "start this program as the robot, for each node, and again when it ends; it finds its bus in CAN_INTERFACE "
        "and CAN_CHANNEL, its number in OCTET_NODE",
        metavar="CMD",
        unset="the firmware",
        fleet=False,
    )
    board: str = option("", "board for --robot emulated", choices=BOARDS, unset=BOARDS[0])
    node: int = option(
        1,
        "the robot's node number on the bus; further robots get the next ones",
        limits=(1, NODE_MAX),
        metavar="NODE",
        fleet=False,
    )
    owner: int = option(
        0,
        "owner ID of this simulator; a robot on a shared bus obeys only its owner",
        limits=(1, 255),
        metavar="N",
        unset="1 for robots started here, drawn from the seed for external ones",
    )
    reconnect_s: float = option(
        10.0, "how long to wait for a lost bus or adapter to come back, s", limits=(0, 3600), metavar="S"
    )
    unanswered_max: float = option(
        10.0,
        "real time: largest share of unanswered ticks, %; above it, the result is doubtful",
        limits=(0, 100),
        metavar="PERCENT",
    )
    gap_max_s: float = option(
        1.0,
        "real time: time without an answer from which on the result is doubtful, s",
        limits=(0, 3600),
        metavar="S",
    )
    late_max: float = option(
        5.0,
        "real time: by how much the clock may fall behind on this host, %; above it, the result is doubtful",
        limits=(0, 100),
        metavar="PERCENT",
    )
    physics: str | None = option(
        None,
        "physics engine: pymunk, the reference, or fast, which gives the same bytes in a fraction of the time",
        choices=PHYSICS,
        unset="pymunk on a CAN bus and with crates, else fast",
    )
    changes: tuple[str, ...] = option(
        (),
        "schedule a change: NAME@120s, NAME@env6 or NAME@env6+20s of robot time, where NAME is plant, grow, "
        "swap-motors, mirror, stuck-on:SENSOR, stuck-off:SENSOR, noise:10/1000, weak-motor:left:60%, "
        "swap-odometers, odometer:left:0%, false-beacon:100, lag:60ms, slack:3deg, slip:5%, latency:1, dark-wall, "
        "weak-battery or repair, and /2 at the end means only the second robot; or a file with one change per line; "
        "may be repeated",
        flag="--change",
        metavar="CHANGE",
        fleet=False,
    )
    faults: tuple[str, ...] = option(
        (),
        "inject a fault into the frames to or from the robot: NAME[:CHANCE%][:SIZE][@FIRST[-LAST]][/to|/from], where "
        f"NAME is {', '.join(FAULT_NAMES)} and frames are counted from 1; @FILE: rules from a file; may be repeated",
        flag="--fault",
        metavar="RULE",
        fleet=False,
    )
    fault_seed: int = option(1, "seed for the faults", limits=_SEEDS, metavar="SEED")
    real_time: bool = option(
        False, "run at wall-clock speed instead of as fast as possible", commands=("run",), fleet=False
    )

    def __post_init__(self) -> None:
        table: Any = type(self)
        for name, (it, row) in options_of(table).items():
            value = getattr(self, name)
            if value != it.default and not row.allows(value):
                raise UsageError(f"{name} must be one of {row.range}, not {value!r}")
        if self.robot == "observe" and (self.robots > 1 or not getattr(self, "watch", False)):
            raise UsageError("--robot observe watches one robot: use tools/octet watch --bus BUS --robot observe")
        if self.world == CRATES and (self.is_fleet or self.physics == FAST):
            raise UsageError(f"only pymunk can push what --world {CRATES} has: no --physics {FAST}, and no fleet")
        if self.body == PINS and self.robot != "emulated":
            raise UsageError(
                "--body pins is a robot on the pins of an emulated board: use --robot emulated --board blue_pill or "
                "nucleo_g431rb"
            )

    def command(self) -> str:
        """The command line of this run."""
        words = ["tools/run", "--bus", self.bus]
        for name, (it, row) in options_of(RunConfig).items():
            value, flag = getattr(self, name), flag_of(name, row)
            if isinstance(value, bool):
                words += [flag] * value
            elif name == "settings":
                words += [word for key in sorted(value) for word in (flag, f"{key}={value[key]}")]
            elif isinstance(value, tuple):
                words += [word for each in value for word in (flag, each)]
            elif name != "bus" and value != it.default:
                words += [flag, f"{value:.10g}" if isinstance(value, float) else str(value)]
        return shlex.join(words)

    @property
    def is_fleet(self) -> bool:
        """Whether the robots have no bus: they do not share one world, or outnumber the nodes of a bus."""
        return self.worlds != "one" or self.robots > NODE_MAX

    @property
    def chosen_physics(self) -> str:
        """The physics to use, one of `PHYSICS`."""
        return self.physics or (PYMUNK if ":" in self.bus or self.world == CRATES else FAST)

    @property
    def told(self) -> dict[str, int]:
        """The parameters to set: those that suit the bodies, overridden by `settings`."""
        kind = body_kind(self.body)
        return {**(kind.settings if kind else {}), **self.settings}

    @property
    def boredom_limit(self) -> int:
        """Number of remembered turns in a row at which a robot is bored."""
        return self.settings.get("boredom_limit", PARAMETERS["boredom_limit"].default)

    @property
    def nodes(self) -> range:
        """The robots' node numbers on the bus."""
        return range(self.node, self.node + self.robots)


_ROWS = [(name, row.text, f" ({row.range})" if row.range else "") for name, (_, row) in options_of(RunConfig).items()]
_ATTRIBUTES = "".join(f"        {name}: {text}{values}.\n" for name, text, values in _ROWS)
RunConfig.__doc__ = f"{RunConfig.__doc__}\n    Attributes:\n{_ATTRIBUTES}"
