"""Counters of what happens below the frames: outages and unsent frames."""

from dataclasses import dataclass

_COPIES_MAX = 32


@dataclass
class LineStats:
    """Counters of a line: a bus, a serial line, a socket.

    Attributes:
        outages: Number of times that the line was gone.
        unsent: Number of frames that could not be sent; a frame that matters is sent again.
        garbled: Number of lines of text that were not frames: noise.
        copies: Number of copies of each frame that a serial line sends at once: more than one while it is noisy.
        reason: Reason for the last outage.
    """

    outages: int = 0
    unsent: int = 0
    garbled: int = 0
    copies: int = 1
    _garbled_before: int = 0
    reason: str = ""

    @property
    def noisy(self) -> bool:
        """Whether frames get lost by noise: then each is sent several times."""
        return self.copies > 1

    def insist(self) -> None:
        """Doubles the copies: noise, unlike congestion, does not grow with what is sent."""
        self.copies = min(2 * self.copies, _COPIES_MAX)

    def ease(self) -> None:
        """Halves the copies if the line has been clean since the last call."""
        if self.garbled == self._garbled_before:
            self.copies = max(self.copies // 2, 1)
        self._garbled_before = self.garbled

    def account(self) -> str:
        """Details for an error message, as a continuation of a sentence; empty if there are none."""
        parts = []
        if self.outages:
            parts.append(f"the line was gone {self.outages} times, last: {self.reason}")
        if self.unsent:
            parts.append(f"{self.unsent} frames could not be sent")
        return "".join(f"; {part}" for part in parts)
