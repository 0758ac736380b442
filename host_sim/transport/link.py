"""Links, which carry frames to a robot and back, and the clocks to wait by: the wall clock, or a virtual one."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol, runtime_checkable


class Frame(NamedTuple):
    """One CAN frame with an 11-bit identifier, or with 29 bits and the flag `EXTENDED`, and 0..8 bytes of data."""

    id: int
    data: bytes


BIT_RATES = (125_000, 250_000, 500_000, 1_000_000)
"""The usual bus bit rates, bit/s."""

BIT_RATE = 500_000
"""The default bus bit rate, bit/s."""


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
        heard: Number of bytes of text that came; None for a line that does not carry text.
        frames: Number of frames in that text.
        errors: Number of BELLs in it, by which an slcan adapter refuses a command or a frame.
        strange: The last line of text that was no frame.
    """

    outages: int = 0
    unsent: int = 0
    garbled: int = 0
    copies: int = 1
    _garbled_before: int = 0
    reason: str = ""
    heard: int | None = None
    frames: int = 0
    errors: int = 0
    strange: str = ""

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
        if self.heard is not None and not self.frames:
            parts.append(
                "only acknowledgements came from the adapter" if self.heard else "nothing came over the line"
            )
        if self.errors:
            parts.append(f"the adapter refused a command or a frame {self.errors} times (BELL)")
        if self.garbled and self.strange:
            parts.append(f"{self.garbled} lines were no frames, the last one {self.strange}")
        return "".join(f"; {part}" for part in parts)


OWN_MAX = 32
"""Number of sent frames that are remembered, to recognize them if an adapter returns them."""


class Link(Protocol):
    """Carries single frames to one robot and back."""

    def send(self, frame: Frame) -> None:
        """Sends one frame, or counts it as unsent where there is no room for it.

        Raises:
            LinkDownError: The line is gone.
        """

    def receive(self, timeout_s: float) -> Frame | None:
        """The next frame, or None after `timeout_s`; 0 polls. Anything received that is not a frame has the id -1.

        Raises:
            LinkDownError: The line is gone.
        """

    def close(self) -> None:
        """Closes the link."""


class FrameSocket(Protocol):
    """A socket that carries one frame per datagram, as SocketCAN does, so that C code can use it as well.

    Attributes:
        garbled: Number of datagrams that were not frames.
        closing: Called before it closes.
    """

    garbled: int
    closing: Callable[[], object]

    def fileno(self) -> int:
        """The socket."""

    def put_back(self, frame: Frame) -> None:
        """Has the next `receive` return a frame that was received from the socket already."""


@runtime_checkable
class SocketLink(Link, Protocol):
    """A link that may have such a socket."""

    def frame_socket(self) -> FrameSocket | None:
        """Its socket, when all that is to be sent before the next frame has been sent; None if there is none now."""


class Clock(Protocol):
    """Tells the time, and lets it pass."""

    def now(self) -> float:
        """The time, s, from an arbitrary start."""

    def receive(self, link: Link, timeout_s: float) -> Frame | None:
        """As `link.receive`, with the timeout in this clock's seconds."""


class WallClock:
    """The machine's monotonic clock."""

    def now(self) -> float:
        """As in `Clock`."""
        return time.monotonic()

    def receive(self, link: Link, timeout_s: float) -> Frame | None:
        """As in `Clock`."""
        return link.receive(timeout_s)


class VirtualClock:
    """A clock for a robot that answers at once, in this process: waiting takes no time, and every run is the same.

    Each frame takes as long as on a bus, so that the robot's ticks pass no faster than they could there.
    """

    FRAME_S = 0.00025
    """The time of a full frame at 500 kbit/s, s."""

    def __init__(self) -> None:
        """Starts at 0."""
        self._now_s = 0.0

    def now(self) -> float:
        """As in `Clock`."""
        return self._now_s

    def wait(self, seconds: float) -> None:
        """Lets time pass."""
        self._now_s += seconds

    def receive(self, link: Link, timeout_s: float) -> Frame | None:
        """As in `Clock`: what is not there yet will not come, so the timeout passes at once."""
        frame = link.receive(0.0)
        self.wait(timeout_s if frame is None else self.FRAME_S)
        return frame
