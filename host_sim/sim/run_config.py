"""What a run is made of, as data: seeds, robots, and where they come from."""

from dataclasses import dataclass, field

ROBOTS = ("spawn", "external", "qemu", "emulated")
"""How a robot gets there."""


@dataclass(frozen=True)
class RunConfig:
    """A run; the ranges are checked where a person's words are read.

    Attributes:
        seed: Of environments and random turns, 0..2**32 - 1.
        environments: How many, one after the other.
        limit_s: Robot time for each environment, s.
        robots: How many are in each environment, at least 1.
        node: The first robot's number on the bus, 1..63; the others follow.
        profile: What the robots behave like, by name.
        settings: Parameters that differ from the profile's, by name.
        bus: Where the robots are: none (in this process), fd (socket pairs), or python-can's INTERFACE:CHANNEL.
        robot: How they get there, one of `ROBOTS`: spawn them, wait for external ones, or run the flash image in qemu
            or emulated.
        board: Which board is emulated.
        real_time: Whether to keep pace with the wall clock rather than run in lockstep, as fast as it goes.
    """

    seed: int = 1
    environments: int = 5
    limit_s: float = 600.0
    robots: int = 1
    node: int = 1
    profile: str = "article"
    settings: dict[str, int] = field(default_factory=dict)
    bus: str = "none"
    robot: str = ROBOTS[0]
    board: str = ""
    real_time: bool = False

    @property
    def nodes(self) -> range:
        """The robots' numbers on the bus."""
        return range(self.node, self.node + self.robots)
