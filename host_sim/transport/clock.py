"""Clocks to wait by: the wall clock, or a virtual clock that advances only during a wait."""

import time
from typing import Protocol

from host_sim.transport.link import Frame, Link


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
