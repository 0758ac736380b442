"""What goes wrong in a run: incidents that its result depends on, and frames that were refused."""

from typing import NamedTuple

from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import Frame

REFUSED_MAX = 10_000
"""Number of frames that are kept; later ones are only counted."""


class Incident(NamedTuple):
    """Something that should not happen in a run.

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
    """The refused frames of one robot, as the lines of a log with a reason behind each.

    Attributes:
        unlisted: Number of those after the first `REFUSED_MAX`.
    """

    def __init__(self, log: FrameLog) -> None:
        """Keeps nothing yet.

        Args:
            log: The run's log, which knows the time.
        """
        self.unlisted = 0
        self._log, self._text, self._count = log, bytearray(), 0

    @property
    def lines(self) -> list[str]:
        """The first `REFUSED_MAX` of them."""
        return self._text.decode("ascii").splitlines()

    def add(self, frame: Frame, why: str) -> None:
        """A frame was refused."""
        if self._count == REFUSED_MAX:
            self.unlisted += 1
            return
        self._count += 1
        self._text += f"{self._log.line(frame)}  ; {why}\n".encode("ascii")
