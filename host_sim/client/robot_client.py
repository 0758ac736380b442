"""A client for one robot: sends commands and senses until they are answered, and logs every frame once."""

import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from host_sim.client.frame_log import FrameLog
from host_sim.client.inbox import Inbox
from host_sim.client.incident import Incident
from host_sim.client.robot_reports import RobotReports
from host_sim.client.round_trip import RoundTrip
from host_sim.client.session import FrameCounts, Session
from host_sim.client.waiting import Waiting
from host_sim.errors import RefusedError, RivalError, RobotError, SessionLostError
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, Protocol
from host_sim.protocol.generated import MemoryKind, Opcode, Result
from host_sim.robot_io import NOTHING_NEAR, Drive, Ranges, Senses
from host_sim.transport.line_stats import LineStats
from host_sim.transport.link import Link

DEADLINE_S = 5.0
"""Time for the robot to answer before it is given up, s of wall-clock time."""

INCIDENTS_MAX = 1000
"""Number of incidents that are listed; later ones are only counted."""

_REPORT_S = 1.0
_REPORT_DEMANDS = 100
_JUMP = 7
_TIMED_TICKS = 16
_NO_FRAME = Frame(-1, b"")


@dataclass
class RobotClient:
    """Talks to one robot over a link.

    Attributes:
        link: Carries the frames.
        protocol: Encodes and decodes them.
        log: Records every frame sent and every valid frame received, in order. What is repeated, and what a robot
            says only because it waits, is left out: the log does not depend on how long things took.
        lockstep: Whether the simulator's clock counts: the robot waits for senses as long as they take.
        owner: Number of this simulator, 1..255, by which the robot knows whom it obeys.
        status: Describes the state of the robot's process, and raises RobotError if it has ended.
        bus: Name of the bus that the robot is on.
        deadline_s: Time for the robot to answer, s of wall-clock time.
        now: Tells the time in which the link waits, s.
        line: What happens to the line below the frames.
        round_trip: How long answers take.
        incidents: What happened that makes the result of the run doubtful, the first `INCIDENTS_MAX`.
        unlisted: Number of incidents after those.
        firmware: The signals of the BOOT in the handshake, which name the firmware.
        memory_kind: What the bytes of its memory mean to the behaviour with which it was started.
        wants_ranges: Whether it was started with a behaviour that decides by distances.
        ranges: The distances that go before the next senses, where they are wanted.
        inbox: Takes in what comes.
        unsettled: Tick at which an environment ended whose last memory may yet turn out to be lost; None if none may.
    """

    link: Link
    protocol: Protocol
    log: FrameLog
    lockstep: bool = True
    owner: int = 1
    status: Callable[[], str] = lambda: "was not started here"
    bus: str = ""
    deadline_s: float = DEADLINE_S
    now: Callable[[], float] = time.monotonic
    line: LineStats = field(default_factory=LineStats)
    round_trip: RoundTrip = field(default_factory=RoundTrip)
    incidents: list[Incident] = field(default_factory=list)
    unlisted: int = 0
    firmware: Mapping[str, int] = field(default_factory=dict)
    memory_kind: MemoryKind = MemoryKind.SIDES
    wants_ranges: bool = False
    ranges: Ranges = NOTHING_NEAR
    inbox: Inbox = field(init=False)
    unsettled: int | None = None
    _counter: int = 0
    _senses: Frame = _NO_FRAME
    _ranges: Frame = _NO_FRAME
    _sent_s: float = 0.0
    _timed: bool = False
    _lossy: bool = False
    _owed_tick: int = 0

    def __post_init__(self) -> None:
        self.inbox = Inbox(self.protocol, self.log.add, self.now, self.lockstep, self.owner)
        self._take_drive = self.inbox.take_drive
        self._wait = Waiting(self.link, self.now, self.status, self.round_trip, self.inbox.counts)

    @property
    def node(self) -> int:
        """The robot's node number on the bus."""
        return self.protocol.node

    @property
    def reports(self) -> RobotReports:
        """What the robot has reported."""
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
    def session(self) -> Session | None:
        """How the robot was started; None while it is stopped."""
        return self.inbox.session

    @session.setter
    def session(self, session: Session | None) -> None:
        self.inbox.session = session

    @property
    def last(self) -> Frame | None:
        """The last valid frame received from the robot."""
        return self.inbox.last

    @property
    def tick(self) -> int:
        """Number of the last tick whose senses were sent, from 0."""
        return self.inbox.tick

    def distrust(self, what: str) -> None:
        """Notes that something happened which makes the result of the run doubtful."""
        if len(self.incidents) < INCIDENTS_MAX:
            self.incidents.append(Incident(self.tick, self.node, what))
        else:
            self.unlisted += 1

    def command(self, opcode: str, **signals: int) -> DecodedFrame:
        """Sends a command until it is answered.

        Args:
            opcode: Name of the command.
            **signals: The command's signals, by name.

        Returns:
            The answer.

        Raises:
            RefusedError: The robot refuses the command.
            RobotError: The robot does not answer.
        """
        answer = self.ask(opcode, signals, self.deadline_s)
        if answer is None:
            raise RobotError(f"the robot did not answer {opcode} within {self.deadline_s:g} s; {self.account()}")
        return answer

    def ask(self, opcode: str, signals: Mapping[str, int], timeout_s: float) -> DecodedFrame | None:
        """As `command`, but None if there is no answer in time.

        A command whose counter the robot does not take is sent with another one: in a session that was cut short, the
        robot counted on from other commands.
        """
        answer = None
        for jump in (1, _JUMP, _JUMP):
            self._counter = (self._counter + jump) % COUNTERS
            answer = self._ask_once(self._command(opcode, signals), timeout_s)
            if answer is None or answer.signals["result"] != Result.OUT_OF_SEQUENCE:
                break
        if answer is None or answer.signals["result"] == Result.DONE:
            return answer
        if answer.signals["result"] == Result.OWNED:
            raise RivalError(f"node {self.node} obeys another simulator (tick {self.tick}): end one of the two")
        assert self.inbox.last is not None
        raise RefusedError(f"the robot refused a command: {self.protocol.describe(self.inbox.last)}")

    def demand_reports(self, opcode: str) -> None:
        """Asks with `report` or `stop` until every report has come, and after a stop until the wheels rest.

        Raises:
            RobotError: The robot does not answer.
        """
        self.expect_reports(opcode)
        for _ in range(_REPORT_DEMANDS):
            self.command(opcode)
            if self.await_reports():
                return
        raise RobotError(f"the robot did not report all after {opcode}; {self.account()}")

    def expect_reports(self, opcode: str) -> None:
        """Prepares for the reports that `report` or `stop` asks for."""
        self.reports.await_all()
        self.inbox.reporting, self.inbox.rested = True, opcode != "stop"

    def await_reports(self) -> bool:
        """Whether every report comes that was asked for; False as soon as one is known to be missing.

        It ends after the answer: what was on its way before that may be the end of an older one.
        """
        give_up = self.now() + self.deadline_s
        self.reports.await_end()
        self.inbox.silent = False
        while not (self._has_reported and self.reports.ended):
            heard = self._wait.receive(self._take_any, _REPORT_S)
            if heard is None or self.inbox.silent or self.now() > give_up:
                break
            if self.reports.ended and not self.reports.complete:
                break
        self.inbox.reporting = not self._has_reported
        return self._has_reported

    @property
    def _has_reported(self) -> bool:
        return self.reports.complete and self.inbox.rested

    def await_memory(self) -> None:
        """Waits for the memory that the robot reports after a change, and asks for it if it was lost on the way.

        Raises:
            RobotError: The robot does not report it.
        """
        if self._wait.receive(self.inbox.take_memory, _REPORT_S) is None:
            self.demand_reports("report")

    def listen(self, seconds: float) -> None:
        """Takes in what comes, for some time."""
        self._wait.receive(self.inbox.take, seconds)

    def send_senses(self, senses: Senses) -> None:
        """Sends the senses of one tick, after the distances if the robot wants them, and logs them."""
        inbox = self.inbox
        counter = inbox.expect_drive(senses.tick)
        self._senses = frame = self.protocol.encode_senses(senses, counter)
        if self.wants_ranges:
            self._send_ranges(senses.tick, counter)
        # On some kernels, reading the clock takes longer than all the rest.
        self._timed = inbox.ticks % _TIMED_TICKS == 0 or not self.round_trip.is_sure
        if self._timed:
            self._sent_s = self.now()
        self.link.send(frame)
        inbox.counts.sent += 1
        inbox.record(frame)  # while the robot thinks

    def note_sent(self, senses: Senses) -> None:
        """Takes over the senses of one tick that were sent and logged elsewhere."""
        self._senses = self.protocol.encode_senses(senses, self.inbox.expect_drive(senses.tick))
        self._timed = False
        self.inbox.counts.sent += 1

    def repeat_senses(self) -> None:
        """Sends the senses of the last tick again, and the distances that went before them."""
        if self.wants_ranges:
            self._wait.repeat(self._ranges)
        self._note_lost_answers(self.inbox.ticks - 1)
        self.inbox.owed += 1
        self._owed_tick = self.inbox.ticks
        self._wait.repeat(self._senses)

    def await_drive(self) -> Drive:
        """In lockstep: the answer to the last senses, which are repeated until it comes.

        Raises:
            SessionLostError: The robot does not answer by the deadline, may no longer be the one that was started, or
                no longer be alone.
            RobotError: The robot has ended.
        """
        frame = self.link.receive(self.round_trip.timeout_s)
        drive = None if frame is None else self._take_drive(frame)
        if drive is None:
            return self._await_late_drive(was_silent=frame is None)
        if self._timed:
            self.round_trip.sample(self.now() - self._sent_s)
        return drive

    def receive_drive(self, timeout_s: float) -> Drive | None:
        """The next fresh drive, or None after `timeout_s`; 0 polls. Other messages are taken in too.

        Raises:
            SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
            RobotError: The robot has ended.
        """
        return self._wait.receive(self._take_drive, timeout_s)

    def settle(self) -> None:
        """At the end of an environment: makes sure that the reported memory is the robot's, if frames get lost.

        Raises:
            SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
            RobotError: The robot does not answer.
        """
        self._note_lost_answers(self.inbox.ticks)
        if self.inbox.owed and not self._lossy:
            self._wait.receive(self._take_owed, self.deadline_s)
        self._lossy = self._lossy or self.inbox.owed > 0 or self.frames.lost > 0
        self.inbox.owed = 0
        self.reports.gap = None
        self.unsettled = None if self._lossy else self.tick
        if self._lossy:
            self.demand_reports("report")

    def _note_lost_answers(self, ticks: int) -> None:
        """Answers come in order: those that are still owed from before the last answered tick are lost."""
        self._lossy = self._lossy or (self.inbox.owed > 0 and self._owed_tick < ticks)

    def check_settled(self) -> None:
        """Notes if it has turned out since that a memory was lost at the end of an environment."""
        if self.unsettled is not None and self.reports.gap:
            self.distrust(
                f"an environment ended at tick {self.unsettled}, and its last memory may have been lost on the way"
            )
        self.unsettled = None

    @property
    def senses_counter(self) -> int:
        """Alive counter of the last SENSES."""
        return self.inbox.ticks % COUNTERS

    def rest(self) -> None:
        """Stops the wheels, without waiting for an answer."""
        self.session = None
        self._counter = (self._counter + 1) % COUNTERS
        with suppress(RobotError):
            self.link.send(self._command("stop", {}))

    def late(self, tick: int) -> RobotError:
        """The error for a drive that did not come by the deadline."""
        return RobotError(f"the robot did not answer tick {tick} within {self.deadline_s:g} s; {self.account()}")

    def account(self) -> str:
        """The last frame from the robot and the state of its process, for error messages."""
        last = self.inbox.last
        said = "none" if last is None else self.protocol.describe(last)
        return f"last frame from it: {said}; it {self.status()}{self.line.account()}"

    def _command(self, opcode: str, signals: Mapping[str, int]) -> Frame:
        fixed = {"counter": self._counter, "opcode": Opcode[opcode.upper()], "owner": self.owner}
        return self.protocol.encode("COMMAND", {**fixed, **signals})

    def _send_ranges(self, tick: int, counter: int) -> None:
        self._ranges = self.protocol.encode_ranges(self.ranges, tick, counter)
        self.link.send(self._ranges)
        self.inbox.counts.sent += 1
        self.inbox.record(self._ranges)

    def _ask_once(self, command: Frame, timeout_s: float) -> DecodedFrame | None:
        self.inbox.expect_answer(command)
        self.inbox.record(command)
        self.frames.sent += 1
        began, repeated = self.now(), self.frames.repeated
        self.link.send(command)
        answer = self._wait.receive_or_repeat(lambda: self._wait.repeat(command), self.inbox.take_answer, timeout_s)
        if answer is not None and self.frames.repeated == repeated:
            self.round_trip.sample(self.now() - began)
        return answer

    def _await_late_drive(self, *, was_silent: bool) -> Drive:
        if was_silent:
            self.status()
            self.repeat_senses()
        drive = self._wait.receive_or_repeat(self.repeat_senses, self._take_drive, self.deadline_s)
        if drive is None:
            raise SessionLostError("it does not answer", silent=True)
        if self._timed:
            self.round_trip.note(self.now() - self._sent_s)
        return drive

    def _take_any(self, frame: Frame) -> bool:
        self.inbox.take(frame)
        return True

    def _take_owed(self, frame: Frame) -> bool | None:
        """True when each of the repeated senses was answered."""
        self.inbox.take(frame)
        return self.inbox.owed == 0 or None
