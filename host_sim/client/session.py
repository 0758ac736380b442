"""What a robot was told at its start, and the session's counters."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass
class Session:
    """How a robot was started, so that it can be started again.

    Attributes:
        seed: Seed for its random turns, 0..2**32 - 1.
        profile: Number of its profile.
        settings: Parameters to set, by name.
        frozen: Whether it was told not to learn.
        halted: Whether it has stopped because its wheels did not do what they were told.
        missing: Number of frames that were missing before it was started.
    """

    seed: int
    profile: int = 0
    settings: Mapping[str, int] = field(default_factory=dict)
    frozen: bool = False
    halted: bool = False
    missing: int = 0


@dataclass
class FrameCounts:
    """Frame counters of a client; `summary.frame_counts` adds those that the robot reports.

    Attributes:
        sent: Number of frames sent to the robot, each counted once.
        received: Number of valid frames received from it, each counted once.
        repeated: Number of frames sent again because no answer came in time.
        duplicate: Number of valid frames received that were old news: answers to repeated frames, late or doubled
            ones, and a waiting robot's signs of life.
        lost: Number of senses that were not answered in time.
        refused: Number of frames that were damaged or foreign.
    """

    sent: int = 0
    received: int = 0
    repeated: int = 0
    duplicate: int = 0
    lost: int = 0
    refused: int = 0

    @property
    def missing(self) -> int:
        """Number of frames that are known not to have come, or not whole."""
        return self.lost + self.repeated + self.refused
