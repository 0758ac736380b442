"""A connection to a robot: the link, and information about the robot behind it."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from host_sim.protocol.generated import Senses
from host_sim.transport.line_stats import LineStats
from host_sim.transport.link import Link
from host_sim.world.body import Body

DEADLINE_S = 5.0
"""Time after which the client gives up on a robot that does not answer, s of wall-clock time."""


@dataclass(frozen=True)
class Connection:
    """A connection to a robot.

    Attributes:
        link: Carries frames to the robot and back.
        bus: Name of the bus, as in the summary.
        status: Describes the state of the robot's process, and raises RobotError if it has ended.
        pid: Process id of the robot; None if it was not started as a process.
        line: Statistics of the line below the frames.
        deadline_s: Time after which the client gives up on a silent robot, s of wall-clock time.
        answers_at_once: Whether the robot answers within `send`, or not at all.
        now: Returns the time by which the link's timeouts are measured, s.
        sense: For a robot with sensors of its own: computes its senses from its body, the world's senses and
            the number of the tick; None for all others.
        pins: Reads such a robot's pins, as `RobotOnPins.figures`.
    """

    link: Link
    bus: str = ""
    status: Callable[[], str] = lambda: "was not started here"
    pid: int | None = None
    line: LineStats = field(default_factory=LineStats)
    deadline_s: float = DEADLINE_S
    answers_at_once: bool = False
    now: Callable[[], float] = time.monotonic
    sense: Callable[[Body, Senses, int], Senses] | None = None
    pins: Callable[[], dict[str, Any]] | None = None
