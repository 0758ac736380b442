"""Compares a recorded log with the current firmware."""

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, TypeAlias

from host_sim.base.errors import UsageError
from host_sim.protocol.codec import MEMORY_IDS, DecodedFrame, Frame, MemoryReport, Protocol, node_of
from host_sim.protocol.generated import Fault, Opcode, Reason
from host_sim.recording.log_reader import LogReader, Recorded, check_protocol, first_memory
from host_sim.sim.in_process_link import InProcessLink, Program

if TYPE_CHECKING:
    from host_sim.sim.own_brain import OwnBrain

_TO_ROBOT = ("SENSES", "COMMAND")
_AT_REST = (Reason.STOP, Reason.SILENCE)
_SILENT = 1 << Fault.SILENCE
_NEAR = 10
"""A loss within a gap is assumed to begin and end within this many of its first and last senses."""

_STATES_MAX = 256
"""Maximum number of states of the robot to track, given the frames that it may have received."""


@dataclass(frozen=True)
class Difference:
    """The first drive or memory that differs between log and firmware.

    Attributes:
        time_us: Robot time, us.
        recorded: The frame in the log; None if there is none.
        replayed: The frame of the current firmware; None if it sends none.
    """

    time_us: int
    recorded: Frame | None
    replayed: Frame | None


@dataclass(frozen=True)
class Replay:
    """The result of a replay.

    Attributes:
        drives: Number of equal drives.
        difference: The first difference; None if there is none.
        stopped: Whether the log contains the end of the run.
        unanswered: Number of senses that were sent in real time and never answered.
    """

    drives: int
    difference: Difference | None
    stopped: bool = True
    unanswered: int = 0


def replay(log: LogReader, protocol: Protocol, own: "OwnBrain | Program | None" = None) -> Replay:
    """Feeds the frames sent to one robot in a log to the firmware, and compares drives and memories.

    The firmware has its own brain, or a behaviour in a file of its user.

    Raises:
        UsageError: The log is of another protocol, has no heartbeat of this node, or holds a damaged frame.
    """
    check_protocol(log, protocol)
    comparison = Comparison(log, protocol, own)
    for line in log:
        if line.frame.id in MEMORY_IDS and line.frame.id != protocol.id_of("MEMORY"):
            comparison.feed(line.frame)  # another robot's memory
        elif node_of(line.frame.id) == protocol.node and (difference := comparison.accept(line)):
            return Replay(comparison.drives, difference, unanswered=comparison.unanswered)
    difference = comparison.end() if comparison.stopped else None  # a log that was cut off has no last answer
    return Replay(comparison.drives, difference, comparison.stopped, comparison.unanswered)


_Path: TypeAlias = "tuple[_Path, list[Frame | None]] | None"
"""How a state was reached: from which one, and by which frames; None in these is silence."""


