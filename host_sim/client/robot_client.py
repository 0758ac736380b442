"""A client of one robot: commands and their answers, senses out, drives in, everything recorded."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from host_sim.client.frame_log import FrameLog
from host_sim.errors import RefusedError, RobotError
from host_sim.protocol.codec import DecodedFrame, Frame, Protocol
from host_sim.protocol.generated import CELL_COUNT, CELL_MAX, TICK_SPAN, Opcode, Reason
from host_sim.robot_io import REST, Drive, Senses
from host_sim.transport.link import Link

T = TypeVar("T")

DEADLINE_S = 5.0
"""The robot's time to answer, on the wall clock, before it counts as gone."""

_TICK_MASK = TICK_SPAN - 1
_COUNTER_MASK = 15
_LOOK_ALIVE_S = 0.2
_NO_DRIVE = REST._replace(tick=_TICK_MASK)
_FROM_ROBOT = frozenset({"ANSWER", "MEMORY", "HEARTBEAT", "FAULTS", "HEALTH", "CRASH"})


@dataclass
class FrameCounts:
    """What became of frames.

    Attributes:
        sent: Frames sent to the robot.
        received: Frames taken from it.
        lost: Senses that got no drive in time, and senses that the robot says it missed.
        refused: Frames that came and were damaged, stale or foreign, here or, as it says, at the robot.
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
        log: Gets every frame sent, and every one taken from the robot, in their order.
        lockstep: Whether the robot is to wait for us however long we take (up to 10 s), rather than stop its wheels
            after 100 ms without senses.
        status: Says in a few words how the robot's process is, and raises RobotError if it has ended.
        bus: Where the robot is, by name.
        deadline_s: Wall time for the robot to answer.
        memory: The eight cells, as the robot last said.
        faults: The robot's own fault counters, as it last said.
        frames: What became of the frames.
        last: The last frame taken from the robot.
        recording: Whether what comes from the robot goes into the log.
    """

    link: Link
    protocol: Protocol
    log: FrameLog
    lockstep: bool = True
    status: Callable[[], str] = lambda: "is not ours to watch"
    bus: str = ""
    deadline_s: float = DEADLINE_S
    memory: tuple[int, ...] = (0,) * CELL_COUNT
    faults: dict[str, int] = field(default_factory=dict)
    frames: FrameCounts = field(default_factory=FrameCounts)
    last: Frame | None = None
    recording: bool = True
    _counter: int = 0
    _sent_tick: int = 0
    _drive: Drive = _NO_DRIVE

    @property
    def node(self) -> int:
        """The robot's number on the bus."""
        return self.protocol.node

    def command(self, opcode: str, **signals: int) -> None:
        """Gives one command and waits for its answer.

        Raises:
            RefusedError: The robot refuses it.
            RobotError: It does not answer.
        """
        command = self.send_command(opcode, signals)
        self.log.add(command)
        if self.await_answer(self.deadline_s) is None:
            raise RobotError(f"the robot did not answer {opcode} within {self.deadline_s:g} s; {self.account()}")

    def send_command(self, opcode: str, signals: Mapping[str, int]) -> Frame:
        """Sends a command, waits for nothing and records nothing."""
        self._counter = (self._counter + 1) & _COUNTER_MASK
        fixed = {"counter": self._counter, "opcode": Opcode[opcode.upper()], "lockstep": int(self.lockstep)}
        frame = self.protocol.encode("COMMAND", {**fixed, **signals})
        self.link.send(frame)
        self.frames.sent += 1
        return frame

    def await_answer(self, timeout_s: float) -> Frame | None:
        """The answer to the last command; None if none comes in time.

        Raises:
            RefusedError: The robot refuses the command.
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
        """The next message of that name, which the robot sends after a command.

        Raises:
            RobotError: It sends none.
        """
        decoded = self.receive(name, self.deadline_s)
        if decoded is None:
            raise RobotError(f"the robot sent no {name} after {after}; {self.account()}")
        return decoded

    def send_senses(self, senses: Senses) -> None:
        """Sends the senses of one tick."""
        frame = self.protocol.encode_senses(senses)
        self._sent_tick = senses.tick
        self.link.send(frame)
        self.frames.sent += 1
        self.log.add(frame)  # while the robot thinks

    def receive_drive(self, timeout_s: float) -> Drive | None:
        """The next fresh drive, or None if none comes in time; 0 polls. Anything else that comes is accepted too.

        Raises:
            RobotError: The robot is gone.
        """
        wait_s = min(timeout_s, _LOOK_ALIVE_S)
        frame = self.link.receive(wait_s)
        drive = None if frame is None else self._accept_drive(frame)
        if drive is not None or timeout_s == 0.0:
            return drive
        return self._receive(self._accept_drive, timeout_s - wait_s if frame is None else timeout_s)

    def receive(self, name: str, timeout_s: float) -> DecodedFrame | None:
        """The next message of that name, or None if none comes in time. Anything else that comes is accepted too.

        Args:
            name: The message, any but DRIVE.
            timeout_s: How long to wait; 0 polls.

        Raises:
            RobotError: The robot is gone.
        """

        def accept(frame: Frame) -> DecodedFrame | None:
            decoded = self._accept_report(frame)
            return decoded if decoded is not None and decoded.name == name else None

        return self._receive(accept, timeout_s)

    def late(self, tick: int) -> RobotError:
        """The fault that a drive did not come by the deadline, with all that is known."""
        return RobotError(f"the robot did not answer tick {tick} within {self.deadline_s:g} s; {self.account()}")

    def account(self) -> str:
        """For messages: the last frame from the robot, and how its process is."""
        last = "none" if self.last is None else self.protocol.describe(self.last)
        return f"last frame from it: {last}; it {self.status()}"

    def _receive(self, accept: Callable[[Frame], T | None], timeout_s: float) -> T | None:
        """Takes what comes until it is what is waited for, or time is up."""
        give_up = None
        wait_s = timeout_s
        while True:
            frame = self.link.receive(min(wait_s, _LOOK_ALIVE_S))
            if frame is None:
                self.status()
            elif (found := accept(frame)) is not None:
                return found
            # The clock is asked only now: most often the first frame is the one, and there are kernels where asking
            # takes longer than all the rest.
            now = time.monotonic()
            if give_up is None:
                give_up = now + timeout_s - (min(wait_s, _LOOK_ALIVE_S) if frame is None else 0.0)
            wait_s = give_up - now
            if wait_s <= 0.0:
                return None

    def _accept_drive(self, frame: Frame) -> Drive | None:
        """A drive that answers senses which were sent and not answered yet. None for any other frame."""
        drive = self.protocol.decode_drive(frame)
        if drive is None:
            self._accept_report(frame)
            return None
        ahead = (drive.tick - self._drive.tick) & _TICK_MASK
        # A robot that hears nothing stops its wheels, and says so with the tick that it last heard.
        rests = ahead == 0 and drive.reason == Reason.STOP and not self.lockstep
        if not rests and not 0 < ahead <= (self._sent_tick - self._drive.tick) & _TICK_MASK:
            self.frames.refused += 1
            return None
        self._drive, self.last = drive, frame
        self.frames.received += 1
        if self.recording:
            self.log.add(frame)
        return drive

    def _accept_report(self, frame: Frame) -> DecodedFrame | None:
        """What the robot says of itself, noted; None for what is not from it, is damaged, or is no memory."""
        decoded = self.protocol.decode(frame)
        if decoded is not None and decoded.name == "DRIVE":
            self._accept_drive(frame)
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
        """Keeps faults and memory. False: these eight bytes are no memory."""
        if decoded.name == "FAULTS":
            self.faults = dict(decoded.signals)
        if decoded.name == "MEMORY":
            cells = tuple(decoded.signals.values())
            if any(cell > most for cell, most in zip(cells, CELL_MAX, strict=True)):
                return False
            self.memory = cells
        return True
