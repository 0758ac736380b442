"""What a log says of robot and body, tick by tick."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from host_sim.client.pacing import held
from host_sim.errors import OctetError
from host_sim.protocol.codec import DecodedFrame, Frame, Protocol
from host_sim.protocol.generated import CELL_COUNT, PARAMETERS, Opcode
from host_sim.recording.log_reader import Recorded, check_protocol, first_memory, lines_of
from host_sim.robot_io import Drive, Senses


class Tick(NamedTuple):
    """One control tick.

    Attributes:
        senses: What the body sensed.
        drive: What its wheels did: the robot's answer, or what a body does without one.
        memory: The eight cells with which the robot answered.
        frozen: Whether the robot does not learn.
    """

    senses: Senses
    drive: Drive
    memory: tuple[int, ...]
    frozen: bool


@dataclass
class Recording:
    """A log, understood.

    Attributes:
        seed: With which the robot was started; None if that is not in the log.
        boredom_limit: The remembered turn in a row after which the robot is bored.
        first_memory: The eight cells before the first tick.
        ticks: In their order; one whose answer is cut off is left out.
        stopped: Whether the log ends with the robot at rest: else it is cut short, or the run was.
    """

    seed: int | None = None
    boredom_limit: int = PARAMETERS["boredom_limit"].default
    first_memory: tuple[int, ...] = (0,) * CELL_COUNT
    ticks: list[Tick] = field(default_factory=list)
    stopped: bool = False


def read_recording(log: Path, lines: Sequence[Recorded], protocol: Protocol) -> Recording:
    """Understands one robot's part of a log.

    Args:
        log: Where the lines come from, for messages.
        lines: The whole log.
        protocol: Of the robot's node.

    Raises:
        OctetError: It is no log, one of another protocol or node, or one without a tick.
    """
    ours = lines_of(lines, protocol.node)
    check_protocol(log, ours, protocol)
    recording = _Reader(protocol, first_memory(ours, protocol)).read(line.frame for line in ours)
    if not recording.ticks:
        raise OctetError(f"{log} has no tick in which the robot moves: a run that never began, or cut short")
    return recording


class _Reader:
    """Puts frames together to ticks. A tick ends with the next SENSES or command: drives after it come too late."""

    def __init__(self, protocol: Protocol, memory: bytes) -> None:
        self._protocol = protocol
        self._memory = tuple(memory)
        self._recording = Recording(first_memory=self._memory)
        self._senses: Senses | None = None
        self._fresh: Drive | None = None
        self._last: Drive | None = None
        self._waited = 0
        self._frozen, self._lockstep = False, True

    def read(self, frames: Iterable[Frame]) -> Recording:
        """Takes all frames in their order, but those that are damaged or of another node."""
        for frame in frames:
            if drive := self._protocol.decode_drive(frame):
                self._fresh = drive
            elif said := self._protocol.decode(frame):
                self._accept(said)
        self._end_tick()
        return self._recording

    def _accept(self, said: DecodedFrame) -> None:
        if said.name == "SENSES":
            self._end_tick()
            self._senses = _senses_from(said)
        elif said.name == "MEMORY":
            self._remember(tuple(said.signals.values()))
        elif said.name == "COMMAND":
            self._end_tick()
            self._obey(said.signals)

    def _end_tick(self) -> None:
        if self._senses is not None and (self._fresh is not None or not self._lockstep):
            tick = Tick(self._senses, self._taken(self._senses.tick), self._memory, self._frozen)
            self._recording.ticks.append(tick)
        self._senses, self._fresh = None, None

    def _taken(self, tick: int) -> Drive:
        """What the wheels do: the answer, or the one before for a while, then rest. As in `RealTime`."""
        if self._fresh is not None:
            self._last, self._waited = self._fresh, 0
            return self._fresh
        self._waited += 1
        return held(self._last, self._waited, tick)

    def _remember(self, memory: tuple[int, ...]) -> None:
        self._memory = memory
        if not self._recording.ticks and self._senses is None:
            self._recording.first_memory = memory

    def _obey(self, signals: dict[str, int]) -> None:
        opcode = signals["opcode"]
        self._lockstep = bool(signals["lockstep"])
        self._recording.stopped = opcode == Opcode.STOP
        if opcode == Opcode.START:
            self._frozen = False
            self._recording.seed = signals["seed"] if self._recording.seed is None else self._recording.seed
        elif opcode == Opcode.SET and signals["parameter"] == PARAMETERS["boredom_limit"].number:
            self._recording.boredom_limit = signals["value"]
        elif opcode == Opcode.FREEZE:
            self._frozen = bool(signals["freeze"])


def _senses_from(said: DecodedFrame) -> Senses:
    """The senses in a decoded SENSES frame."""
    signals = said.signals
    return Senses(
        tick=signals["tick"],
        feel=signals["feel"],
        bump=bool(signals["bump"]),
        look=bool(signals["look"]),
        beacon_mm=signals["beacon"],
        odometer_left=signals["odometer_left"],
        odometer_right=signals["odometer_right"],
    )