class Comparison:
    """Follows one robot's part of a log with the firmware.

    Attributes:
        drives: Number of equal drives so far.
        stopped: Whether the last command so far was to stop.
        unanswered: Number of senses so far that were sent in real time and not answered.
    """

    def __init__(self, log: LogReader, protocol: Protocol, own: "OwnBrain | Program | None") -> None:
        self.drives = 0
        self.stopped = False
        self.unanswered = 0
        self._log, self._protocol = log, protocol
        node, memory = protocol.node, first_memory(log, protocol)
        self._link = own.robot(node, memory) if own else InProcessLink(node, memory)
        self._states: dict[bytes, _Path] = {}  # possible states of the robot; empty: the link's state
        self._waiting: list[Frame] = []
        self._faults = 0
        self._pending: dict[int, Frame] = {}
        self._lockstep, self._time_us = True, 0
        self._sent: Frame | None = None
        self._drive: Frame | None = None
        self._recorded, self._replayed = MemoryReport(), MemoryReport()
        self._memory: tuple[int, ...] | None = None

    def accept(self, line: Recorded) -> Difference | None:
        """Compares one frame of the log; None if it matches the firmware's."""
        self._time_us, frame = line
        decoded = self._protocol.decode(frame)
        if decoded is None:
            time_s = self._time_us / 1e6
            raise UsageError(f"{self._log.path}: damaged frame at {time_s:.2f} s: {self._protocol.describe(frame)}")
        if decoded.name == "RANGES":
            self.feed(frame)
            return None
        if decoded.name in _TO_ROBOT:
            opcode = decoded.signals.get("opcode")
            # Frames lost on a bus are sent and answered again. Reports are requested in the middle of a tick.
            difference = self.end() if frame != self._sent and opcode != Opcode.REPORT else None
            self._sent = frame if opcode != Opcode.REPORT else self._sent
            self.stopped = opcode == Opcode.STOP or (self.stopped and opcode == Opcode.REPORT)
            self._lockstep = bool(decoded.signals.get("lockstep", self._lockstep))
            self.feed(frame)
            return difference
        if decoded.name == "EMERGENCY":
            self._faults |= decoded.signals["kinds"]
        if decoded.name == "DRIVE":
            return self._compare_drive(frame, decoded)
        return self._compare_memory(frame, decoded) if decoded.name == "MEMORY" else None

    def end(self) -> Difference | None:
        """The firmware's drive that is missing from the log, if any."""
        if not self._pending or not self._lockstep:
            return None
        return Difference(self._time_us, None, self._pending.popitem()[1])

    def feed(self, frame: Frame) -> None:
        """Feeds a frame to the firmware; in real time, it waits for the next drive."""
        if not self._lockstep:
            self._waiting.append(frame)
            return
        self._states = {}
        self._hand_over(frame)

    def heard(self) -> list[Frame | None]:
        """In real time: the frames since the last state that is certain, as the robot may have received them."""
        ways: list[list[Frame | None]] = []
        path = next(iter(self._states.values()), None)
        while path is not None:
            path, way = path
            ways.append(way)
        return [frame for way in reversed(ways) for frame in way] + list(self._waiting)

    def _hand_over(self, frame: Frame | None) -> None:
        if frame is None:
            self._link.lose_touch()
            return
        self._link.send(frame)
        for answer in self._link.taken():
            decoded = self._protocol.decode(answer)
            if decoded is None:
                continue
            if decoded.name == "DRIVE" and decoded.signals["reason"] != Reason.STOP:
                self._pending[decoded.signals["tick"]] = answer
            elif decoded.name == "MEMORY":
                self._memory = self._replayed.join(decoded) or self._memory

    def _compare_drive(self, frame: Frame, decoded: DecodedFrame) -> Difference | None:
        reason, tick = decoded.signals["reason"], decoded.signals["tick"]
        if reason in _AT_REST and not self._lockstep:
            self._faults |= _SILENT if reason == Reason.SILENCE else 0
            return None  # a robot on its own clock reports silence; no time passes here
        answer = self._pending.pop(tick, None) if self._lockstep else self._answer_in_real_time(frame, tick)
        if answer is None and reason == Reason.STOP:
            return None  # a stopped robot rests; stop is repeated until all reports have arrived
        if answer is None and frame == self._drive:
            return None
        self._drive = frame
        self.drives += answer == frame
        return None if answer == frame else Difference(self._time_us, frame, answer)

    def _answer_in_real_time(self, drive: Frame, tick: int) -> Frame | None:
        """The recorded drive, if the loss of some unanswered senses explains it; else another answer of the firmware.

        Often several losses do. All of them are kept, and later drives rule out the wrong ones.
        """
        numbers = [self._tick_of(frame) for frame in self._waiting]
        end = numbers.index(tick) + 1 if tick in numbers else len(numbers)  # the host may have continued meanwhile
        sent = self._waiting[:end]
        senses = [i for i, number in enumerate(numbers[:end]) if number is not None]
        self.unanswered += len(senses[:-1])
        answers: list[Frame | None] = []
        equal: dict[bytes, _Path] = {}
        self._states = self._states or {self._link.state: None}
        for state, heard in product(self._states, self._ways(sent, senses)):
            self._link.go_back_to(state)
            for frame in heard:
                self._hand_over(frame)
            answers.append(self._pending.pop(tick, None))
            if answers[-1] == drive:
                equal.setdefault(self._link.state, (self._states[state], heard))
                if len(equal) == _STATES_MAX:
                    break
        if not equal:
            return answers[0]
        self._states, self._waiting, self._faults = equal, self._waiting[end:], 0
        return drive

    def _ways(self, sent: list[Frame], senses: list[int]) -> list[list[Frame | None]]:
        """Possible sequences of frames that the robot received since its last drive; None in them is silence.

        The log has all senses that were sent. Of the unanswered ones, a robot receives the first ones, if any, and
        the last ones: the others are lost, or wait for so long that the robot skips to the newest.

        Args:
            sent: Senses and commands; commands always arrive.
            senses: Indices of the senses in `sent`.
        """
        count = len(senses)
        near = [i for i in range(count) if i < _NEAR or i >= count - _NEAR]
        outages: list[list[Frame | None]] = [[None], []] if self._faults & _SILENT else [[]]
        ways: list[list[Frame | None]] = []
        for outage, lost, again in product(outages, near, near):
            if lost < again or (lost == again and (outage or lost == count - 1)):
                unheard, at = set(senses[lost:again]), senses[again]
                before = [frame for i, frame in enumerate(sent[:at]) if i not in unheard]
                ways.append([*before, *outage, *sent[at:]])
        return ways or [list(sent)]

    def _tick_of(self, frame: Frame) -> int | None:
        """The tick of a SENSES frame; None for other frames."""
        decoded = self._protocol.decode(frame) if frame.id == self._protocol.id_of("SENSES") else None
        return decoded and decoded.signals["tick"]

    def _compare_memory(self, frame: Frame, decoded: DecodedFrame) -> Difference | None:
        recorded = self._recorded.join(decoded)
        if recorded is None or self._memory is None or recorded == self._memory or not self._lockstep:
            return None
        cells = {f"cell_{i}": cell for i, cell in enumerate(self._memory)}
        return Difference(self._time_us, frame, self._protocol.encode("MEMORY", decoded.signals | cells))


def report(outcome: Replay, name: str, protocol: Protocol) -> str:
    """The outcome as text, beginning with the name of the log."""
    if outcome.difference is None:
        ending = "" if outcome.stopped else "; the log ends before the run does"
        return f"{name}: {outcome.drives} drives, no difference{ending}"
    difference = outcome.difference
    lines = [
        f"{name}: differs after {outcome.drives} equal drives, at {difference.time_us / 1e6:.2f} s of robot time",
        f"  recorded  {_described(difference.recorded, protocol)}",
        f"  replayed  {_described(difference.replayed, protocol)}",
    ]
    if outcome.unanswered:
        lines.append(
            f"  {outcome.unanswered} senses before it were not answered. The log does not tell which of them the "
            "robot heard, so that the firmware may be the same"
        )
    return "\n".join(lines)


def _described(frame: Frame | None, protocol: Protocol) -> str:
    return "nothing" if frame is None else protocol.describe(frame)
