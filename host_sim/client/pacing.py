"""The two ways for world and robot to keep time: each waiting for the other, or both by the wall's clock."""

import time
from typing import Protocol

from host_sim.client.session import Session
from host_sim.robot_io import Drive, Senses

HOLD_TICKS = 5
"""A body goes on with its last drive for so many ticks (100 ms); then its wheels stop."""


class Pace(Protocol):
    """Takes world and robot through one tick together."""

    def exchange(self, senses: Senses) -> Drive:
        """Tells the robot its senses.

        Returns:
            What the wheels are to do in this tick.

        Raises:
            RobotError: The robot is gone.
        """


class Lockstep:
    """World and robot wait for each other: the result is the same at any speed, and on any machine."""

    def __init__(self, session: Session) -> None:
        """Keeps time with the robot of a session."""
        self._session = session

    def exchange(self, senses: Senses) -> Drive:
        """As in `Pace`; a robot that does not answer by the session's deadline is gone."""
        self._session.send_senses(senses)
        drive = self._session.receive_drive(self._session.deadline_s)
        if drive is None:
            raise self._session.late(senses.tick)
        return drive


class RealTime:
    """A tick takes its time, and nobody waits: a late answer counts when it comes, as on a real body."""

    def __init__(self, session: Session, tick_s: float) -> None:
        """Begins with the wheels at rest.

        Args:
            session: The robot's.
            tick_s: Length of a tick on the wall's clock.
        """
        self._session, self._tick_s = session, tick_s
        self._next_s = time.monotonic()
        self._drive: Drive | None = None
        self._waited = 0

    def exchange(self, senses: Senses) -> Drive:
        """As in `Pace`: the answer, or the last one for `HOLD_TICKS` ticks, then rest, until the deadline."""
        self._session.send_senses(senses)
        # A host that was held up does not hurry to make up for it: that would not be real time either.
        self._next_s = max(self._next_s + self._tick_s, time.monotonic())
        fresh = self._newest()
        if fresh is None:
            self._session.frames.lost += 1
            return self._held(senses.tick)
        self._drive, self._waited = fresh, 0
        return fresh

    def _newest(self) -> Drive | None:
        """The last drive that comes before the tick is over."""
        fresh = None
        while (left_s := self._next_s - time.monotonic()) > 0:
            heard = self._session.receive_drive(left_s)
            fresh = heard or fresh
        return fresh

    def _held(self, tick: int) -> Drive:
        self._waited += 1
        if self._waited * self._tick_s > self._session.deadline_s:
            raise self._session.late(tick)
        if self._drive is None or self._waited > HOLD_TICKS:
            return Drive(tick, 0, 0, 0, 0, 0, False)
        return self._drive._replace(eat=False)
