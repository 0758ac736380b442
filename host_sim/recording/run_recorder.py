"""Records the trajectory of a run, tick by tick."""

from collections.abc import Mapping, Sequence
from operator import attrgetter
from struct import Struct
from typing import Any, NamedTuple, TypeVar

from host_sim.protocol.generated import ROW, Drive, Reason, Senses
from host_sim.recording.history import LearningHistory
from host_sim.recording.state import environment_scene
from host_sim.recording.state_types import EnvironmentScene
from host_sim.recording.trajectory import NEW_CELLS, Changes, RobotTrack, Trajectory, since
from host_sim.sim.native_loop import RobotBlock
from host_sim.sim.simulation import Simulation
from host_sim.world.geometry import Pose, SimParams

T = TypeVar("T")
Memory = Sequence[int]

TICKS_MAX = 450_000
"""Maximum length of a trajectory: 26 MB, and some 2 MB as a page. Longer runs retain their last environments."""

_SLACK = 8
"""A trajectory grows by one part in this many before it is cut, since cutting moves all retained data."""

_FOOD_EATEN = attrgetter("food_eaten")
_EVENTS = (Reason.TRIAL, Reason.BOREDOM)
_PACKED = Struct(f"={len(ROW)}h")


class Tick(NamedTuple):
    """One control tick.

    Attributes:
        senses: The body's senses.
        drive: The drive that the body applied: the robot's answer, or an earlier one that was still held.
        memory: The robot's eight cells when it answered.
        frozen: Whether learning was frozen.
        started: The robot's eight cells when it was started again since the previous tick; None if it was not.
        written: Its eight cells after each report between the two ticks, from its new start on if there was one.
    """

    senses: Senses
    drive: Drive
    memory: tuple[int, ...]
    frozen: bool
    started: tuple[int, ...] | None = None
    written: tuple[tuple[int, ...], ...] = ()


