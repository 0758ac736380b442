"""Counters of what happens below the frames: outages and unsent frames."""

from dataclasses import dataclass


@dataclass
class LineStats:
    """Counters of a line: a bus, a serial line, a socket.

    Attributes:
        outages: Number of times that the line was gone.
        unsent: Number of frames that could not be sent; a frame that matters is sent again.
        reason: Why the line was gone last.
    """

    outages: int = 0
    unsent: int = 0
    reason: str = ""

    def account(self) -> str:
        """What is worth telling in an error message, as a continuation of a sentence; empty for nothing."""
        parts = []
        if self.outages:
            parts.append(f"the line was gone {self.outages} times, last: {self.reason}")
        if self.unsent:
            parts.append(f"{self.unsent} frames could not be sent")
        return "".join(f"; {part}" for part in parts)
