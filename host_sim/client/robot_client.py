"""A client for one robot: sends senses until they are answered, handles its frames, and logs each frame once."""

from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

from host_sim.base.errors import SessionLostError
from host_sim.client.connection import Connection, RoundTrip, Waiting
from host_sim.client.deadlines import Deadlines
from host_sim.client.dialogue import Dialogue
from host_sim.client.frame_log import FrameLog
from host_sim.client.inbox import Inbox, check_report, holds, is_as_started
from host_sim.client.robot_reports import RobotReports
from host_sim.client.session import FrameCounts
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import NOTHING_NEAR, Drive, MemoryKind, Ranges, Senses

REFUSED_MAX = 10_000
"""Maximum number of frames kept; later ones are only counted."""


class Incident(NamedTuple):
    """An event that should not happen in a run.

    Attributes:
        tick: Number of the tick, from the first of the run.
        node: Node number of the robot.
        text: What happened, as a sentence without a full stop.
    """

    tick: int
    node: int
    text: str

    def __str__(self) -> str:
        return f"at tick {self.tick} (node {self.node}) {self.text}"


class RefusedFrames:
    """The refused frames of one robot, as lines of a log, each followed by the reason.

    Attributes:
        unlisted: Number of frames after the first `REFUSED_MAX`.
    """

    def __init__(self, log: FrameLog) -> None:
        """Starts without frames.

        Args:
            log: The run's log, which provides the time.
        """
        self.unlisted = 0
        self._log, self._text, self._count = log, bytearray(), 0

    @property
    def lines(self) -> list[str]:
        """Lines of the first `REFUSED_MAX` frames."""
        return self._text.decode("ascii").splitlines()

    def add(self, frame: Frame, why: str) -> None:
        """Adds a refused frame."""
        if self._count == REFUSED_MAX:
            self.unlisted += 1
            return
        self._count += 1
        self._text += f"{self._log.line(frame)}  ; {why}\n".encode("ascii")


INCIDENTS_MAX = 1000
"""Maximum number of incidents listed; later ones are only counted."""

_TIMED_TICKS = 16
_NO_FRAME = Frame(-1, b"")


