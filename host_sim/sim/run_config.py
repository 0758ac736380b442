"""The configuration of a run, as data: seed, robots, and where they run."""

from dataclasses import dataclass, field

from host_sim.protocol.words import NODE_MAX, PARAMETERS
from host_sim.transport.bit_rates import BIT_RATE
from host_sim.world.physics_names import FAST, PYMUNK
from host_sim.world.world_names import RANDOM

ROBOTS = ("spawn", "external", "qemu", "emulated")
"""The ways to get a robot."""

FLEET_MAX = 10_000
"""Maximum number of robots of a fleet."""

WORLDS = ("one", "own", "hall")
"""Whether the robots of a run share one world, each has its own, or all share a hall of as many as they need."""


@dataclass(frozen=True)
class RunConfig:
    """The configuration of a run. The command line checks the ranges.

    Attributes:
        seed: Seed for environments and random turns, 0..2**32 - 1.
        environments: Number of environments, one after the other.
        world: Name of the world that they are drawn from, or path of a file that describes one.
        limit_s: Time limit for each environment, s of robot time.
        robots: Number of robots in each environment, at least 1.
        worlds: One of `WORLDS`.
        node: Node number of the first robot on the bus, 1..31; the others follow.
        profile: Name of the robots' behaviour.
        settings: Parameters to change from their defaults, by name.
        bus: Where the robots are: none (in this process), fd (socket pairs), or python-can's INTERFACE:CHANNEL.
        bitrate: Bits a second of the bus, for an adapter that is set up when opened.
        robot: One of `ROBOTS`: spawn starts the firmware, external waits for a robot on the bus, qemu and emulated
            run the flash image in QEMU or on an emulated board.
        board: Name of the emulated board; empty for the first.
        owner: Number of this simulator, 1..255, by which robots on a shared bus know whom they obey; 0: 1 for a robot
            that is started here, one drawn from the seed for an external one.
        reconnect_s: Time to wait for a bus or a serial line that is gone, s of wall-clock time.
        physics: One of `PHYSICS`, which give the same bytes; None for pymunk on a CAN bus, and fast elsewhere.
        unanswered_max: Largest share of ticks without an answer, %, with which a run in real time is sound.
        gap_max_s: Likewise the longest time without an answer, s.
        late_max: Likewise the share of ticks that this host begins late, %.
        changes: What the world and the bodies are to meet with, as `host_sim.world.changes` has it.
        faults: Faults to make on the way to the robots and back, as `host_sim.faults.rule` has them.
        fault_seed: Seed for them.
        real_time: Whether to run at wall-clock speed rather than in lockstep, as fast as possible.
    """

    seed: int = 1
    environments: int = 5
    world: str = RANDOM
    limit_s: float = 600.0
    robots: int = 1
    worlds: str = WORLDS[0]
    node: int = 1
    profile: str = "article"
    settings: dict[str, int] = field(default_factory=dict)
    bus: str = "none"
    bitrate: int = BIT_RATE
    robot: str = ROBOTS[0]
    board: str = ""
    owner: int = 0
    reconnect_s: float = 10.0
    unanswered_max: float = 10.0
    gap_max_s: float = 1.0
    late_max: float = 50.0
    physics: str | None = None
    changes: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()
    fault_seed: int = 1
    real_time: bool = False

    @property
    def is_fleet(self) -> bool:
        """Whether the robots have no bus: they do not share one world, or are more than a bus has node numbers."""
        return self.worlds != "one" or self.robots > NODE_MAX

    @property
    def chosen_physics(self) -> str:
        """One of `PHYSICS`."""
        return self.physics or (PYMUNK if ":" in self.bus else FAST)

    @property
    def boredom_limit(self) -> int:
        """Number of remembered turns in a row at which a robot is bored."""
        return self.settings.get("boredom_limit", PARAMETERS["boredom_limit"].default)

    @property
    def nodes(self) -> range:
        """The robots' node numbers on the bus."""
        return range(self.node, self.node + self.robots)
