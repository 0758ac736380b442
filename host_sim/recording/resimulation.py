"""From a log back to where the robot was: its world is built anew, and its drives move the body through it again."""

from collections import deque
from dataclasses import dataclass
from pathlib import Path

from host_sim.errors import OctetError
from host_sim.protocol.codec import Protocol
from host_sim.recording.dead_reckoning import reckon
from host_sim.recording.log_reader import Recording, read_recording
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import read_world, world_path
from host_sim.robot_io import Senses
from host_sim.sim.world_record import Begun, WorldRecord
from host_sim.view.history import LearningHistory
from host_sim.view.state import environment_scene
from host_sim.world.arena import Arena
from host_sim.world.editing import EditError, make_edit
from host_sim.world.edits import Edit
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams

_LIMIT_S = 600.0
"""How long a run stays in an environment, unless told otherwise."""


@dataclass(frozen=True)
class Resimulation:
    """A run that was found again.

    Attributes:
        trajectory: Every tick of it.
        seed: Its seed; None if its world is not known.
        stopped: Whether the log has its end; else it is cut short, or the run was.
    """

    trajectory: Trajectory
    seed: int | None
    stopped: bool

    @property
    def title(self) -> str:
        """What to call it."""
        return "a robot on its way" if self.seed is None else f"seed {self.seed}"


def resimulate(log: Path, protocol: Protocol, *, in_the_open: bool = False) -> Resimulation:
    """Finds a run again from its log, and from the world file beside it if there is one.

    Without a world file, the environments are those of the seed with which the robot was started, one after the other
    as in a usual run. Without a seed, or in the open, odometers give the way, and around it there is nothing.

    Args:
        log: As a run left it, or `candump -L`.
        protocol: Of the robot's node.
        in_the_open: Whether to ask neither world file nor seed.

    Raises:
        UsageError: A file cannot be read.
        OctetError: The log is no log of this protocol, or the world is not the one in which it was recorded.
    """
    recording = read_recording(log, protocol)
    known = None if in_the_open else _world_record(log, recording)
    if known is None:
        return Resimulation(reckon(recording, SimParams()), None, recording.stopped)
    return Resimulation(_Walk(log, SimParams(), known, recording).walk(), known.seed, recording.stopped)


def _world_record(log: Path, recording: Recording) -> WorldRecord | None:
    path = world_path(log)
    if path.exists():
        return read_world(path)
    return None if recording.seed is None else WorldRecord(recording.seed, 1, round(_LIMIT_S / SimParams().tick_s))


class _Walk:
    """One way through the environments of a record; where it names none, one follows the other as in a run."""

    def __init__(self, log: Path, params: SimParams, record: WorldRecord, recording: Recording) -> None:
        self._log, self._params, self._record, self._recording = log, params, record, recording
        self._runs_on = not record.begun
        self._planned, self._edits = deque(record.begun), deque(record.edits)
        self._begun = Begun(record.seed, 0, 0)
        self._arena: Arena | None = None
        self._history = LearningHistory(recording.first_memory)
        self._trajectory = Trajectory(params, recording.boredom_limit)

    def walk(self) -> Trajectory:
        """Goes all of it."""
        for tick, (senses, drive, memory, frozen) in enumerate(self._recording.ticks):
            arena = self._prepare(tick)
            self._check(tick, arena.sense(tick), senses)
            if drive.eat:
                arena.eat()
            arena.move(drive.left_mm_s, drive.right_mm_s)
            self._history.frozen = frozen
            self._history.take(tick, senses, drive, memory)
            self._trajectory.add(arena, senses, drive, self._history)
        for _, scene in self._trajectory.scenes:
            scene["of"] = max(self._record.environments, self._begun.number)
        return self._trajectory

    def _prepare(self, tick: int) -> Arena:
        """The arena of a tick, with what a person did to it before."""
        arena, changed = self._arena, False
        begun = self._due(tick)
        if begun is not None:
            environment = generate(begun.seed, begun.number, self._params)
            arena = Arena(environment, self._params, arena.odometer if arena else (0.0, 0.0))
            if begun.number == 1 or begun.seed != self._begun.seed:
                self._history.trial = None  # a run that starts over has no last trial
            self._arena, self._begun, changed = arena, begun, True
        if arena is None:
            raise self._misfit(tick, "it begins later")
        while self._edits and self._edits[0].tick == tick:
            self._edit(arena, tick, self._edits.popleft().edit)
            changed = True
        if changed:
            self._trajectory.enter(environment_scene(self._begun, self._record.environments, arena))
        return arena

    def _due(self, tick: int) -> Begun | None:
        """The environment that begins with a tick; of several in one tick, the last."""
        begun = None
        while self._planned and self._planned[0].first_tick == tick:
            begun = self._planned.popleft()
        if not self._runs_on:
            return begun
        over = self._arena is None or not self._arena.food_left
        if over or tick - self._begun.first_tick >= self._record.limit_ticks:
            begun = Begun(self._begun.seed, self._begun.number + 1, tick)
        return begun

    def _edit(self, arena: Arena, tick: int, edit: Edit) -> None:
        try:
            make_edit(arena, edit, self._params)
        except EditError as error:
            raise self._misfit(tick, str(error)) from None

    def _check(self, tick: int, simulated: Senses, recorded: Senses) -> None:
        if simulated != recorded:
            pairs = zip(Senses._fields, recorded, simulated, strict=True)
            raise self._misfit(tick, ", ".join(f"{name} {a:d} and not {b:d}" for name, a, b in pairs if a != b))

    def _misfit(self, tick: int, what: str) -> OctetError:
        params = f"seed {self._record.seed}" if self._runs_on else str(world_path(self._log))
        return OctetError(
            f"{self._log} was not recorded in the world of {params}: at {tick * self._params.tick_s:.2f} s {what}; "
            f"put the {world_path(self._log).name} of that run beside it, or leave the world out with --no-world"
        )
