"""Faults of a run: incidents that may affect its result, and refused frames."""

from typing import NamedTuple

from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import Frame

REFUSED_MAX = 10_000
"""Maximum number of frames kept; later ones are only counted."""


class Incident(NamedTuple):
    """An event that should not happen in a run.

    Attributes:
        tick: Number of the tick, from the first of the run.
        node: Node number of the robot.
        text: What happened, as a sentence without a full stop.
    """

    tick: int
    node: int
    text: str

    def __str__(self) -> str:
        return f"at tick {self.tick} (node {self.node}) {self.text}"


class RefusedFrames:
    """The refused frames of one robot, as lines of a log, each followed by the reason.

    Attributes:
        unlisted: Number of frames after the first `REFUSED_MAX`.
    """

    def __init__(self, log: FrameLog) -> None:
        """Starts without frames.

        Args:
            log: The run's log, which provides the time.
        """
        self.unlisted = 0
        self._log, self._text, self._count = log, bytearray(), 0

    @property
    def lines(self) -> list[str]:
        """Lines of the first `REFUSED_MAX` frames."""
        return self._text.decode("ascii").splitlines()

    def add(self, frame: Frame, why: str) -> None:
        """Adds a refused frame."""
        if self._count == REFUSED_MAX:
            self.unlisted += 1
            return
        self._count += 1
        self._text += f"{self._log.line(frame)}  ; {why}\n".encode("ascii")
