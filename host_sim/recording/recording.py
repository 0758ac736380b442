"""Turns the frames of a log into ticks; the path of a real body, whose world is not known, by dead reckoning."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from host_sim.base.errors import UsageError
from host_sim.client.pacing import applied
from host_sim.protocol.codec import UNSAID, DecodedFrame, Frame, MemoryReport, Protocol
from host_sim.protocol.generated import (
    CELL_COUNT,
    ODOMETER_COUNTS_PER_MM,
    ODOMETER_SPAN,
    PARAMETERS,
    Drive,
    Opcode,
    Senses,
)
from host_sim.recording.log_reader import LogReader, check_protocol, first_memory, frames_of
from host_sim.recording.run_recorder import RunRecorder, Tick
from host_sim.recording.state_types import EnvironmentScene
from host_sim.recording.trajectory import Trajectory
from host_sim.world.body import rolled
from host_sim.world.geometry import Pose, SimParams


@dataclass
class Recording:
    """One robot's part of a log.

    Attributes:
        seed: Seed that the robot was started with; None if the log does not have its start.
        boredom_limit: Number of remembered turns in a row at which the robot is bored.
        first_memory: The eight cells before the first tick.
        ticks: The ticks, in order, except for a last one whose answer was cut off; each iteration reads the log.
        stopped: Whether the log ends with a stop command; if not, the log or the run was cut short.
    """

    seed: int | None = None
    boredom_limit: int = PARAMETERS["boredom_limit"].default
    first_memory: tuple[int, ...] = (0,) * CELL_COUNT
    ticks: Iterable[Tick] = ()
    stopped: bool = False


def read_recording(log: LogReader, protocol: Protocol) -> Recording:
    """Reads one robot's part of a log, given the protocol of its node.

    Raises:
        UsageError: The log is of another protocol, or has no heartbeat or no tick of this node.
    """
    check_protocol(log, protocol)
    ticks = _Ticks(log, protocol)
    reader = ticks.reader()
    for _ in reader.read(ticks.frames()):
        pass
    recording = replace(reader.recording, ticks=ticks)
    if not reader.ticks:
        raise UsageError(
            f"{log.path} has no tick in which the robot moves: the run never began, or the log is cut short"
        )
    return recording


class _Ticks:
    """The ticks of one robot, read from the log on demand: a run of an hour has 180,000."""

    def __init__(self, log: LogReader, protocol: Protocol) -> None:
        self._log, self._protocol = log, protocol
        self._first_memory = first_memory(log, protocol)

    def __iter__(self) -> Iterator[Tick]:
        return self.reader().read(self.frames())

    def reader(self) -> "TickReader":
        return TickReader(self._protocol, self._first_memory)

    def frames(self) -> Iterator[Frame]:
        return (line.frame for line in frames_of(self._log, self._protocol.node))


class TickReader:
    """Groups frames into ticks. A tick ends with the next SENSES or command: later drives do not count.

    Attributes:
        recording: The recording so far, without its ticks.
        ticks: Number of ticks so far.
    """

    def __init__(self, protocol: Protocol, memory: bytes) -> None:
        self._protocol = protocol
        self._memory = tuple(memory)
        self._report = MemoryReport()
        self.recording = Recording(first_memory=self._memory)
        self.ticks = 0
        self._senses: Senses | None = None
        self._begun: Senses | None = None
        self._fresh: Drive | None = None
        self._last: Drive | None = None
        self._frozen, self._lockstep = False, True
        self._started: tuple[int, ...] | None = None
        self._begins = False  # whether a new memory is what the robot starts with
        self._written: list[tuple[int, ...]] = []

    def read(self, frames: Iterable[Frame]) -> Iterator[Tick]:
        """Reads all frames in order; skips damaged ones and those of other nodes."""
        for frame in frames:
            if drive := self._protocol.decode_drive(frame):
                self._fresh = drive
            elif decoded := self._protocol.decode(frame):
                yield from self._accept(decoded)
        yield from self._end_tick()

    def _accept(self, decoded: DecodedFrame) -> Iterator[Tick]:
        if decoded.name == "SENSES":
            senses = Senses._make(number for name, number in decoded.signals.items() if name not in UNSAID)
            if senses != self._begun:  # it is no repetition
                yield from self._end_tick()
                self._begun = self._senses = senses
        elif decoded.name == "MEMORY":
            memory = self._report.join(decoded)
            if memory is not None:
                self._accept_memory(memory)
        elif decoded.name == "COMMAND" and not self._is_question(decoded):
            yield from self._end_tick()
            self._begun = None
            self._accept_command(decoded.signals)

    def _is_question(self, decoded: DecodedFrame) -> bool:
        """Whether a report is requested from a robot that has stopped by itself, before its drive in this tick."""
        return self._lockstep and self._fresh is None and decoded.signals["opcode"] == Opcode.REPORT

    def _end_tick(self) -> Iterator[Tick]:
        """Yields the tick that has ended, if there is one and it was answered."""
        senses, fresh = self._senses, self._fresh
        if senses is not None and (fresh is not None or not self._lockstep):
            between = self._started, tuple(self._written)
            self.ticks += 1
            self._started, self._begins = None, False
            self._written.clear()
            yield Tick(senses, self._applied(senses.tick), self._memory, self._frozen, *between)
        self._senses, self._fresh = None, None

    def _applied(self, tick: int) -> Drive:
        """The drive that the body applied: the answer, or the previous one for a while, then rest (`RealTime`)."""
        came = self._fresh is not None
        self._last = self._fresh or self._last
        return applied(self._last, tick, came)

    def _accept_memory(self, memory: tuple[int, ...]) -> None:
        changed = memory != self._memory
        self._memory = memory
        if self._senses is not None:
            return
        if not self.ticks:
            self.recording.first_memory = memory
        elif changed and self._begins:
            self._started = memory
        elif changed:
            self._written.append(memory)

    def _accept_command(self, signals: dict[str, int]) -> None:
        opcode = signals["opcode"]
        self._begins = opcode == Opcode.START or (self._begins and opcode not in (Opcode.WRITE, Opcode.ERASE))
        self.recording.stopped = opcode == Opcode.STOP or (self.recording.stopped and opcode == Opcode.REPORT)
        if opcode == Opcode.START:
            self._frozen, self._lockstep = False, bool(signals["lockstep"])
            self._started = self._memory if self.ticks else None
            self._written.clear()
            self.recording.seed = signals["seed"] if self.recording.seed is None else self.recording.seed
        elif opcode == Opcode.SET and signals["parameter"] == PARAMETERS["boredom_limit"].number:
            self.recording.boredom_limit = signals["value"]
        elif opcode == Opcode.FREEZE:
            self._frozen = bool(signals["freeze"])


_MARGIN_MM = 500.0


def reckon(recording: Recording, node: int, params: SimParams) -> Trajectory:
    """The trajectory of a recording of at least one tick, in the middle of an empty arena.

    The arena has at least the size of `params`, and is larger if the path needs it.
    """
    poses = _poses([tick.senses for tick in recording.ticks], params)
    params, poses = _framed(poses, params)
    recorder = RunRecorder(params, recording.boredom_limit, {node: recording.first_memory})
    recorder.enter(EnvironmentScene(number=1, of=1, seed=0, first_tick=0, start_tick=0, bars=[], food=[]))
    for tick, pose in zip(recording.ticks, poses, strict=True):
        recorder.add(0, tick, pose)
    return recorder.trajectory


def _poses(senses: Sequence[Senses], params: SimParams) -> list[Pose]:
    """The pose after each tick, when the next odometers are read; the first heading is 0."""
    pose = Pose(0.0, 0.0, 0.0)
    poses = []
    for before, next_ in pairwise(senses):
        pose = after(pose, before, next_, params)
        poses.append(pose)
    return [*poses, pose]


def after(pose: Pose, before: Senses, now: Senses, params: SimParams) -> Pose:
    """The pose of a body at `now`, having rolled from `pose` since `before`."""
    left_mm = _distance_mm(before.odometer_left, now.odometer_left)
    right_mm = _distance_mm(before.odometer_right, now.odometer_right)
    return rolled(pose, left_mm, right_mm, params.wheel_track_mm)


def _distance_mm(before: int, now: int) -> float:
    """The distance between two counts, which wrap, if it is less than half of their range."""
    return ((now - before + ODOMETER_SPAN // 2) % ODOMETER_SPAN - ODOMETER_SPAN // 2) / ODOMETER_COUNTS_PER_MM


def _framed(poses: Sequence[Pose], params: SimParams) -> tuple[SimParams, list[Pose]]:
    """The dimensions of an arena with the path in its middle, and the poses there."""
    left, right = min(pose.x_mm for pose in poses), max(pose.x_mm for pose in poses)
    top, bottom = min(pose.y_mm for pose in poses), max(pose.y_mm for pose in poses)
    width = max(params.width_mm, right - left + 2 * _MARGIN_MM)
    height = max(params.height_mm, bottom - top + 2 * _MARGIN_MM)
    dx, dy = (width - left - right) / 2, (height - top - bottom) / 2
    framed = replace(params, width_mm=width, height_mm=height)
    return framed, [Pose(pose.x_mm + dx, pose.y_mm + dy, pose.heading_rad) for pose in poses]
