"""A client for one robot: sends commands and senses, receives answers and drives, and logs every frame."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from host_sim.client.frame_log import FrameLog
from host_sim.errors import RefusedError, RobotError
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, Protocol
from host_sim.protocol.generated import CELL_COUNT, TICK_SPAN, MemoryKind, Opcode, Reason
from host_sim.protocol.memory_kinds import kinds_of
from host_sim.protocol.memory_report import MemoryReport
from host_sim.robot_io import REST, Drive, Senses
from host_sim.transport.link import Link

T = TypeVar("T")

DEADLINE_S = 5.0
"""Time for the robot to answer before it is given up, s of wall-clock time."""

_TICK_MASK = TICK_SPAN - 1
_LOOK_ALIVE_S = 0.2
_NO_DRIVE = REST._replace(tick=_TICK_MASK)
_FROM_ROBOT = frozenset({"ANSWER", "EMERGENCY", "MEMORY", "HEARTBEAT", "BOOT", "FAULTS", "HEALTH", "CRASH"})


@dataclass
class FrameCounts:
    """Frame counters of a client; `summary.frame_counts` adds those that the robot reports.

    Attributes:
        sent: Number of frames sent to the robot.
        received: Number of valid frames received from it.
        lost: Number of senses that were not answered in time.
        refused: Number of frames that were damaged, stale or foreign.
    """

    sent: int = 0
    received: int = 0
    lost: int = 0
    refused: int = 0


@dataclass
class RobotClient:
    """Talks to one robot over a link.

    Attributes:
        link: Carries the frames.
        protocol: Encodes and decodes them.
        log: Records every frame sent and every valid frame received, in order.
        lockstep: Whether the simulator's clock counts: the robot waits for senses as long as they take.
        owner: Number of this simulator, 1..255, by which the robot knows whom it obeys.
        status: Describes the state of the robot's process, and raises RobotError if it has ended.
        bus: Name of the bus that the robot is on.
        deadline_s: Time for the robot to answer, s of wall-clock time.
        memory: The eight bytes, as last reported by the robot.
        memory_kind: What they mean to the behaviour with which it was started.
        faults: The robot's fault counters, as last reported by it.
        frames: Frame counters.
        last: The last valid frame received from the robot.
        recording: Whether received frames are logged.
        senses_counter: Alive counter of the last SENSES.
    """

    link: Link
    protocol: Protocol
    log: FrameLog
    lockstep: bool = True
    owner: int = 1
    status: Callable[[], str] = lambda: "was not started here"
    bus: str = ""
    deadline_s: float = DEADLINE_S
    memory: tuple[int, ...] = (0,) * CELL_COUNT
    memory_kind: MemoryKind = MemoryKind.SIDES
    faults: dict[str, int] = field(default_factory=dict)
    frames: FrameCounts = field(default_factory=FrameCounts)
    last: Frame | None = None
    recording: bool = True
    senses_counter: int = COUNTERS - 1
    _counter: int = 0
    _sent_tick: int = 0
    _report: MemoryReport = field(default_factory=MemoryReport)
    _drive: Drive = _NO_DRIVE

    @property
    def node(self) -> int:
        """The robot's node number on the bus."""
        return self.protocol.node

    def command(self, opcode: str, **signals: int) -> None:
        """Sends a command and waits for its answer.

        Args:
            opcode: Name of the command.
            **signals: The command's signals, by name.

        Raises:
            RefusedError: The robot refuses the command.
            RobotError: The robot does not answer.
        """
        command = self.send_command(opcode, signals)
        self.log.add(command)
        if self.await_answer(self.deadline_s) is None:
            raise RobotError(f"the robot did not answer {opcode} within {self.deadline_s:g} s; {self.account()}")

    def send_command(self, opcode: str, signals: Mapping[str, int]) -> Frame:
        """Sends a command without waiting for its answer, and without logging it."""
        self._counter = (self._counter + 1) % COUNTERS
        fixed = {"counter": self._counter, "opcode": Opcode[opcode.upper()], "owner": self.owner}
        frame = self.protocol.encode("COMMAND", {**fixed, **signals})
        self.link.send(frame)
        self.frames.sent += 1
        return frame

    def await_answer(self, timeout_s: float) -> Frame | None:
        """The answer to the last command, or None after `timeout_s`.

        Raises:
            RefusedError: The robot refuses the command.
            RobotError: The robot has ended.
        """
        give_up = time.monotonic() + timeout_s
        while (answer := self.receive("ANSWER", give_up - time.monotonic())) is not None:
            if answer.signals["counter"] != self._counter:
                continue
            if answer.signals["result"] != 0:
                assert self.last is not None
                raise RefusedError(f"the robot refused a command: {self.protocol.describe(self.last)}")
            return self.last
        return None

    def expect(self, name: str, after: str) -> DecodedFrame:
        """The next message of a kind that the robot sends after a command.

        Args:
            name: Name of the message.
            after: The command, for the error message.

        Raises:
            RobotError: The robot does not send it.
        """
        decoded = self.receive(name, self.deadline_s)
        if decoded is None:
            raise RobotError(f"the robot sent no {name} after {after}; {self.account()}")
        return decoded

    def send_senses(self, senses: Senses) -> None:
        """Sends the senses of one tick, and logs them."""
        self.senses_counter = (self.senses_counter + 1) % COUNTERS
        frame = self.protocol.encode_senses(senses, self.senses_counter)
        self._sent_tick = senses.tick
        self.link.send(frame)
        self.frames.sent += 1
        self.log.add(frame)  # while the robot thinks

    def receive_drive(self, timeout_s: float) -> Drive | None:
        """The next fresh drive, or None after `timeout_s`; 0 polls. Other messages are accepted too.

        Raises:
            RobotError: The robot has ended.
        """
        wait_s = min(timeout_s, _LOOK_ALIVE_S)
        frame = self.link.receive(wait_s)
        drive = None if frame is None else self._accept_drive(frame)
        if drive is not None or timeout_s == 0.0:
            return drive
        return self._receive(self._accept_drive, timeout_s - wait_s if frame is None else timeout_s)

    def receive(self, name: str, timeout_s: float) -> DecodedFrame | None:
        """The next message of a kind, or None after `timeout_s`. Other messages are accepted too.

        Args:
            name: Name of the message, any but DRIVE.
            timeout_s: Time to wait, s; 0 polls.

        Raises:
            RobotError: The robot has ended.
        """

        def accept(frame: Frame) -> DecodedFrame | None:
            decoded = self._accept_report(frame)
            return decoded if decoded is not None and decoded.name == name else None

        return self._receive(accept, timeout_s)

    def catch_up(self, ticks: int, drive: Drive, frame: Frame, received: int) -> None:
        """Takes over ticks whose frames were exchanged and logged elsewhere.

        Args:
            ticks: Number of ticks.
            drive: The robot's last drive.
            frame: Its frame.
            received: Number of frames received from the robot.
        """
        self._sent_tick, self._drive, self.last = drive.tick, drive, frame
        self.frames.sent += ticks
        self.frames.received += received

    def take_reports(self, reports: Sequence[Frame]) -> None:
        """Takes over reports of the robot that came in such ticks, in order."""
        for frame in reports:
            decoded = self.protocol.decode(frame)
            if decoded is not None:
                self._note(decoded)

    def late(self, tick: int) -> RobotError:
        """The error for a drive that did not come by the deadline."""
        return RobotError(f"the robot did not answer tick {tick} within {self.deadline_s:g} s; {self.account()}")

    def account(self) -> str:
        """The last frame from the robot and the state of its process, for error messages."""
        last = "none" if self.last is None else self.protocol.describe(self.last)
        return f"last frame from it: {last}; it {self.status()}"

    def _receive(self, accept: Callable[[Frame], T | None], timeout_s: float) -> T | None:
        """Receives frames until one is accepted, or until the timeout."""
        give_up = None
        wait_s = timeout_s
        while True:
            frame = self.link.receive(min(wait_s, _LOOK_ALIVE_S))
            if frame is None:
                self.status()
            elif (result := accept(frame)) is not None:
                return result
            # The clock is read only now: usually the first frame is accepted, and on some kernels reading the clock
            # takes longer than everything else.
            now = time.monotonic()
            if give_up is None:
                give_up = now + timeout_s - (min(wait_s, _LOOK_ALIVE_S) if frame is None else 0.0)
            wait_s = give_up - now
            if wait_s <= 0.0:
                return None

    def _accept_drive(self, frame: Frame) -> Drive | None:
        """The drive in a frame, if it answers senses that were not answered yet; None for any other frame."""
        drive = self.protocol.decode_drive(frame)
        if drive is None:
            self._accept_report(frame)
            return None
        if drive.reason == Reason.SILENCE:
            return self._accept_rest(drive, frame)
        ahead = (drive.tick - self._drive.tick) & _TICK_MASK
        if drive.reason == Reason.STOP or not 0 < ahead <= (self._sent_tick - self._drive.tick) & _TICK_MASK:
            self.frames.refused += 1
            return None
        self._drive, self.last = drive, frame
        self.frames.received += 1
        if self.recording:
            self.log.add(frame)
        return drive

    def _accept_rest(self, drive: Drive, frame: Frame) -> Drive | None:
        """A robot that hears no senses says that its wheels rest; in lockstep, that only tells of a slow host."""
        if self.lockstep:
            return None
        self.last = frame
        self.frames.received += 1
        if self.recording:
            self.log.add(frame)
        return drive

    def await_rest(self, after: str) -> None:
        """Waits for the DRIVE at rest that ends the answer to a stop, and logs it.

        Raises:
            RobotError: It does not come.
        """

        def accept(frame: Frame) -> Drive | None:
            drive = self.protocol.decode_drive(frame)
            if drive is None:
                self._accept_report(frame)
            if drive is None or drive.reason != Reason.STOP:
                return None
            self.last = frame
            self.frames.received += 1
            self.log.add(frame)
            return drive

        if self._receive(accept, self.deadline_s) is None:
            raise RobotError(f"the robot sent no DRIVE after {after}; {self.account()}")

    def _accept_report(self, frame: Frame) -> DecodedFrame | None:
        """The report in a frame; None if the frame is damaged, not from the robot, or holds an invalid memory."""
        decoded = self.protocol.decode(frame)
        if decoded is not None and decoded.name == "DRIVE":
            self._accept_drive(frame)
            return None
        if decoded is not None and decoded.signals.get("silent") and self.lockstep:
            return None
        if decoded is None or decoded.name not in _FROM_ROBOT or not self._note(decoded):
            self.frames.refused += 1
            return None
        self.last = frame
        self.frames.received += 1
        if self.recording:
            self.log.add(frame)
        return decoded

    def _note(self, decoded: DecodedFrame) -> bool:
        """Stores the faults or the memory in a report; False if the memory is invalid."""
        if decoded.name == "FAULTS":
            counters = (signal for signal in decoded.signals.items() if signal[0] not in ("crc", "counter", "page"))
            self.faults = self.faults | dict(counters)
        if decoded.name == "MEMORY":
            cells = self._report.join(decoded)
            if cells is not None and not kinds_of(cells):
                return False
            self.memory = cells or self.memory
        return True
