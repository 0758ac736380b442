"""Takes a run down as it goes: lets its trajectory grow tick by tick."""

from collections.abc import Mapping, Sequence
from struct import Struct
from typing import Protocol, TypeVar

from host_sim.recording.trajectory import AXES, ROW, Changes, RobotTrack, Trajectory, at
from host_sim.robot_io import Drive, Senses
from host_sim.sim.simulation import Simulation
from host_sim.view.history import LearningHistory
from host_sim.view.state import EnvironmentScene, environment_scene
from host_sim.world.geometry import Pose
from host_sim.world.params import SimParams

T = TypeVar("T")
Memory = Sequence[int]

TICKS_MAX = 1_000_000
"""Of longer runs the last environments are kept: 58 MB, and some 5 MB as a page."""

_PACKED = Struct(f"={len(ROW)}h")


class BodyState(Protocol):
    """As much of a body as is taken down."""

    @property
    def pose(self) -> Pose:
        """Where the robot is and looks."""

    @property
    def lifted(self) -> bool:
        """Whether a person holds the robot in the air."""


class RunRecorder:
    """Called after each tick of a simulation, or told each tick by `enter` and `add`.

    Attributes:
        trajectory: What was taken down so far: as far as `TICKS_MAX`, and the environment under way.
        histories: What each robot has come to.
    """

    def __init__(self, params: SimParams, boredom_limit: int, memories: Mapping[int, Memory]) -> None:
        """Waits for the first tick.

        Args:
            params: The measures.
            boredom_limit: The remembered turn in a row after which a robot is bored.
            memories: For each robot, by its node, the eight cells that it begins with.
        """
        self.histories = [LearningHistory(node, memory) for node, memory in memories.items()]
        tracks = [RobotTrack(history.node, lessons=history.lessons) for history in self.histories]
        self.trajectory = Trajectory(params, boredom_limit, tracks)
        self._actions = [-1] * len(tracks)
        self._memories: list[Memory] = [()] * len(tracks)
        self._layouts = 0

    @classmethod
    def of(cls, simulation: Simulation, boredom_limit: int) -> "RunRecorder":
        """Takes down a simulation that has not begun yet."""
        memories = {client.node: client.memory for client in simulation.clients}
        simulation.watch = recorder = cls(simulation.params, boredom_limit, memories)
        return recorder

    def __call__(self, simulation: Simulation) -> None:
        """Takes down the tick that has just ended."""
        record, arena = simulation.record, simulation.arena
        if (layouts := len(record.begun) + len(record.edits)) != self._layouts:
            self._layouts = layouts
            self.enter(environment_scene(record.begun[-1], record.environments, arena))
        for i, client in enumerate(simulation.clients):
            self.add(i, arena.bodies[i], simulation.senses[i], simulation.drives[i], client.memory)
        if len(arena.food.uneaten) != self.trajectory.meals[-1][1].count(0):
            self.eaten(arena.food.eaten, simulation.drives)

    def enter(self, scene: EnvironmentScene) -> None:
        """An environment begins with the next tick, or a person has changed the present one."""
        trajectory = self.trajectory
        if not trajectory.scenes or _name(trajectory.scenes[-1][1]) != _name(scene):
            _note(trajectory.meals, trajectory.ticks, [0] * len(scene["food"]))
        trajectory.scenes.append((trajectory.ticks, scene))
        self._actions = [-1] * len(self._actions)
        begun = [scene["first_tick"] for _, scene in trajectory.scenes]
        self._forget(next((first for first in begun if trajectory.ticks - first <= TICKS_MAX), begun[-1]))

    def add(self, robot: int, body: BodyState, senses: Senses, drive: Drive, memory: Memory) -> None:
        """Adds a robot's tick.

        Args:
            robot: Its place among the robots; each is added once a tick.
            body: Has moved.
            senses: The tick's.
            drive: The tick's.
            memory: The eight cells after the robot's answer.
        """
        history, track = self.histories[robot], self.trajectory.tracks[robot]
        if drive.action != self._actions[robot] or memory != self._memories[robot]:
            self._actions[robot], self._memories[robot] = drive.action, memory
            self._take(robot, senses, drive, memory)
        track.poses_flat.extend(body.pose)
        track.rows_flat.frombytes(_PACKED.pack(*senses, *drive, history.pattern, body.lifted, history.frozen))

    def eaten(self, eaten: Sequence[bool], drives: Sequence[Drive]) -> None:
        """Food was eaten in the tick that was added last.

        Args:
            eaten: For each piece of food, whether it was eaten by the end of that tick.
            drives: The robots' in that tick.
        """
        trajectory = self.trajectory
        _note(trajectory.meals, trajectory.ticks - 1, [int(is_eaten) for is_eaten in eaten])
        for track, drive in zip(trajectory.tracks, drives, strict=True):
            if drive.eat:
                track.meals.append(trajectory.ticks - 1)

    def _take(self, robot: int, senses: Senses, drive: Drive, memory: Memory) -> None:
        """Notes what can change with an action or a frame of the memory."""
        history, track = self.histories[robot], self.trajectory.tracks[robot]
        tick = track.ticks
        history.take(tick, senses, drive, memory)
        _note(track.memories, tick, list(history.memory))
        _note(track.trials, tick, history.trial)

    def _forget(self, first: int) -> None:
        """Keeps only what is from a tick on."""
        trajectory = self.trajectory
        if first <= trajectory.first_tick:
            return
        for track in trajectory.tracks:
            track.old_turns = [turn for turn in track.turns() if turn[0] < first]
            del track.poses_flat[: (first - track.first_tick) * AXES]
            del track.rows_flat[: (first - track.first_tick) * len(ROW)]
            track.memories, track.trials = _since(track.memories, first), _since(track.trials, first)
            track.first_tick = first
        trajectory.scenes, trajectory.meals = _since(trajectory.scenes, first), _since(trajectory.meals, first)


def _note(changes: Changes[T], tick: int, value: T) -> None:
    """Adds a value if it is news, in place of one of the same tick."""
    if changes and changes[-1][1] == value:
        return
    if changes and changes[-1][0] == tick:
        changes.pop()
    changes.append((tick, value))


def _since(changes: Changes[T], first: int) -> Changes[T]:
    """The changes from a tick on, beginning with what holds then."""
    return [(first, at(changes, first)), *(change for change in changes if change[0] > first)]


def _name(scene: EnvironmentScene) -> tuple[int, int, int]:
    """What tells an environment from the one before."""
    return scene["seed"], scene["number"], scene["first_tick"]
