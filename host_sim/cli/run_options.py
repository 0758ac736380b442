"""What a person can say about a run."""

from dataclasses import dataclass, field
from pathlib import Path


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


ROBOTS = ("spawn", "external", "qemu", "emulated")
"""How a robot gets there."""

BOARDS = ("stm32f405", "stm32f103")
"""Boards that can be emulated."""


@dataclass(frozen=True)
class RunOptions:
    """What a person can say about a run; the ranges are checked where the command line is read.

    Attributes:
        seed: Of environments and random turns.
        environments: How many.
        profile: The robot's, by name.
        settings: Parameters that differ from the profile's, by name.
        bus: Where the robot is: none, fd, or INTERFACE:CHANNEL.
        robot: How it gets there, one of `ROBOTS`: spawn it, wait for an external one, or run the flash image in qemu
            or emulated.
        board: Which one is emulated, one of `BOARDS`.
        node: Its number on the bus.
        real_time: Whether to pace by the wall's clock rather than race in lockstep.
        limit_s: Robot time for each environment.
        memory: File to load the memory from before, and to save it to after.
        out: Folder for what the run leaves behind.
        quiet: Say nothing.
        json: Print the summary alone.
        watch: How to show it in a browser; None for not at all.
    """

    seed: int = 1
    environments: int = 5
    profile: str = "article"
    settings: dict[str, int] = field(default_factory=dict)
    bus: str = "fd"
    robot: str = ROBOTS[0]
    board: str = BOARDS[0]
    node: int = 1
    real_time: bool = False
    limit_s: float = 600.0
    memory: Path | None = None
    out: Path = Path("out")
    quiet: bool = False
    json: bool = False
    watch: WatchOptions | None = None

    @property
    def talks(self) -> bool:
        """Whether to tell people how it goes."""
        return not (self.quiet or self.json)
