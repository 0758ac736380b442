"""The CAN bus that the board hangs on: one frame at a time, at the bus's speed."""

from collections import deque
from collections.abc import Callable
from typing import Protocol

from host_sim.emulator.can_frame import CanFrame
from host_sim.emulator.clock import NEVER, SECOND, Clock

BITRATE = 500_000
_ERROR_BITS = 40
"""A frame that fails early, with error flags and the pause after them."""


class Controller(Protocol):
    """What the wire asks of the board's CAN controller."""

    def listens(self) -> bool:
        """Whether it takes part in the bus's traffic."""

    def offer(self) -> CanFrame | None:
        """The frame that it wants to send next."""

    def lost_arbitration(self) -> None:
        """The frame offered last did not win the bus."""

    def sent(self) -> None:
        """The frame offered last is through."""

    def failed(self, *, acknowledged: bool) -> None:
        """The frame offered last was destroyed, or nobody acknowledged it."""

    def arrived(self, frame: CanFrame) -> None:
        """A frame of another node has passed."""


class CanWire:
    """The bus, with one other node on it that stands for the rest of the world.

    Attributes:
        controller: The board's.
        alone: Nobody acknowledges: what is sent goes on and on.
        shorted: Whatever the board sends is destroyed, and the other node has given up what it wanted to send.
    """

    def __init__(self, clock: Clock, heard: Callable[[CanFrame], None]) -> None:
        """A quiet bus.

        Args:
            clock: The board's.
            heard: Takes what the board has sent.
        """
        self._clock, self._heard = clock, heard
        self.controller: Controller | None = None
        self.alone = False
        self.shorted = False
        self._to_come: deque[CanFrame] = deque()
        self._passing: CanFrame | None = None
        self._ours = False
        self._ends = 0
        clock.add(self._due)

    def put(self, frame: CanFrame) -> None:
        """The other node wants to send a frame. It keeps trying until somebody listens."""
        self._to_come.append(frame)
        self.wake()

    def wake(self) -> None:
        """Someone has something to send, or listens again."""
        self._clock.expect(max(self._ends, self._clock.now))

    def _due(self) -> int:
        while self._ends <= self._clock.now:
            self._finish()
            if not self._begin():
                return NEVER
        return self._ends

    def _finish(self) -> None:
        frame, self._passing = self._passing, None
        controller = self.controller
        if frame is None or controller is None:
            return
        if not self._ours:
            controller.arrived(frame)
        elif self.shorted or self.alone:
            controller.failed(acknowledged=not self.alone)
        else:
            controller.sent()
            self._heard(frame)

    def _begin(self) -> bool:
        """Lets the next frame onto the wire; False if there is none."""
        controller = self.controller
        if controller is None or not controller.listens():
            return False
        if self.shorted:
            self._to_come.clear()
        ours = controller.offer()
        theirs = self._to_come[0] if self._to_come else None
        self._ours = ours is not None and (theirs is None or ours.rank < theirs.rank)
        self._passing = ours if self._ours else theirs
        if self._passing is None:
            return False
        if not self._ours:
            self._to_come.popleft()
            controller.lost_arbitration()
        bits = _ERROR_BITS if self._ours and self.shorted else self._passing.bits
        self._ends = max(self._ends, self._clock.now) + bits * (SECOND // BITRATE)
        return True
