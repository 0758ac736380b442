"""Turns the frames of a log into ticks."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from host_sim.client.pacing import applied
from host_sim.errors import OctetError
from host_sim.protocol.codec import DecodedFrame, Frame, Protocol
from host_sim.protocol.generated import CELL_COUNT, PARAMETERS, Opcode
from host_sim.protocol.memory_report import MemoryReport
from host_sim.recording.log_reader import LogReader, check_protocol, first_memory, frames_of
from host_sim.recording.tick_list import Tick, TickList
from host_sim.robot_io import Drive, Senses


@dataclass
class Recording:
    """One robot's part of a log.

    Attributes:
        seed: Seed that the robot was started with; None if the log does not have its start.
        boredom_limit: Number of remembered turns in a row at which the robot is bored.
        first_memory: The eight cells before the first tick.
        ticks: The ticks, in order, without a last one whose answer is cut off.
        stopped: Whether the log ends with a stop command; if not, the log or the run was cut short.
    """

    seed: int | None = None
    boredom_limit: int = PARAMETERS["boredom_limit"].default
    first_memory: tuple[int, ...] = (0,) * CELL_COUNT
    ticks: TickList = field(default_factory=TickList)
    stopped: bool = False


def read_recording(log: LogReader, protocol: Protocol) -> Recording:
    """Reads one robot's part of a log.

    Args:
        log: The log.
        protocol: The protocol of the robot's node.

    Raises:
        OctetError: The log is of another protocol, or has no heartbeat or no tick of this node.
    """
    check_protocol(log, protocol)
    ours = frames_of(log, protocol.node)
    recording = _Reader(protocol, first_memory(log, protocol)).read(line.frame for line in ours)
    if not recording.ticks:
        raise OctetError(
            f"{log.path} has no tick in which the robot moves: the run never began, or the log is cut short"
        )
    return recording


class _Reader:
    """Groups frames into ticks. A tick ends with the next SENSES or COMMAND: drives after that are too late."""

    def __init__(self, protocol: Protocol, memory: bytes) -> None:
        self._protocol = protocol
        self._memory = tuple(memory)
        self._report = MemoryReport()
        self._recording = Recording(first_memory=self._memory)
        self._senses: Senses | None = None
        self._begun: Senses | None = None
        self._fresh: Drive | None = None
        self._last: Drive | None = None
        self._frozen, self._lockstep = False, True
        self._started: tuple[int, ...] | None = None
        self._written: list[tuple[int, ...]] = []

    def read(self, frames: Iterable[Frame]) -> Recording:
        """Reads all frames in order; skips damaged ones and those of other nodes."""
        for frame in frames:
            if drive := self._protocol.decode_drive(frame):
                self._fresh = drive
            elif decoded := self._protocol.decode(frame):
                self._accept(decoded)
        self._end_tick()
        return self._recording

    def _accept(self, decoded: DecodedFrame) -> None:
        if decoded.name == "SENSES":
            self._begin_tick(_senses_from(decoded))
        elif decoded.name == "MEMORY":
            memory = self._report.join(decoded)
            if memory is not None:
                self._accept_memory(memory)
        elif decoded.name == "COMMAND":
            self._end_tick()
            self._begun = None
            self._accept_command(decoded.signals)

    def _begin_tick(self, senses: Senses) -> None:
        """Begins a tick, unless its senses were only sent again."""
        if senses != self._begun:
            self._end_tick()
            self._begun = self._senses = senses

    def _end_tick(self) -> None:
        if self._senses is not None and (self._fresh is not None or not self._lockstep):
            between = self._started, tuple(self._written)
            tick = Tick(self._senses, self._applied(self._senses.tick), self._memory, self._frozen, *between)
            self._recording.ticks.append(tick)
            self._started = None
            self._written.clear()
        self._senses, self._fresh = None, None

    def _applied(self, tick: int) -> Drive:
        """The drive that the body applied: the answer, else the previous one for a while, then rest (`RealTime`)."""
        came = self._fresh is not None
        self._last = self._fresh or self._last
        return applied(self._last, tick, came)

    def _accept_memory(self, memory: tuple[int, ...]) -> None:
        changed = memory != self._memory
        self._memory = memory
        if self._senses is not None:
            return
        if not self._recording.ticks:
            self._recording.first_memory = memory
        elif changed:
            self._written.append(memory)

    def _accept_command(self, signals: dict[str, int]) -> None:
        opcode = signals["opcode"]
        self._recording.stopped = opcode == Opcode.STOP
        if opcode == Opcode.START:
            self._frozen, self._lockstep = False, bool(signals["lockstep"])
            self._started = self._memory if self._recording.ticks else None
            self._written.clear()
            self._recording.seed = signals["seed"] if self._recording.seed is None else self._recording.seed
        elif opcode == Opcode.SET and signals["parameter"] == PARAMETERS["boredom_limit"].number:
            self._recording.boredom_limit = signals["value"]
        elif opcode == Opcode.FREEZE:
            self._frozen = bool(signals["freeze"])


def _senses_from(decoded: DecodedFrame) -> Senses:
    """The senses in a decoded SENSES frame."""
    signals = decoded.signals
    return Senses(
        tick=signals["tick"],
        feel=signals["feel"],
        bump=bool(signals["bump"]),
        look=bool(signals["look"]),
        beacon_mm=signals["beacon"],
        odometer_left=signals["odometer_left"],
        odometer_right=signals["odometer_right"],
    )
