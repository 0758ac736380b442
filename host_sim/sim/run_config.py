"""The options of a run as a table: the source of command line, help text, checks and `RunConfig`."""

import shlex
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

from host_sim.base.errors import UsageError, meant
from host_sim.client.deadlines import Limits
from host_sim.protocol.words import NODE_MAX, OWN, PARAMETERS, PROFILES
from host_sim.sim.access import BOARDS, PICO, ROBOTS, Access
from host_sim.sim.option import flag_of, option, options_of
from host_sim.transport.link import BIT_RATE, BIT_RATES
from host_sim.transport.rule import FAULT_NAMES, Rule
from host_sim.world.body_kinds import PINS, BodyKind, body_kind
from host_sim.world.changes import Change
from host_sim.world.layouts import World
from host_sim.world.names import CRATES, FAST, PHYSICS, PYMUNK, RANDOM, WORLD_NAMES
from host_sim.world.worlds import world_of

if TYPE_CHECKING:
    from host_sim.sim.in_process_link import Program
    from host_sim.sim.own_brain import OwnBrain
    from host_sim.sim.world_record import Source

FLEET_MAX = 100_000
"""Maximum number of robots of a fleet."""

WORLDS = ("one", "own", "hall")
"""Whether the robots of a run share one world, each has its own, or all share a hall of as many as they need."""

C_FILE, PROGRAM_FILE = ".c", ".bas"
"""The endings of files with a user's behaviour, and with a program in the language of the article's listing."""

_SEEDS = (0, 2**32 - 1)
_OWNER_MAX = 255