class RobotClient:
    """Talks to one robot over a connection.

    Attributes:
        connection: Carries the frames.
        protocol: Encodes and decodes them.
        log: Records every frame sent and every valid frame received, in order. Repetitions, and frames
            that a robot sends only because it waits, are left out: the log does not depend on timing.
        round_trip: Estimates the answer time.
        inbox: Processes incoming frames.
        waiting: Waits for incoming frames.
        dialogue: Sends commands.
        deadlines: Timing quality in real time.
        refused: The frames that were refused.
        incidents: The first `INCIDENTS_MAX` events that make the result of the run doubtful.
        unlisted: Number of incidents after those.
        firmware: The signals of the BOOT in the handshake, which name the firmware.
        memory_kind: The kind of memory of the behaviour with which it was started.
        wants_ranges: Whether it was started with a behaviour that decides by distances.
        ranges: The distances to send before the next senses, if the robot wants them.
        unsettled: Tick of the end of an environment whose last memory may have been lost; None if there is none.
    """

    def __init__(
        self,
        connection: Connection,
        protocol: Protocol,
        log: FrameLog,
        *,
        lockstep: bool = True,
        owner: int = 1,
    ) -> None:
        """Creates a client; nothing is sent yet.

        Args:
            connection: Carries the frames.
            protocol: Encodes and decodes them.
            log: Records them.
            lockstep: Whether the robot waits for senses as long as they take, instead of running in real time.
            owner: Owner ID of this simulator, 1..255; the robot obeys only its owner.
        """
        self.connection, self.protocol, self.log = connection, protocol, log
        self.round_trip = RoundTrip()
        self.inbox = Inbox(protocol, log.add, connection.now, lockstep, owner)
        self.deadlines = Deadlines()
        self.refused = RefusedFrames(log)
        self.inbox.refuse = self.refused.add
        self.inbox.check = partial(check_report, self.inbox)
        self.waiting = Waiting(connection, self.round_trip, self.inbox)
        self.dialogue = Dialogue(connection, self.inbox, self.waiting)
        self.incidents: list[Incident] = []
        self.unlisted = 0
        self.firmware: Mapping[str, int] = {}
        self.memory_kind = MemoryKind.SIDES
        self.wants_ranges = False
        self.ranges: Ranges = NOTHING_NEAR
        self.unsettled: int | None = None
        self._settled: tuple[int, tuple[int, ...]] | None = None
        self._senses = self._ranges = _NO_FRAME
        self._sent_s = 0.0
        self._timed = self._lossy = False
        self._owed_tick = 0

    @property
    def node(self) -> int:
        """The robot's node number on the bus."""
        return self.protocol.node

    @property
    def reports(self) -> RobotReports:
        """The robot's latest reports."""
        return self.inbox.reports

    @property
    def memory(self) -> tuple[int, ...]:
        """The eight cells, as last reported by the robot."""
        return self.inbox.reports.memory

    @property
    def faults(self) -> dict[str, int]:
        """The robot's fault counters, as last reported by it."""
        return self.inbox.reports.faults

    @property
    def frames(self) -> FrameCounts:
        """Frame counters."""
        return self.inbox.counts

    @property
    def tick(self) -> int:
        """Number of the last tick whose senses were sent, from 0."""
        return self.inbox.tick

    def distrust(self, what: str) -> None:
        """Notes an incident that makes the result of the run doubtful."""
        if len(self.incidents) < INCIDENTS_MAX:
            self.incidents.append(Incident(self.tick, self.node, what))
        else:
            self.unlisted += 1

    def check_held(self) -> None:
        """Notes an incident if, by its last report, the robot does not hold the commands and senses sent here."""
        if not holds(self.inbox) or not is_as_started(self.inbox):
            self.distrust(
                "the robot does not hold what it was told here: somebody else commands it, or a frame was altered"
            )
            self.inbox.held_check.given_up = True

    def send_senses(self, senses: Senses) -> None:
        """Sends the senses of one tick, after the distances if the robot wants them, and logs them."""
        inbox = self.inbox
        counter = inbox.expect_drive(senses.tick)
        self._senses = frame = self.protocol.encode_senses(senses, counter)
        inbox.held_check.asked = frame if inbox.lockstep and inbox.held_check.takes_senses else None
        if self.wants_ranges:
            self._send_ranges(senses.tick, counter)
        # On some kernels, reading the clock takes longer than everything else here.
        self._timed = inbox.ticks % _TIMED_TICKS == 0 or not self.round_trip.is_sure
        if self._timed:
            self._sent_s = self.connection.now()
        self.connection.link.send(frame)
        inbox.counts.sent += 1
        inbox.record(frame)  # while the robot thinks
        if self.connection.line.copies > 1:
            self._note_copies()

    def note_sent(self, senses: Senses) -> None:
        """Takes over the senses of one tick that were sent and logged elsewhere."""
        self._senses = self.protocol.encode_senses(senses, self.inbox.expect_drive(senses.tick))
        self.inbox.held_check.ask(self._senses)
        self._timed = False
        self.inbox.counts.sent += 1

    def repeat_senses(self) -> None:
        """In lockstep: sends the senses of the last tick again, and the distances sent before them."""
        self.inbox.held_check.ask(self._senses)
        if self.wants_ranges:
            self.waiting.repeat(self._ranges)
        self._expect_answers(self.connection.line.copies)
        self.waiting.repeat(self._senses)

    def await_drive(self) -> Drive:
        """In lockstep: waits for the answer to the last senses, which are repeated until it arrives.

        Raises:
            SessionLostError: The robot does not answer by the deadline, may no longer be the one that was started, or
                no longer be alone.
            RobotError: The robot has ended.
        """
        frame = self.connection.link.receive(self.round_trip.timeout_s)
        drive = None if frame is None else self.inbox.take(frame)
        if drive is None:
            return self._await_late_drive(was_silent=frame is None)
        if self._timed:
            self.round_trip.sample(self.connection.now() - self._sent_s)
        return drive

    def receive_drive(self, timeout_s: float) -> Drive | None:
        """The next fresh drive, or None after `timeout_s`; 0 polls. Other messages are processed too.

        Raises:
            SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
            RobotError: The robot has ended.
        """
        return self.waiting.receive(self.inbox.take, timeout_s)

    def settle(self) -> None:
        """At the end of an environment: confirms the reported memory if frames may have been lost.

        Raises:
            SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
            RobotError: The robot does not answer.
        """
        self._note_lost_answers(self.inbox.ticks)
        self._lossy = self._lossy or self.connection.line.noisy
        if self.inbox.owed and not self._lossy:
            self.waiting.receive(self._take_owed, self.connection.deadline_s)
        self._lossy = self._lossy or self.inbox.owed > 0 or self.frames.lost > 0
        self.inbox.owed = 0
        self.reports.gap = None
        self.unsettled = None if self._lossy else self.tick
        if self._lossy:
            self.dialogue.demand_reports("report")
        self._settled = self.tick, self.memory

    def _note_lost_answers(self, ticks: int) -> None:
        """Notes a loss if answers from before the last answered tick are still owed, since answers come in order."""
        self._lossy = self._lossy or (self.inbox.owed > 0 and self._owed_tick < ticks)

    def await_memory(self) -> None:
        """Waits for the memory that the robot reports after a command has changed it.

        It is then no late report of the last memory of an environment.

        Raises:
            RobotError: The robot does not report it.
        """
        self.dialogue.await_memory()
        self._settled = None

    def check_settled(self) -> None:
        """Notes an incident if the last memory of an environment may have been lost, as later reports show."""
        at, settled = self._settled or (self.tick, self.memory)
        is_late = at == self.tick and settled != self.memory
        if is_late or (self.unsettled is not None and self.reports.gap):
            self.distrust(f"an environment ended at tick {at}, and its last memory may have been lost on the way")
        self.unsettled = None

    def _send_ranges(self, tick: int, counter: int) -> None:
        self._ranges = self.protocol.encode_ranges(self.ranges, tick, counter)
        self.connection.link.send(self._ranges)
        self.inbox.counts.sent += 1
        self.inbox.record(self._ranges)

    def _expect_answers(self, count: int) -> None:
        """Expects answers to this many repeated senses."""
        self._note_lost_answers(self.inbox.ticks - 1)
        self.inbox.owed += count
        self._owed_tick = self.inbox.ticks

    def _note_copies(self) -> None:
        """Notes that the senses of this tick were sent in several copies at once."""
        copies = self.connection.line.copies - 1
        self._expect_answers(copies)
        self.frames.repeated += copies
        self.connection.line.ease()

    def _await_late_drive(self, *, was_silent: bool) -> Drive:
        repeated = self.frames.repeated
        if was_silent:
            self.connection.status()
            self.repeat_senses()
        drive = self.waiting.receive_or_repeat(self.repeat_senses, self.inbox.take, self.connection.deadline_s)
        if drive is None:
            raise SessionLostError("it does not answer", silent=True)
        if self._timed:
            learn = self.round_trip.sample if self.frames.repeated == repeated else self.round_trip.note
            learn(self.connection.now() - self._sent_s)
        return drive

    def _take_owed(self, frame: Frame) -> bool | None:
        """Returns True once all repeated senses were answered."""
        self.inbox.take(frame)
        return self.inbox.owed == 0 or None