class RunRecorder:
    """Records each tick: called after each tick of a simulation, or fed through `enter` and `add`.

    Attributes:
        trajectory: The trajectory so far: about `TICKS_MAX` ticks before the current environment.
        histories: Each robot's learning history.
    """

    def __init__(self, params: SimParams, boredom_limit: int, memories: Mapping[int, Memory]) -> None:
        """Starts an empty recording.

        Args:
            params: The dimensions of the world.
            boredom_limit: Number of remembered turns in a row at which a robot is bored.
            memories: Each robot's eight cells before the first tick, by node number.
        """
        self.histories = [LearningHistory(node, memory) for node, memory in memories.items()]
        tracks = [
            RobotTrack(it.node, lessons=it.lessons, memories=[(0, list(it.memory))], trials=[(0, None)])
            for it in self.histories
        ]
        self.trajectory = Trajectory(params, boredom_limit, tracks)
        self._memories: list[Memory] = [tuple(memory) for memory in memories.values()]
        self._layouts = 0

    @classmethod
    def of(cls, simulation: Simulation, boredom_limit: int) -> "RunRecorder":
        """Creates a recorder for a simulation that has not begun yet, which calls it after each step."""
        memories = {client.node: client.memory for client in simulation.clients}
        simulation.watch = recorder = cls(simulation.params, boredom_limit, memories)
        return recorder

    def __call__(self, simulation: Simulation) -> None:
        """Records the tick that has just ended."""
        record, arena = simulation.record, simulation.arena
        if (layouts := len(record.begun) + len(record.edits)) != self._layouts:
            self._layouts = layouts
            self.enter(environment_scene(record.begun, record.environments, arena))
        for i, client in enumerate(simulation.clients):
            if simulation.loop is None:
                body = arena.bodies[i]
                row = (*simulation.senses[i], *simulation.drives[i], 0, body.lifted, 0)
                self._add(i, row, client.memory, body.pose)
            else:
                self.add_block(i, simulation.loop.block(i), client.memory)
        if sum(map(_FOOD_EATEN, simulation.episode.robots)) != self.trajectory.meals[-1][1].count(1):
            self.eaten(arena.food.eaten, simulation.drives)

    def enter(self, scene: EnvironmentScene) -> None:
        """Records that the next tick begins an environment, or that a person has changed the current one."""
        trajectory = self.trajectory
        if not trajectory.scenes or _name(trajectory.scenes[-1][1]) != _name(scene):
            _note(trajectory.meals, trajectory.ticks, [0] * len(scene["food"]))
            trajectory.environments += 1
        trajectory.scenes.append((trajectory.ticks, scene))
        if trajectory.ticks - trajectory.first_tick > TICKS_MAX + TICKS_MAX // _SLACK:
            begun = [scene["first_tick"] for _, scene in trajectory.scenes]
            self._forget(next((first for first in begun if trajectory.ticks - first <= TICKS_MAX), begun[-1]))

    def add(self, robot: int, tick: Tick, pose: Pose, *, lifted: bool = False) -> None:
        """Adds one robot's tick; each robot is added once per tick.

        Args:
            robot: Index of the robot.
            tick: The tick.
            pose: Pose of its body, after its move.
            lifted: Whether a person holds it in the air.
        """
        self.between(robot, tick.started, tick.written)
        self.histories[robot].frozen = tick.frozen
        self._add(robot, (*tick.senses, *tick.drive, 0, lifted, 0), tick.memory, pose)

    def between(self, robot: int, started: Memory | None, written: Sequence[Memory]) -> None:
        """Records starts and memory changes of one robot between the last tick and the next one.

        Args:
            robot: Index of the robot.
            started: Its eight cells when it was started again; None if it was not.
            written: Its eight cells after each report since then.
        """
        history, track = self.histories[robot], self.trajectory.tracks[robot]
        tick = history.ticks
        if started is not None:
            history.restart(tick, started)
            _note(track.trials, tick, None)
            track.cells = [cell for cell in track.cells if cell.tick < tick]
            track.cells += [cell._replace(tick=tick) for cell in NEW_CELLS]
            self._memories[robot] = started
        for memory in written:
            track.cells += history.relearn(tick, memory)
            self._memories[robot] = memory
        _note(track.memories, tick, list(history.memory))

    def add_block(self, robot: int, block: RobotBlock, memory: Memory) -> None:
        """Adds one robot's ticks of a block, and its memory after the last one; each robot is added once per block.

        Food eaten and reports end a block, so they belong to its last tick.
        """
        rows, first = memoryview(block.rows), 0
        if block.memory != self._memories[robot] and len(rows) > _PACKED.size:
            first = _PACKED.size
            self._take(robot, rows[:first], block.memory)
        self._take(robot, rows[first:], memory)
        self.trajectory.tracks[robot].poses_flat.frombytes(block.poses)

    def eaten(self, eaten: Sequence[bool], drives: Sequence[Drive]) -> None:
        """Records which pieces of food were eaten by the end of the last tick added, and the robots' drives in it."""
        trajectory = self.trajectory
        _note(trajectory.meals, trajectory.ticks - 1, [int(is_eaten) for is_eaten in eaten])
        for track, drive in zip(trajectory.tracks, drives, strict=True):
            if drive.eat:
                track.meals.append(trajectory.ticks - 1)

    def _add(self, robot: int, row: Sequence[int], memory: Memory, pose: Pose) -> None:
        """Adds one robot's tick: the numbers of `ROW`, its eight cells, and its pose after the move."""
        self._take(robot, bytearray(_PACKED.pack(*row)), memory)
        self.trajectory.tracks[robot].poses_flat.extend(pose)

    def _take(self, robot: int, rows: Any, memory: Memory) -> None:
        """Adds the rows of ticks; the robot's report belongs to the last one."""
        history, track = self.histories[robot], self.trajectory.tracks[robot]
        for tick, reason, cell, trial in history.take(rows):
            _note(track.trials, tick, trial)
            if reason == Reason.REMEMBERED:
                track.cells.append(cell)
            elif reason in _EVENTS:
                track.begun.append((tick, reason))
        if memory != self._memories[robot]:
            track.cells += history.learn(memory)
            self._memories[robot] = memory
            _note(track.memories, history.ticks - 1, list(history.memory))
        track.rows_flat.frombytes(rows)

    def _forget(self, first: int) -> None:
        """Drops everything before a tick."""
        trajectory = self.trajectory
        if first <= trajectory.first_tick:
            return
        for track, history in zip(trajectory.tracks, self.histories, strict=True):
            track.forget(first)
            history.forget_lessons(first)
        trajectory.scenes, trajectory.meals = since(trajectory.scenes, first), since(trajectory.meals, first)


def _note(changes: Changes[T], tick: int, value: T) -> None:
    """Adds a value if it has changed; it replaces a value of the same tick."""
    if changes and changes[-1][0] == tick:
        changes.pop()
    if not changes or changes[-1][1] != value:
        changes.append((tick, value))


def _name(scene: EnvironmentScene) -> tuple[int, int, int]:
    """The key that identifies an environment."""
    return scene["seed"], scene["number"], scene["first_tick"]
