"""The two ways to keep world and robots in step: lockstep and the wall clock."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from host_sim.base.errors import SessionLostError
from host_sim.client.robot_client import RobotClient
from host_sim.client.supervision import drive_after, recover
from host_sim.protocol.generated import REST, TICK_SPAN, Drive, Reason, Senses

HOLD_TICKS = 5
"""A body without a new drive continues with its last one for this many ticks (100 ms); then its wheels stop."""

_TURN_S = 0.002
"""In real time, the longest wait for one robot before turning to the next."""


class Pace(Protocol):
    """Takes the world and its robots through one tick."""

    def exchange(self, senses: Sequence[Senses]) -> Sequence[Drive]:
        """Sends each robot its senses.

        Returns:
            Each robot's drive for this tick.

        Raises:
            RobotError: A robot has ended, or did not answer by its client's deadline.
        """


@dataclass(frozen=True)
class BegunTick:
    """A tick partly done by C code on the clients' behalf.

    Attributes:
        sent: Number of robots, counted from the first, that have been sent their senses.
        drives: The drives of the first of these, which have answered.
    """

    sent: int
    drives: Sequence[Drive]


_NOTHING = BegunTick(0, ())


class Lockstep:
    """World and robots wait for each other, so the result does not depend on speed or machine."""

    def __init__(self, clients: Sequence[RobotClient]) -> None:
        """Takes the clients of the robots to pace."""
        self._clients = clients

    def exchange(self, senses: Sequence[Senses], begun: BegunTick = _NOTHING) -> Sequence[Drive]:
        """As in `Pace`, except for the part already done."""
        sent, drives = begun.sent, [*begun.drives]
        for client, sensed in zip(self._clients[len(drives) : sent], senses[len(drives) : sent], strict=True):
            client.note_sent(sensed)
        for client, sensed in zip(self._clients[sent:], senses[sent:], strict=True):
            client.send_senses(sensed)
        for client in self._clients[len(drives) :]:
            try:
                drives.append(client.await_drive())
            except SessionLostError as lost:  # noqa: PERF203 - a call less in each tick
                drives.append(drive_after(client, lost))
        return drives


@dataclass
class _Wheels:
    """The last drive of one robot, for ticks without an answer."""

    client: RobotClient
    drive: Drive | None = None
    waited: int = 0

    def turn(self, fresh: Drive | None, tick: int, tick_s: float) -> Drive:
        """Returns the drive that the body applies.

        Raises:
            RobotError: There was no answer for longer than the client's deadline.
        """
        self.drive = fresh or self.drive
        if fresh is not None and fresh.reason != Reason.SILENCE:
            self.waited = 0
        else:
            self._wait(tick, tick_s)
        return applied(self.drive, tick, fresh is not None)

    def _wait(self, tick: int, tick_s: float) -> None:
        self.client.frames.lost += 1
        self.waited += 1
        if self.waited * tick_s > self.client.connection.deadline_s:
            raise self.client.dialogue.no_answer(f"tick {tick}")
        if self.client.deadlines.miss(round(self.waited * tick_s, 6), tick_s):
            self.client.distrust(f"the robot did not answer for {self.waited * tick_s:g} s")


def applied(last: Drive | None, tick: int, came: bool) -> Drive:
    """The drive that a body applies in a tick: the last one, until it is more than `HOLD_TICKS` ticks old, then rest.

    Its age counts from the senses that it answers, not from its arrival.

    Args:
        last: The last drive; None if there was none.
        tick: Number of the tick, 0..255.
        came: Whether the last drive arrived in this tick; food is eaten only then.
    """
    if last is None or (tick - last.tick) % TICK_SPAN > HOLD_TICKS:
        return REST._replace(tick=tick)
    return last if came else last._replace(eat=False)


class RealTime:
    """Ticks follow the wall clock and wait for no robot: a late answer takes effect on arrival, as on a real body."""

    def __init__(self, clients: Sequence[RobotClient], tick_s: float) -> None:
        """Starts with the wheels at rest; the clock begins with the first tick.

        Args:
            clients: The robots' clients, which share one clock.
            tick_s: Length of a tick, s.
        """
        self._tick_s = tick_s
        self._wheels = [_Wheels(client) for client in clients]
        self._now = clients[0].connection.now
        self._next_s: float | None = None

    def rest(self) -> None:
        """Pauses the world: its clock restarts with the next tick."""
        self._next_s = None

    def exchange(self, senses: Sequence[Senses]) -> Sequence[Drive]:
        """As in `Pace`: the drives are the robots' answers, or earlier ones that are still held."""
        begin_s = self._now() if self._next_s is None else self._next_s
        early = self._listen(begin_s, until_all_answer=False)
        late_s, lost_s = max(self._now() - begin_s, 0.0), 0.0
        for wheels, sensed in zip(self._wheels, senses, strict=True):
            lost_s = wheels.client.deadlines.begin(late_s, self._tick_s)
            wheels.client.send_senses(sensed)
        self._next_s = begin_s + lost_s + self._tick_s
        fresh = self._listen(self._next_s, until_all_answer=True)
        newest = [drive or before for drive, before in zip(fresh, early, strict=True)]
        both = zip(self._wheels, newest, senses, strict=True)
        return [wheels.turn(drive, sensed.tick, self._tick_s) for wheels, drive, sensed in both]

    def _listen(self, end_s: float, *, until_all_answer: bool) -> list[Drive | None]:
        """The last drive of each robot that arrives before a time. Listens to the robots in turn."""
        fresh: list[Drive | None] = [None] * len(self._wheels)
        listening = deque(enumerate(wheels.client for wheels in self._wheels))
        while listening:
            (i, client), left_s = listening.popleft(), end_s - self._now()
            drive = self._receive(client, min(max(left_s, 0.0), _TURN_S))
            fresh[i] = drive or fresh[i]
            if left_s > 0 and not (until_all_answer and _is_answer(drive, client)):
                listening.append((i, client))
        return fresh

    @staticmethod
    def _receive(client: RobotClient, timeout_s: float) -> Drive | None:
        try:
            return client.receive_drive(timeout_s)
        except SessionLostError as lost:
            recover(client, lost)
            return None


def _is_answer(drive: Drive | None, client: RobotClient) -> bool:
    """Whether a drive answers a robot's last senses."""
    return drive is not None and drive.tick == client.inbox.sent_tick
