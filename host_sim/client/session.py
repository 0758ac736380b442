"""The settings of a robot at its start, and the session's counters."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass
class Session:
    """The settings with which a robot was started, so that it can be restarted.

    Attributes:
        seed: Seed for its random turns, 0..2**32 - 1.
        profile: Number of its profile.
        settings: Parameters to set, by name.
        frozen: Whether its learning is frozen.
        halted: Whether it has stopped because its wheels did not follow the command.
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
        duplicate: Number of valid frames received with nothing new: answers to repeated frames, late or doubled
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
        """Number of frames known to be lost or damaged."""
        return self.lost + self.repeated + self.refused
