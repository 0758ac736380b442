"""A link that injects a schedule's faults into any other link."""

import math
from collections import deque
from dataclasses import dataclass, field

from host_sim.base.frame import Frame
from host_sim.faults.bus_faults import Passing
from host_sim.faults.rule import DIRECTIONS, Direction
from host_sim.faults.schedule import Schedule
from host_sim.transport.clock import Clock, WallClock
from host_sim.transport.link import Link

_BEHIND_S = 0.3
"""Time after which a frame waiting to be overtaken arrives, even without other frames, s."""

_LATE_MAX = 1000
"""Maximum number of frames processed after a timeout: they may keep coming, and a fault may drop them all."""


@dataclass
class _Held:
    """A delayed frame, due at a time or when enough frames have overtaken it."""

    frame: Frame
    due_s: float
    behind: int


@dataclass
class _Way:
    """One direction of a link: the delayed frames, and those that have arrived."""

    held: list[_Held] = field(default_factory=list)
    arrived: deque[Frame] = field(default_factory=deque)

    def put(self, passing: Passing, now_s: float) -> None:
        """Takes a frame, which arrives at once or later."""
        if not passing.delay_s and not passing.behind:
            self._arrive(passing.frame)
            return
        due_s = now_s + passing.delay_s + (_BEHIND_S if passing.behind else 0.0)
        self.held.append(_Held(passing.frame, due_s, passing.behind))

    def deliver(self, now_s: float) -> None:
        """Lets every frame arrive that is due."""
        while self.held and self.next_s() <= now_s:
            due = min(self.held, key=lambda held: held.due_s)
            self.held.remove(due)
            self._arrive(due.frame)

    def next_s(self) -> float:
        """The time at which the next frame is due."""
        return min((held.due_s for held in self.held), default=math.inf)

    def _arrive(self, frame: Frame) -> None:
        self.arrived.append(frame)
        for held in self.held:
            held.behind -= 1
            if held.behind == 0:
                held.due_s = -math.inf


class FaultyLink:
    """A link that wraps another one and injects faults into its frames in both directions.

    Attributes:
        schedule: The faults, and a record of them.
        link: The link to the robot.
    """

    def __init__(self, link: Link, schedule: Schedule, clock: Clock | None = None) -> None:
        """Takes over a link, which `close` closes; delays are by the wall clock unless another one is given."""
        self.schedule = schedule
        self.link, self._clock = link, clock or WallClock()
        self._ways: dict[Direction, _Way] = {direction: _Way() for direction in DIRECTIONS}

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self._let_pass(frame, "to")
        self._deliver()

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        way = self._ways["from"]
        give_up, late = self._clock.now() + timeout_s, 0
        while True:
            self._deliver()
            if way.arrived:
                return way.arrived.popleft()
            now = self._clock.now()
            wait_s = min(give_up, *(each.next_s() for each in self._ways.values())) - now
            frame = self._clock.receive(self.link, max(wait_s, 0.0))
            is_late = self._clock.now() >= give_up
            if frame is not None:
                self._let_pass(frame, "from")
                late += is_late
            if is_late and (frame is None or late == _LATE_MAX):
                self._deliver()
                return way.arrived.popleft() if way.arrived else None

    def close(self) -> None:
        """As in `Link`. Frames that are still on their way are lost."""
        self.link.close()

    def _let_pass(self, frame: Frame, direction: Direction) -> None:
        now = self._clock.now()
        for passing in self.schedule.passing(frame, direction):
            self._ways[direction].put(passing, now)

    def _deliver(self) -> None:
        """Delivers all due frames: those to the robot are sent at once, those from it wait for `receive`."""
        now = self._clock.now()
        for way in self._ways.values():
            way.deliver(now)
        arrived = self._ways["to"].arrived
        while arrived:
            self.link.send(arrived.popleft())
