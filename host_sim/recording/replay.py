"""Compares a recorded log with the current firmware."""

from dataclasses import dataclass

from host_sim.backends.in_process_link import InProcessLink
from host_sim.backends.programmed_robot import ProgrammedLink
from host_sim.base.errors import UsageError
from host_sim.protocol.codec import MEMORY_IDS, DecodedFrame, Frame, Protocol, node_of
from host_sim.protocol.generated import Opcode, Reason
from host_sim.protocol.memory_report import MemoryReport
from host_sim.recording.log_reader import LogReader, Recorded, check_protocol, first_memory

_TO_ROBOT = ("SENSES", "COMMAND")
_AT_REST = (Reason.STOP, Reason.SILENCE)


@dataclass(frozen=True)
class Difference:
    """The first drive or memory that differs between log and firmware.

    Attributes:
        time_us: Robot time, us.
        recorded: The frame in the log; None if the log has none.
        replayed: That of the current firmware; None if it sends none.
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
        stopped: Whether the log has the end of the run.
    """

    drives: int
    difference: Difference | None
    stopped: bool = True


def replay(log: LogReader, protocol: Protocol, program: bytes | None = None) -> Replay:
    """Feeds what one robot has heard, by a log, to the firmware, and compares drives and memories.

    Args:
        log: The log.
        protocol: The protocol of the robot's node.
        program: The program that was its brain; None for the firmware's own.

    Raises:
        UsageError: The log is of another protocol, has no heartbeat of this node, or holds a damaged frame.
    """
    check_protocol(log, protocol)
    comparison = _Comparison(log, protocol, program)
    for line in log:
        if line.frame.id in MEMORY_IDS and line.frame.id != protocol.id_of("MEMORY"):
            comparison.overhear(line.frame)
        elif node_of(line.frame.id) == protocol.node and (difference := comparison.accept(line)):
            return Replay(comparison.drives, difference)
    difference = comparison.end() if comparison.stopped else None  # a log that was cut off has no last answer
    return Replay(comparison.drives, difference, comparison.stopped)


class _Comparison:
    """Follows one robot's part of a log with the firmware.

    Attributes:
        drives: Number of equal drives so far.
        stopped: Whether the last command so far was to stop.
    """

    def __init__(self, log: LogReader, protocol: Protocol, program: bytes | None) -> None:
        self.drives = 0
        self.stopped = False
        self._log, self._protocol = log, protocol
        node, memory = protocol.node, first_memory(log, protocol)
        self._link = InProcessLink(node, memory) if program is None else ProgrammedLink(program, node, memory=memory)
        self._pending: dict[int, Frame] = {}
        self._lockstep, self._time_us = True, 0
        self._sent: Frame | None = None
        self._drive: Frame | None = None
        self._recorded, self._replayed = MemoryReport(), MemoryReport()
        self._memory: tuple[int, ...] | None = None

    def accept(self, line: Recorded) -> Difference | None:
        """Compares one frame of the log; None if it is as the firmware has it."""
        self._time_us, frame = line
        decoded = self._protocol.decode(frame)
        if decoded is None:
            time_s = self._time_us / 1e6
            raise UsageError(f"{self._log.path}: damaged frame at {time_s:.2f} s: {self._protocol.describe(frame)}")
        if decoded.name == "RANGES":
            self._feed(frame)
            return None
        if decoded.name in _TO_ROBOT:
            opcode = decoded.signals.get("opcode")
            # What was lost on a bus is sent again, and answered again. A report is asked for in the middle of a tick.
            difference = self.end() if frame != self._sent and opcode != Opcode.REPORT else None
            self._sent = frame if opcode != Opcode.REPORT else self._sent
            self.stopped = opcode == Opcode.STOP or (self.stopped and opcode == Opcode.REPORT)
            self._lockstep = bool(decoded.signals.get("lockstep", self._lockstep))
            self._feed(frame)
            return difference
        if decoded.name == "DRIVE":
            return self._compare_drive(frame, decoded)
        return self._compare_memory(frame, decoded) if decoded.name == "MEMORY" else None

    def overhear(self, frame: Frame) -> None:
        """The robot hears another one's memory."""
        self._link.send(frame)

    def end(self) -> Difference | None:
        """The drive of the firmware that the log does not have."""
        if not self._pending or not self._lockstep:
            return None
        return Difference(self._time_us, None, self._pending.popitem()[1])

    def _feed(self, frame: Frame) -> None:
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
        reason = decoded.signals["reason"]
        if reason == Reason.SILENCE and not self._lockstep:
            return None  # on its own clock, a robot that received nothing says so; here it receives everything
        answer = self._pending.pop(decoded.signals["tick"], None)
        if answer is None and reason == Reason.STOP:
            return None  # a stopped robot rests, and a stop is sent again until all its reports have come
        if answer is None and frame == self._drive:
            return None
        self._drive = frame
        self.drives += answer == frame
        return None if answer == frame else Difference(self._time_us, frame, answer)

    def _compare_memory(self, frame: Frame, decoded: DecodedFrame) -> Difference | None:
        recorded = self._recorded.join(decoded)
        if recorded is None or self._memory is None or recorded == self._memory or not self._lockstep:
            return None
        cells = {f"cell_{i}": cell for i, cell in enumerate(self._memory)}
        return Difference(self._time_us, frame, self._protocol.encode("MEMORY", decoded.signals | cells))


def report(outcome: Replay, name: str, protocol: Protocol) -> str:
    """The outcome as text, which begins with the name of the log."""
    if outcome.difference is None:
        ending = "" if outcome.stopped else "; the log ends before the run does"
        return f"{name}: {outcome.drives} drives, no difference{ending}"
    difference = outcome.difference
    return "\n".join(
        (
            f"{name}: differs after {outcome.drives} equal drives, at {difference.time_us / 1e6:.2f} s of robot time",
            f"  recorded  {_described(difference.recorded, protocol)}",
            f"  replayed  {_described(difference.replayed, protocol)}",
        )
    )


def _described(frame: Frame | None, protocol: Protocol) -> str:
    return "nothing" if frame is None else protocol.describe(frame)
