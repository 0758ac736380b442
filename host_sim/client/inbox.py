"""Sorts all frames from a robot's side: answers, drives, reports, and others; compares reports with the session."""

from collections.abc import Callable
from dataclasses import dataclass, field

from host_sim.base.errors import FirmwareError, SessionLostError
from host_sim.client.robot_reports import REPORTS, Arrival, RobotReports
from host_sim.client.session import AskedCommands, FrameCounts, HeldCheck, Rivals, Session
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, Protocol, counter_of
from host_sim.protocol.generated import REST, TICK_SPAN, Drive, Fault, Reason, Result

_TICK_MASK = TICK_SPAN - 1
_FORGED, _COMMANDED = "somebody sends frames in the robot's name", "somebody else commands the robot"
_NO_ANSWER = frozenset((int(Reason.STOP), int(Reason.SILENCE)))
_NO_FRAME = Frame(-1, b"\0\0")


@dataclass
class Inbox:
    """Sorts the frames of one robot into new, old, and foreign ones.

    Attributes:
        protocol: Decodes them.
        record: Called with each valid frame that is new, for the log.
        now: Returns the time, s.
        lockstep: Whether the robot waits for the simulator, so that only the last senses are answered.
        owner: Owner ID of this simulator.
        counts: Frame counters.
        asked: The commands that were sent.
        told: The commands that the robot has carried out, and the senses that it has obeyed.
        rivals: Other simulators that command it.
        refuse: Called with each refused frame and the reason.
        check: Called with each heartbeat and each new report; it may raise what `take` raises.
        reports: The robot's latest reports.
        session: How the robot was started; None while it is stopped.
        last: The last valid frame from the robot.
        ticks: Number of ticks whose senses were sent.
        sent_tick: Number of the last of these ticks, as on the wire.
        sent_counter: Alive counter of the last senses sent.
        reporting: Whether a whole report is awaited.
        rested: Whether a stopped robot has reported that its wheels rest, or need not report it.
        silent: Whether the robot has reported silence, after which no earlier frame can still arrive.
        owed: Number of repeated senses whose answers have not arrived yet.
        answered_again: Number of repeated answers to repeated frames.
        drive: The last new drive.
        refused: The last frame that was refused; `refused_at` is the number of ticks before it.
    """

    protocol: Protocol
    record: Callable[[Frame], object]
    now: Callable[[], float]
    lockstep: bool
    owner: int
    counts: FrameCounts = field(default_factory=FrameCounts)
    asked: AskedCommands = field(default_factory=AskedCommands)
    held_check: HeldCheck = field(default_factory=HeldCheck)
    refuse: Callable[[Frame, str], object] = lambda _frame, _why: None
    check: Callable[[DecodedFrame], object] = lambda _report: None
    reports: RobotReports = field(default_factory=RobotReports)
    session: Session | None = None
    last: Frame | None = None
    ticks: int = 0
    sent_tick: int = 0
    sent_counter: int = 0
    reporting: bool = False
    rested: bool = False
    silent: bool = False
    owed: int = 0
    answered_again: int = 0
    drive: Drive = REST
    refused: Frame = _NO_FRAME
    refused_at: int = -1
    _drive_tick: int = 0
    _drive_frame: Frame = _NO_FRAME

    def __post_init__(self) -> None:
        """Starts without any other simulator heard."""
        self.rivals = Rivals(self.owner, self.asked)

    @property
    def tick(self) -> int:
        """Number of the last tick whose senses were sent, from 0."""
        return max(self.ticks - 1, 0)

    def expect_drive(self, tick: int) -> int:
        """Prepares for sending the senses of a tick, with this number on the wire. Returns their alive counter."""
        self.ticks += 1
        self.sent_tick = tick
        self.sent_counter = self.ticks % COUNTERS
        return self.sent_counter

    def catch_up(self, ticks: int, drive: Drive, frame: Frame) -> None:
        """Takes over ticks whose frames were exchanged elsewhere, with the last drive and its frame."""
        self.ticks += ticks
        self.sent_tick, self.sent_counter = drive.tick, self.ticks % COUNTERS
        self.drive, self._drive_tick, self._drive_frame, self.last = drive, self.ticks, frame, frame

    def take(self, frame: Frame) -> Drive | None:
        """Processes a frame of any kind. Returns the drive in it if it answers senses not answered yet.

        Raises:
            SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
            FirmwareError: The robot was built from another layout of the messages.
        """
        drive = self.protocol.decode_drive(frame)
        if drive is None:
            self._take_other(frame)
            return None
        # The usual case first: it occurs in each tick.
        if drive.tick != self.sent_tick or frame.data[1] & 15 != self.sent_counter or drive.reason in _NO_ANSWER:
            return self._take_other_drive(drive, frame)
        if self.session is None or self._drive_tick == self.ticks:
            self._take_old_drive(drive, frame)
            return None
        self.drive, self._drive_tick, self._drive_frame = drive, self.ticks, frame
        self.last = frame
        self.counts.received += 1
        told = self.held_check
        if told.asked is not None:  # as told.take_drive does: a call takes too long in each tick
            told.answered.append((told.asked, frame))
            told.asked = None
        self.record(frame)
        return drive

    def take_answer(self, frame: Frame) -> DecodedFrame | None:
        """Returns the answer to the last command, once; processes other frames.

        Raises:
            SessionLostError: As in `take`.
            FirmwareError: As in `take`.
        """
        decoded = self.protocol.decode(frame)
        if decoded is None or decoded.name != "ANSWER":
            self.take(frame)
            return None
        return self._take_any_answer(frame, decoded)

    def take_memory(self, frame: Frame) -> bool | None:
        """Returns True if a frame completes a new memory; processes all frames.

        Raises:
            SessionLostError: As in `take`.
            FirmwareError: As in `take`.
        """
        before = self.reports.memories
        self.take(frame)
        return self.reports.memories != before or None

    def _take_other_drive(self, drive: Drive, frame: Frame) -> Drive | None:
        """Handles a drive that does not answer the last senses: late, old, or a report that the robot rests."""
        if drive.reason == Reason.SILENCE:
            return self._take_silence(drive, frame)
        behind = (self.sent_tick - drive.tick) & _TICK_MASK
        tick = self.ticks - behind
        is_new = tick > self._drive_tick and (counter_of(frame) - tick) % COUNTERS == 0
        if drive.reason == Reason.STOP:
            return self._take_stop(drive, frame, is_new=is_new and (behind == 0 or not self.lockstep))
        if not is_new or self.lockstep or behind >= TICK_SPAN // 2 or self.session is None:
            self._take_old_drive(drive, frame)
            return None
        self.drive, self._drive_tick, self._drive_frame = drive, tick, frame
        self._accept(frame)
        return drive

    def _take_old_drive(self, drive: Drive, frame: Frame) -> None:
        """Handles a repeated or late drive."""
        self.counts.duplicate += 1
        self.answered_again += self.owed > 0
        self.owed -= self.owed > 0
        if self._contradicts(drive, frame):
            self.lose("sent two different drives for one tick", _FORGED)

    def _take_stop(self, drive: Drive, frame: Frame, *, is_new: bool) -> Drive | None:
        """Handles a drive at rest: normal for a stopped robot, a fault for one that should be running."""
        if self.session is None and not self.rested:
            self.rested = True
            self._accept(frame)
        elif is_new and self.session is not None and self.session.halted:
            self._drive_tick = self.ticks - ((self.sent_tick - drive.tick) & _TICK_MASK)
            self.held_check.take_drive(frame)
            self._accept(frame)
            return drive
        else:
            self.counts.duplicate += 1
            if is_new:
                self.lose("rests, though it was started")
        return None

    def _contradicts(self, drive: Drive, frame: Frame) -> bool:
        """Whether a drive is a different answer to the senses answered last."""
        same = drive.tick == self.drive.tick and counter_of(frame) == counter_of(self._drive_frame)
        return same and frame != self._drive_frame

    def _take_silence(self, drive: Drive, frame: Frame) -> Drive | None:
        """Handles reported silence: in lockstep, only the host was slow; in real time, the robot rests."""
        self.silent = True
        if self.lockstep or self.session is None:
            self.counts.duplicate += 1
            return None
        self._accept(frame)
        return drive

    def _take_other(self, frame: Frame) -> None:
        decoded = self.protocol.decode(frame)
        if decoded is not None and decoded.name == "ANSWER":
            self._take_any_answer(frame, decoded)
        elif decoded is not None and decoded.name in REPORTS:
            self._take_report(frame, decoded)
        elif decoded is None or decoded.name == "DRIVE":
            self._refuse(frame, "damaged or foreign")
        else:
            self._refuse(frame, "of another simulator")
            if self.rivals.hear(frame, self.now()):
                self.lose("is commanded by somebody else too")
            elif self.rivals.poses_as_us(frame, decoded) or self._goes_on(decoded):
                self.lose(f"was told {self.protocol.describe(frame)}", _COMMANDED)

    def _goes_on(self, decoded: DecodedFrame) -> bool:
        """Whether these are foreign senses or distances that the robot takes for those of this simulator."""
        if decoded.name not in {"SENSES", "RANGES"}:
            return False
        ahead = (decoded.signals["tick"] - self.sent_tick) & _TICK_MASK
        return ahead < COUNTERS and (decoded.signals["counter"] - self.sent_counter - ahead) % COUNTERS == 0

    def _take_any_answer(self, frame: Frame, decoded: DecodedFrame) -> DecodedFrame | None:
        arrival = self.asked.judge(frame)
        if arrival == Arrival.OTHER:
            self._refuse(frame, "an answer to what was not asked")
            was_done = decoded.signals["result"] == Result.DONE
            doubt = _COMMANDED if was_done else ""
            self.lose(f"answered what was not asked here: {self.protocol.describe(frame)}", doubt)
            return None
        if arrival == Arrival.AGAIN:
            self.counts.duplicate += 1
            self.answered_again += 1
            return None
        if decoded.signals["result"] == Result.DONE:
            self.held_check.carry_out(self.asked.last, decoded)
        self._accept(frame)
        return decoded

    def _take_report(self, frame: Frame, decoded: DecodedFrame) -> None:
        """Handles a report.

        A whole report that cuts another one short repeats the other's last page of FAULTS, including its counter:
        after the answer, that page counts as requested.
        """
        if decoded.signals.get("silent"):
            self.counts.duplicate += 1
            self.silent = True
            self.check(decoded)
            return
        arrival = self.reports.judge(frame, decoded, self.counts.missing)
        is_asked_for = self.reporting and self.asked.answered and self.reports.is_awaited(decoded)
        if arrival == Arrival.LATE or (arrival == Arrival.AGAIN and not is_asked_for):
            self.counts.duplicate += 1
            return
        if arrival in (Arrival.OTHER, Arrival.ELSEWHERE) and self.session is not None:
            self._refuse(frame, "does not go on from the one before")
            self.lose(f"counts its {decoded.name} anew", _FORGED if arrival == Arrival.OTHER else "")
        if not self.reports.take(decoded):
            self._refuse(frame, "not a memory")
            return
        self._accept(frame)
        self.check(decoded)

    def _refuse(self, frame: Frame, why: str) -> None:
        self.counts.refused += 1
        self.refused, self.refused_at = frame, self.ticks
        self.refuse(frame, why)

    def _accept(self, frame: Frame) -> None:
        self.last = frame
        self.counts.received += 1
        self.record(frame)

    def lose(self, how: str, doubt: str = "", *, booted: bool = False) -> None:
        """Reports that the robot may have left the session, or may not be alone; supervision finds out.

        Args:
            how: The evidence.
            doubt: Why the result is unreliable in any case; empty if it is not.
            booted: Whether the robot reported that it has restarted.
        """
        if self.session is not None:
            raise SessionLostError(f"it {how} (tick {self.tick})", doubt=doubt, booted=booted)


