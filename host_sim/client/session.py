"""A conversation with one robot: commands and their answers, senses out, drives in, everything recorded."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from host_sim.client.frame_log import Recorder
from host_sim.errors import RefusedError, RobotError
from host_sim.protocol.codec import DecodedFrame, Frame, Protocol
from host_sim.robot_io import Drive, Senses
from host_sim.transport.link import Link

DEADLINE_S = 5.0
"""The robot's time to answer, on the wall's clock, before it counts as gone."""

_TICK_MASK = 4095
_COUNTER_MASK = 15
_CELL_MAX = 2
_LOOK_ALIVE_S = 0.2
_FROM_ROBOT = frozenset({"ANSWER", "MEMORY", "HEARTBEAT", "FAULTS", "HEALTH", "CRASH"})
_A_DRIVE = DecodedFrame("DRIVE", {})
_NO_DRIVE = Drive(_TICK_MASK, 0, 0, 0, 0, 0, False)


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
class Session:
    """Talks to one robot over a link.

    Attributes:
        link: Carries the frames.
        protocol: Encodes and decodes them.
        recorder: Gets every frame sent, and every one taken from the robot, in their order.
        lockstep: Whether the robot is to wait for us however long we take (up to 10 s), rather than stop its wheels
            after 100 ms without senses.
        status: Tells in a few words how the robot's process is, and raises RobotError if it has ended.
        bus: Where the robot is, by name.
        deadline_s: Wall time for the robot to answer.
        memory: The eight cells, as the robot last said.
        faults: The robot's own fault counters, as it last said.
        frames: What became of the frames.
    """

    link: Link
    protocol: Protocol
    recorder: Recorder
    lockstep: bool = True
    status: Callable[[], str] = lambda: "is not ours to watch"
    bus: str = ""
    deadline_s: float = DEADLINE_S
    memory: tuple[int, ...] = (0,) * 8
    faults: dict[str, int] = field(default_factory=dict)
    frames: FrameCounts = field(default_factory=FrameCounts)
    _counter: int = 0
    _sent_tick: int = 0
    _drive: Drive = _NO_DRIVE
    _last: Frame | None = None

    def handshake(self, patience_s: float, again_s: float | None = None) -> None:
        """Stops the robot and gets to know it; the record begins with this.

        Args:
            patience_s: Wall time to wait for it.
            again_s: Wall time after which to try again, for a robot that may not be there yet. None for one that is
                known to listen: it is asked once, so that the record is the same however long it takes.

        Raises:
            RobotError: None answers, or one that was built from another protocol file.
        """
        give_up = time.monotonic() + patience_s
        while True:
            order = self._order("stop", {})
            self._send(order)
            answer = self._await_answer(again_s or patience_s, record=False)
            if answer is not None:
                break
            if time.monotonic() >= give_up:
                who = f"no robot of node {self.protocol.node}"
                raise RobotError(f"{who} answered for {patience_s:g} s; {self._story()}")
        self._check_hash(self._await("HEARTBEAT", "stop", record=False))
        assert self._last is not None
        for frame in (order, answer, self._last):
            self.recorder.add(frame)
        self._await("MEMORY", "stop")

    def start(self, seed: int, profile: int, settings: Mapping[str, int], memory: Sequence[int] | None) -> None:
        """Sets the robot going: it moves with the next senses.

        Args:
            seed: 0..2**32 - 1, of its random turns.
            profile: Number of its profile.
            settings: Parameters to set, by name.
            memory: Eight cells to write first; None leaves the robot its own.

        Raises:
            RefusedError: It refuses something.
            RobotError: It does not answer.
        """
        self.command("start", profile=profile, seed=seed)
        for name, value in settings.items():
            self.command("set", parameter=self.protocol.choices("COMMAND", "parameter")[name], value=value)
        if memory is not None:
            self.rewrite("write", mask=255, cells=sum(cell << 2 * p for p, cell in enumerate(memory)))

    def stop(self) -> None:
        """Brings the wheels to rest and takes the robot's last report."""
        self.command("stop")
        self._await("MEMORY", "stop")

    def command(self, opcode: str, **signals: int) -> None:
        """Gives one command and waits for its answer.

        Raises:
            RefusedError: The robot refuses it.
            RobotError: It does not answer.
        """
        order = self._order(opcode, signals)
        self.recorder.add(order)
        self._send(order)
        if self._await_answer(self.deadline_s, record=True) is None:
            raise RobotError(f"the robot did not answer {opcode} within {self.deadline_s:g} s; {self._story()}")

    def rewrite(self, opcode: str, **signals: int) -> None:
        """Gives a command that changes the memory, `write` or `erase`, and waits for the memory that it leaves.

        Raises:
            RefusedError: The robot refuses it.
            RobotError: It does not answer.
        """
        self.command(opcode, **signals)
        self._await("MEMORY", opcode)

    def send_senses(self, senses: Senses) -> None:
        """Sends the senses of one tick."""
        frame = self.protocol.encode_senses(senses)
        self._sent_tick = senses.tick
        self._send(frame)
        self.recorder.add(frame)  # while the robot thinks

    def receive_drive(self, timeout_s: float) -> Drive | None:
        """The next fresh drive, or None if none comes in time; 0 just looks. Anything else that comes is taken too.

        Raises:
            RobotError: The robot is gone.
        """
        return None if self._receive("DRIVE", timeout_s) is None else self._drive

    def late(self, tick: int) -> RobotError:
        """The fault that a drive did not come by the deadline, with all that is known."""
        return RobotError(f"the robot did not answer tick {tick} within {self.deadline_s:g} s; {self._story()}")

    def _order(self, opcode: str, signals: Mapping[str, int]) -> Frame:
        self._counter = (self._counter + 1) & _COUNTER_MASK
        number = self.protocol.choices("COMMAND", "opcode")[opcode]
        fixed = {"counter": self._counter, "opcode": number, "lockstep": int(self.lockstep)}
        return self.protocol.encode("COMMAND", {**fixed, **signals})

    def _send(self, frame: Frame) -> None:
        self.link.send(frame)
        self.frames.sent += 1

    def _await_answer(self, timeout_s: float, *, record: bool) -> Frame | None:
        """The answer to the last command; None if none comes in time."""
        give_up = time.monotonic() + timeout_s
        while (said := self._receive("ANSWER", give_up - time.monotonic(), record=record)) is not None:
            if said.signals["counter"] != self._counter:
                continue
            if said.signals["result"] != 0:
                assert self._last is not None
                raise RefusedError(f"the robot refused a command: {self.protocol.describe(self._last)}")
            return self._last
        return None

    def _await(self, name: str, opcode: str, *, record: bool = True) -> DecodedFrame:
        said = self._receive(name, self.deadline_s, record=record)
        if said is None:
            raise RobotError(f"the robot sent no {name} after {opcode}; {self._story()}")
        return said

    def _check_hash(self, heartbeat: DecodedFrame) -> None:
        theirs = heartbeat.signals["dbc_hash"]
        if not self.protocol.fits(theirs):
            hashes = f"hash {theirs:04X}, ours {self.protocol.dbc_hash:04X}"
            raise RobotError(f"the robot was built from another octet.dbc ({hashes}): rebuild it")

    def _receive(self, name: str, timeout_s: float, *, record: bool = True) -> DecodedFrame | None:
        """Takes what comes until a message of that name does."""
        give_up = None
        wait_s = timeout_s
        while True:
            frame = self.link.receive(min(wait_s, _LOOK_ALIVE_S))
            said = None if frame is None else self._accept(frame, record)
            if said is not None and said.name == name:
                return said
            if frame is None:
                self.status()
            # The clock is asked only now: most often the first frame is the one, and there are kernels where asking
            # takes longer than all the rest.
            now = time.monotonic()
            if give_up is None:
                give_up = now + timeout_s - (min(wait_s, _LOOK_ALIVE_S) if frame is None else 0.0)
            wait_s = give_up - now
            if wait_s <= 0.0:
                return None

    def _accept(self, frame: Frame, record: bool) -> DecodedFrame | None:
        said = self._accept_drive(frame) or self._accept_other(frame)
        if said is None:
            self.frames.refused += 1
            return None
        self._last = frame
        self.frames.received += 1
        if record:
            self.recorder.add(frame)
        return said

    def _accept_drive(self, frame: Frame) -> DecodedFrame | None:
        """A fresh drive is noted; None for one that came twice or too late, and for any other frame."""
        drive = self.protocol.decode_drive(frame)
        if drive is None:
            return None
        ahead = (drive.tick - self._drive.tick) & _TICK_MASK
        # A robot that hears nothing stops its wheels, and says so with the tick that it last heard.
        rests = ahead == 0 and drive.reason == 0 and not self.lockstep
        if not rests and not 0 < ahead <= (self._sent_tick - self._drive.tick) & _TICK_MASK:
            return None
        self._drive = drive
        return _A_DRIVE

    def _accept_other(self, frame: Frame) -> DecodedFrame | None:
        """Notes what the robot says of itself; None for what is not from it, or is no memory."""
        said = self.protocol.decode(frame)
        if said is None or said.name not in _FROM_ROBOT:
            return None
        if said.name == "FAULTS":
            self.faults = dict(said.signals)
        if said.name == "MEMORY":
            cells = tuple(said.signals.values())
            if cells[0] or max(cells) > _CELL_MAX:
                return None
            self.memory = cells
        return said

    def _story(self) -> str:
        last = "none" if self._last is None else self.protocol.describe(self._last)
        return f"last frame from it: {last}; it {self.status()}"
