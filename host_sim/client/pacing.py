"""The two ways for world and robots to keep time: in lockstep, or by the wall clock."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from host_sim.client.robot_client import RobotClient
from host_sim.protocol.generated import TICK_SPAN
from host_sim.robot_io import REST, Drive, Senses

HOLD_TICKS = 5
"""A body without a new drive continues with its last one for this many ticks (100 ms); then its wheels stop."""


class Pace(Protocol):
    """Takes the world and its robots through one tick."""

    def exchange(self, senses: Sequence[Senses]) -> Sequence[Drive]:
        """Sends each robot its senses.

        Returns:
            Each robot's drive for this tick.

        Raises:
            RobotError: A robot has ended, or did not answer by its client's deadline.
        """


class Lockstep:
    """World and robots wait for each other: the result is the same at any speed and on any machine."""

    def __init__(self, clients: Sequence[RobotClient]) -> None:
        """Paces the robots of these clients."""
        self._clients = clients

    def exchange(self, senses: Sequence[Senses]) -> Sequence[Drive]:
        """As in `Pace`."""
        drives = []
        for client, sensed in zip(self._clients, senses, strict=True):
            client.send_senses(sensed)
        for client, sensed in zip(self._clients, senses, strict=True):
            drive = client.receive_drive(client.deadline_s)
            if drive is None:
                raise client.late(sensed.tick)
            drives.append(drive)
        return drives


@dataclass
class _Wheels:
    """The last drive of one robot, for ticks without an answer."""

    client: RobotClient
    drive: Drive | None = None
    waited: int = 0

    def turn(self, fresh: Drive | None, tick: int, tick_s: float) -> Drive:
        """The drive that the body applies.

        Raises:
            RobotError: There was no answer for longer than the client's deadline.
        """
        if fresh is not None:
            self.drive, self.waited = fresh, 0
        else:
            self.client.frames.lost += 1
            self.waited += 1
        if self.waited * tick_s > self.client.deadline_s:
            raise self.client.late(tick)
        return applied(self.drive, tick, fresh is not None)


def applied(last: Drive | None, tick: int, came: bool) -> Drive:
    """The drive that a body applies in a tick: the last one, until it is more than `HOLD_TICKS` ticks old, then rest.

    Its age counts from the senses that it answers, not from when it came.

    Args:
        last: The last drive; None if there was none.
        tick: Number of the tick, 0..255.
        came: Whether the last drive came in this tick; food is eaten only then.
    """
    if last is None or (tick - last.tick) % TICK_SPAN > HOLD_TICKS:
        return REST._replace(tick=tick)
    return last if came else last._replace(eat=False)


class RealTime:
    """Ticks follow the wall clock and wait for no robot: a late answer applies when it comes, as on a real body."""

    def __init__(self, clients: Sequence[RobotClient], tick_s: float) -> None:
        """Starts with the wheels at rest.

        Args:
            clients: The robots' clients.
            tick_s: Length of a tick, s of wall-clock time.
        """
        self._tick_s = tick_s
        self._wheels = [_Wheels(client) for client in clients]
        self._next_s = time.monotonic()

    def exchange(self, senses: Sequence[Senses]) -> Sequence[Drive]:
        """As in `Pace`: the drives are the robots' answers, or earlier ones that are still held."""
        for wheels, sensed in zip(self._wheels, senses, strict=True):
            wheels.client.send_senses(sensed)
        # A host that was delayed does not catch up: that would not be real time either.
        self._next_s = max(self._next_s + self._tick_s, time.monotonic())
        fresh = self._newest()
        both = zip(self._wheels, fresh, senses, strict=True)
        return [wheels.turn(drive, sensed.tick, self._tick_s) for wheels, drive, sensed in both]

    def _newest(self) -> list[Drive | None]:
        """For each robot, the last drive that comes before the tick is over."""
        fresh: list[Drive | None] = [None] * len(self._wheels)
        while (left_s := self._next_s - time.monotonic()) > 0:
            for i, wheels in enumerate(self._wheels):
                fresh[i] = wheels.client.receive_drive(left_s / len(self._wheels)) or fresh[i]
        return fresh