def profile_error(word: str) -> str:
    """What is wrong with the name of a behaviour, built in or in a C file; empty if nothing is."""
    allowed = word in PROFILES or word.endswith(C_FILE)
    return "" if allowed else f"there is no {word!r}; {meant(word, PROFILES)}, or name a {C_FILE} file"


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
        "the robots' bodies: ideal; kit, with motors and sensors of normal tolerances and settings that suit "
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
    profile: str = option(
        "article",
        "the robot's behaviour; a C file of your own, which tools/octet new begins; or a program in the article's "
        "language (.bas)",
        choices=PROFILES,
        endings=(C_FILE, PROGRAM_FILE),
        metavar="PROFILE",
    )
    fast: bool = option(
        False, "a behaviour of your own runs in this process, without the checks of its memory", fleet=False
    )
    settings: dict[str, int] = option(
        {}, "set a parameter; may be repeated", flag="--set", metavar="NAME=VALUE", unset="what --help-all lists"
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
        "in QEMU or on an emulated board; observe (watch only): watch a robot on the bus that runs by itself",
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
    board: str = option("", "board for --robot emulated", choices=(*BOARDS, PICO), unset=BOARDS[0])
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
        limits=(1, _OWNER_MAX),
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

    gdb: bool = option(
        False,
        "start the robot in gdb; the world waits as long as it stands at a breakpoint. With --robot qemu or "
        "emulated, attach gdb-multiarch to the image",
        commands=("run",),
        fleet=False,
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
        if self.profile.endswith((C_FILE, PROGRAM_FILE)):
            self._check_own()
        if self.fast and not self.profile.endswith(C_FILE):
            raise UsageError(
                "--fast is for a behaviour of your own: name it with --profile mine.c, or leave --fast out"
            )
        if self.body == PINS and self.robot != "emulated":
            raise UsageError(
                "--body pins is a robot on the pins of an emulated board: use --robot emulated --board blue_pill, "
                "nucleo_g431rb or pico"
            )

    def _check_own(self) -> None:
        """Refuses what a behaviour in a file cannot be combined with."""
        if self.robot_command:
            raise UsageError(f"--profile {self.profile} is built into the firmware: leave --robot-command out")
        if self.profile.endswith(PROGRAM_FILE) and (self.robot != "spawn" or self.is_fleet):
            raise UsageError(
                f"--profile {self.profile} is a program, for up to {NODE_MAX} robots that are started here, in one "
                "world: name a built-in behaviour or a C file instead"
            )
        if self.fast and self.bus not in ("auto", "none"):
            raise UsageError(f"--fast runs the robot in this process: leave --bus {self.bus} out")
        if self.fast and self.robot != "spawn":
            raise UsageError(f"--fast runs the robot in this process: leave --robot {self.robot} out")

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

    def read_files(self) -> None:
        """Reads the files that the options name, so that errors in them are found before anything is started.

        Raises:
            UsageError: There is no such world, body, program or behaviour.
        """
        for name in ("chosen_world", "chosen_body", "own", "program"):
            getattr(self, name)

    @cached_property
    def access(self) -> Access:
        """How the robots are reached; raises UsageError if such robots cannot be on that bus."""
        # Drawn from the seed: simulators on one bus rarely share an ID, and a repeated run has the same log.
        drawn = Random(self.seed).randint(1, _OWNER_MAX) if self.robot == "external" else 1
        return Access(
            *(self.bus, self.robot, self.nodes, self.board, self.body == PINS, self.robot_command),
            *(self.bitrate, self.reconnect_s, self.owner or drawn, not self.real_time),
            *(Limits(self.unanswered_max, self.gap_max_s, self.late_max), tuple(map(Rule.parse, self.faults))),
            fault_seed=self.fault_seed,
            gdb=self.gdb,
            own=self.own,
            program=self.program,
            fast=self.fast,
        )

    @cached_property
    def own(self) -> "OwnBrain | None":
        """The behaviour in a C file that `profile` names, compiled, None for a built-in one; raises UsageError."""
        if not self.profile.endswith(C_FILE):
            return None
        from host_sim.sim.own_brain import own_brain  # noqa: PLC0415 - few runs need a compiler

        return own_brain(Path(self.profile))

    @cached_property
    def program(self) -> "Program | None":
        """The program in the file that `profile` names, None for other behaviours; raises UsageError."""
        if not self.profile.endswith(PROGRAM_FILE):
            return None
        from host_sim.sim.in_process_link import read_program  # noqa: PLC0415 - help needs no generated code

        return read_program(Path(self.profile))

    @property
    def source(self) -> "Source | None":
        """The source of a behaviour in a file, as recorded in the world file; None for a built-in one."""
        brain = self.own or self.program
        return brain.source if brain else None

    def with_seed(self, seed: int) -> "RunConfig":
        """The same run with another seed, and with the same behaviour even if its file has changed since."""
        other = replace(self, seed=seed)
        vars(other)["own"] = self.own
        return other

    @property
    def profile_name(self) -> str:
        """The profile by its name on the bus; a robot with a program takes any."""
        if self.profile.endswith(PROGRAM_FILE):
            return RunConfig.profile
        return OWN if self.profile.endswith(C_FILE) else self.profile

    @cached_property
    def chosen_world(self) -> World:
        """The world that `world` names; raises UsageError if there is none."""
        return world_of(self.world)

    @cached_property
    def chosen_body(self) -> BodyKind | None:
        """Properties of the bodies that `body` names, None for ideal ones; raises UsageError if there are none."""
        return body_kind(self.body)

    @cached_property
    def scheduled(self) -> tuple[Change, ...]:
        """The scheduled changes; raises UsageError if there is no such change."""
        return tuple(map(Change.parse, self.changes))

    @property
    def chosen_physics(self) -> str:
        """The physics to use, one of `PHYSICS`."""
        return self.physics or (PYMUNK if ":" in self.bus or self.world == CRATES else FAST)

    @property
    def robot_settings(self) -> dict[str, int]:
        """The parameters that robots are started with: those of the bodies' kind, overridden by `settings`."""
        return {**(self.chosen_body.settings if self.chosen_body else {}), **self.settings}

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