def check_report(inbox: Inbox, report: DecodedFrame) -> None:
    """Checks a new report, or a heartbeat sent in silence, which need not be new.

    Raises:
        SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
        FirmwareError: The robot was built from another layout of the messages.
    """
    if report.name == "HEARTBEAT":
        _check_heartbeat(inbox, report)
        if not report.signals["silent"] and inbox.asked.answered and not is_as_started(inbox):
            inbox.lose("does not run as it was told here")
    elif report.name == "EMERGENCY" and report.signals["kinds"] >> Fault.TWIN & 1:
        inbox.lose("hears another robot with its number")
    elif report.name == "HEALTH" and inbox.asked.answered and not holds(inbox):
        inbox.lose("does not hold what it was told here")
    elif report.name == "BOOT" and not inbox.reporting:
        inbox.lose("started anew", booted=True)


def _check_heartbeat(inbox: Inbox, heartbeat: DecodedFrame) -> None:
    theirs, ours = heartbeat.signals["layout"], inbox.protocol.layout
    if not inbox.protocol.fits(theirs):
        inbox.lose("reports another layout of the messages")
        hashes = f"hash {theirs:04X}, ours {ours:04X}"
        raise FirmwareError(f"the robot was built from another octet.dbc ({hashes}): rebuild it")
    if not heartbeat.signals["state"] and inbox.session is not None and not inbox.session.halted:
        inbox.lose("reports that it is stopped")
    if heartbeat.signals["owner"] not in (0, inbox.owner):
        inbox.lose(f"obeys simulator {heartbeat.signals['owner']}")


def holds(inbox: Inbox) -> bool:
    """Whether the robot's last report shows that it holds exactly the commands and senses sent here."""
    return inbox.held_check.agrees(inbox.reports.held, inbox.reports.memory)


def is_as_started(inbox: Inbox) -> bool:
    """Whether the robot's last heartbeat shows that it runs as it was started here."""
    session, said = inbox.session, inbox.reports.heartbeat
    if session is None or inbox.held_check.given_up:
        return True
    ours = session.profile, int(inbox.lockstep), int(session.frozen)
    return (said["profile"], said["lockstep"], said["frozen"]) == ours
