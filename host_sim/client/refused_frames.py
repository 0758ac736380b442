"""What came to the simulator and was refused: damaged, foreign, not asked for. It explains a doubtful run."""

from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import Frame

REFUSED_MAX = 10_000
"""Number of frames that are kept; later ones are only counted."""


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
