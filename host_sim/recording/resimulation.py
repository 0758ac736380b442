"""Reconstructs a run from its log: rebuilds the world and moves the robots through it with their recorded drives."""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from host_sim.base.errors import OctetError
from host_sim.protocol.codec import NODE_MAX, Protocol
from host_sim.protocol.generated import Senses
from host_sim.recording.log_reader import LogReader, nodes_in, read_log
from host_sim.recording.phrases import news_of
from host_sim.recording.recording import Recording, read_recording, reckon
from host_sim.recording.run_recorder import RunRecorder, Tick
from host_sim.recording.state import environment_scene
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import read_world, world_path
from host_sim.sim.world_record import Begun, WorldRecord
from host_sim.world.arena import Arena
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import SimParams

_LIMIT_S = 600.0
"""Default time limit of a run for each environment."""


@dataclass(frozen=True)
class Resimulation:
    """A reconstructed run.

    Attributes:
        trajectory: Every tick of the run.
        record: The run's world; None if it is not known.
        stopped: Whether the log contains the end of the run; if not, the log or the run was cut short.
        note: One line about the frames of the log that were skipped; None if there were none.
    """

    trajectory: Trajectory
    record: WorldRecord | None
    stopped: bool
    note: str | None

    @property
    def seed(self) -> int | None:
        """The run's seed, if its world is known."""
        return None if self.record is None else self.record.seed

    @property
    def title(self) -> str:
        """The run's title."""
        return self.record.title if self.record else "a robot under way"


def resimulate(log: Path, node: int = 1, *, ignore_world: bool = False, channel: str | None = None) -> Resimulation:
    """Reconstructs a run from its log, and from the world file beside it if there is one.

    Without a world file, the environments are those of the seed that the robot was started with, one after the other,
    as in a default run. Without a seed, or if the world is ignored, the path is that of the robot's odometers, in an
    empty arena.

    Args:
        log: A log of a run, or of `candump -L`.
        node: The robot's node number on the bus; the first robot's if there are several.
        channel: The interface or channel in the log, if several have robots.
        ignore_world: Whether to ignore world file and seed; only this robot is reconstructed then.

    Raises:
        UsageError: A file cannot be read.
        OctetError: The log is of another protocol, or was recorded in another world.
    """
    lines = read_log(log, channel)
    recording = read_recording(lines, Protocol(node))
    record = None if ignore_world else _world_record(log, lines, recording, node)
    if record is None:
        trajectory = reckon(recording, node, SimParams())
        return Resimulation(trajectory, None, recording.stopped, lines.note())
    others = range(node + 1, node + record.robots)
    recordings = {node: recording} | {other: read_recording(lines, Protocol(other)) for other in others}
    trajectory = _Resimulator(log, record, recordings).run()
    return Resimulation(trajectory, record, recording.stopped, lines.note())


def _world_record(log: Path, lines: LogReader, recording: Recording, node: int) -> WorldRecord | None:
    path = world_path(log)
    if path.exists():
        return read_world(path)
    if recording.seed is None:
        return None
    nodes = set(nodes_in(lines))
    robots = next(count for count in range(1, NODE_MAX + 1) if node + count not in nodes)
    return WorldRecord(recording.seed, 1, round(_LIMIT_S / SimParams().tick_s), robots)


class _Resimulator:
    """Repeats a run in the environments of a record or, if it lists none, in the order of a default run."""

    def __init__(self, log: Path, record: WorldRecord, recordings: dict[int, Recording]) -> None:
        self._log, self._params, self._record = log, record.world.params, record
        self._recordings = list(recordings.values())
        self._runs_on = not record.begun
        self._planned, self._edits = deque(record.begun), deque(record.edits)
        self._begun = Begun(record.seed, 0, 0)
        self._all_begun: list[Begun] = []
        self._arena: Arena | None = None
        memories = {node: recording.first_memory for node, recording in recordings.items()}
        self._recorder = RunRecorder(self._params, self._recordings[0].boredom_limit, memories)

    def run(self) -> Trajectory:
        """Repeats every tick that is in all robots' recordings."""
        for tick, robots in enumerate(zip(*(recording.ticks for recording in self._recordings), strict=False)):
            self._run_tick(tick, robots)
        for _, scene in self._recorder.trajectory.scenes:
            scene["of"] = max(self._record.environments, self._begun.number)
        self._recorder.trajectory.news = news_of(self._record)
        return self._recorder.trajectory

    def _run_tick(self, tick: int, robots: Sequence[Tick]) -> None:
        arena = self._prepare(tick)
        for node, body, robot in zip(self._nodes, arena.bodies, robots, strict=True):
            self._check(tick, node, body.sense(tick), robot.senses)
        ate = False
        for body, robot in zip(arena.bodies, robots, strict=True):
            ate |= robot.drive.eat and body.eat()
            body.move(robot.drive.left_mm_s, robot.drive.right_mm_s)
        for i, robot in enumerate(robots):
            self._recorder.add(i, robot, arena.bodies[i].pose, lifted=arena.bodies[i].lifted)
        if ate:
            self._recorder.eaten(arena.food.eaten, [robot.drive for robot in robots])

    @property
    def _nodes(self) -> list[int]:
        return [history.node for history in self._recorder.histories]

    def _prepare(self, tick: int) -> Arena:
        """The arena of a tick, with the changes made by people before that tick."""
        arena, changed = self._arena, False
        for begun in self._due(tick):
            arena = self._enter(begun)
            changed = True
        if arena is None:
            raise self._mismatch(tick, "the first environment begins later")
        while self._edits and self._edits[0].tick == tick:
            self._edit(arena, tick, self._edits.popleft().edit)
            changed = True
        if changed:
            self._recorder.enter(environment_scene(self._all_begun, self._record.environments, arena))
        return arena

    def _enter(self, begun: Begun) -> Arena:
        before = self._arena.bodies if self._arena else ()
        layout = self._record.world.generate(begun.seed, begun.number, self._record.robots)
        self._arena = Arena(layout, self._params, before, kind=self._record.kind)
        if begun.number == 1:
            self._arena.begin(begun.seed)
        self._begun = begun
        self._all_begun.append(begun)
        return self._arena

    def _due(self, tick: int) -> Iterator[Begun]:
        """Yields the environments that begin with a tick; all but the last one ended without any."""
        while self._planned and self._planned[0].first_tick == tick:
            yield self._planned.popleft()
        over = self._arena is None or not self._arena.food.left
        if self._runs_on and (over or tick - self._begun.first_tick >= self._record.limit_ticks):
            yield Begun(self._begun.seed, self._begun.number + 1, tick)

    def _edit(self, arena: Arena, tick: int, edit: Edit) -> None:
        try:
            arena.edit(edit)
        except EditError as error:
            raise self._mismatch(tick, str(error)) from None

    def _check(self, tick: int, node: int, simulated: Senses, recorded: Senses) -> None:
        if simulated == recorded:
            return
        pairs = zip(Senses._fields, recorded, simulated, strict=True)
        who = f"node {node}: " if self._record.robots > 1 else ""
        what = ", ".join(f"{name} is {a:d}, expected {b:d}" for name, a, b in pairs if a != b)
        raise self._mismatch(tick, who + what)

    def _mismatch(self, tick: int, what: str) -> OctetError:
        world = f"seed {self._record.seed}" if self._runs_on else str(world_path(self._log))
        return OctetError(
            f"{self._log} was not recorded in the world of {world}: at {tick * self._params.tick_s:.2f} s {what}; "
            f"put that run's {world_path(self._log).name} beside the log, or ignore the world with --no-world"
        )
