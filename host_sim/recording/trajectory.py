"""The visible part of a run, tick by tick. Pages, pictures and animations are made from it."""

from array import array
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from operator import itemgetter
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from host_sim.protocol.generated import CELL_COUNT, ROW, Reason
from host_sim.view.history import Learned, Lesson, Trial
from host_sim.view.news import News
from host_sim.view.state import EnvironmentScene, State, state
from host_sim.world.geometry import Pose
from host_sim.world.params import SimParams

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

T = TypeVar("T")
Changes = list[tuple[int, T]]
"""A value that changes seldom: pairs of the tick from which it holds, and the value."""

AXES = len(Pose._fields)


class Event(NamedTuple):
    """An event that a page can jump to; `kind` is environment, change, trial, lesson, boredom or eat."""

    tick: int
    kind: str


class Begun(NamedTuple):
    """A turn that began: its tick, its reason, and the pattern when it was decided."""

    tick: int
    reason: int
    cell: int


@dataclass
class RobotTrack:
    """One robot's part of a run.

    Attributes:
        node: Its node number on the bus.
        first_tick: The first tick that is retained.
        memories: The eight cells.
        trials: The last trial, current or ended.
        lessons: Changes of cells, learned or made by hand: before `first_tick` only the last of each cell.
        meals: The ticks in which it ate.
        poses_flat: x and y in mm, heading in rad, tick after tick.
        rows_flat: The fields of `ROW`, 16 bits each, tick after tick.
        begun: The remembered turns, trials and about-faces.
        uses_before: For each cell, the number of remembered turns before `first_tick` that used what it held then.
    """

    node: int
    first_tick: int = 0
    memories: Changes[list[int]] = field(default_factory=list)
    trials: Changes[Trial | None] = field(default_factory=list)
    lessons: list[Lesson] = field(default_factory=list)
    meals: list[int] = field(default_factory=list)
    poses_flat: "array[float]" = field(default_factory=lambda: array("d"))
    rows_flat: "array[int]" = field(default_factory=lambda: array("h"))
    begun: list[Begun] = field(default_factory=list)
    uses_before: list[int] = field(default_factory=lambda: [0] * CELL_COUNT)

    @property
    def ticks(self) -> int:
        """The number of ticks so far, including those that are no longer retained."""
        return self.first_tick + len(self.poses_flat) // AXES

    def row(self, tick: int) -> "array[int]":
        """The fields of `ROW` at a retained tick."""
        at_row = tick - self.first_tick
        return self.rows_flat[at_row * len(ROW) : (at_row + 1) * len(ROW)]

    def pose(self, tick: int) -> Pose:
        """The pose after a retained tick."""
        at_row = tick - self.first_tick
        return Pose(*self.poses_flat[at_row * AXES : (at_row + 1) * AXES])

    def poses(self) -> "NDArray[np.float64]":
        """A view of the poses: shape (ticks, 3), x and y in mm, heading in rad. Do not add ticks while it exists."""
        import numpy as np  # noqa: PLC0415 - a run begins sooner without

        return np.frombuffer(self.poses_flat, np.float64).reshape(-1, AXES)

    def column(self, name: str) -> "NDArray[np.int16]":
        """A view of one field of `ROW`: shape (ticks,). Do not add ticks while it exists."""
        import numpy as np  # noqa: PLC0415 - see above

        return np.frombuffer(self.rows_flat, np.int16).reshape(-1, len(ROW))[:, ROW.index(name)]

    def ticks_of(self, reason: Reason) -> list[int]:
        """The retained ticks in which turns with a reason began."""
        return [begun.tick for begun in self.begun if begun.reason == reason]

    def turns(self) -> list[tuple[int, int]]:
        """Each remembered turn that is retained: its first tick, and the cell that it used."""
        return [(begun.tick, begun.cell) for begun in self.begun if begun.reason == Reason.REMEMBERED]

    def uses(self, start: int, tick: int) -> list[int]:
        """For each cell, the number of remembered turns that used its content at a tick; as in `State.uses`."""
        held = [lesson["tick"] if lesson else start for lesson in self.last_lessons(start, tick)]
        uses = [old if begun < self.first_tick else 0 for old, begun in zip(self.uses_before, held, strict=True)]
        for begun, cell in self.turns():
            uses[cell] += held[cell] <= begun <= tick
        return uses

    def forget(self, first: int, start: int) -> None:
        """Drops everything before a tick but how often what the cells hold was used; lessons are not dropped here.

        Args:
            first: The first tick that stays.
            start: First tick since the run was started over, before that.
        """
        self.uses_before = self.uses(start, first - 1)
        del self.poses_flat[: (first - self.first_tick) * AXES]
        del self.rows_flat[: (first - self.first_tick) * len(ROW)]
        self.memories, self.trials = since(self.memories, first), since(self.trials, first)
        self.begun = [begun for begun in self.begun if begun.tick >= first]
        self.meals = [tick for tick in self.meals if tick >= first]
        self.first_tick = first

    def known(self, start: int, tick: int) -> Learned:
        """What the robot knew after a retained tick; start is the first tick since the run was started over."""
        lessons = self.last_lessons(start, tick)
        return Learned(
            memory=at(self.memories, tick),
            uses=self.uses(start, tick),
            learned=[lesson["tick"] if lesson else -1 for lesson in lessons],
            by_hand=[lesson["by_hand"] if lesson else 0 for lesson in lessons],
            frozen=self.row(tick)[ROW.index("frozen")],
            trial=at(self.trials, tick),
        )

    def last_lessons(self, start: int, tick: int) -> list[Lesson | None]:
        """For each cell, its last change from tick `start` up to a tick; None if there was none."""
        last: list[Lesson | None] = [None] * CELL_COUNT
        for lesson in self.lessons:
            if start <= lesson["tick"] <= tick:
                last[lesson["cell"]] = lesson
        return last


@dataclass
class Trajectory:
    """The visible part of a run, recorded by a `RunRecorder`.

    Attributes:
        params: The dimensions of the world.
        boredom_limit: Number of remembered turns in a row at which a robot is bored.
        tracks: The robots, in the order of their nodes.
        scenes: The environments, each again after every change by a person.
        news: What changed in the world and the bodies, in sentences.
        meals: For each piece of the scene's food, 1 if it was eaten, else 0.
        environments: Number of environments so far, including those that are no longer retained.
    """

    params: SimParams
    boredom_limit: int
    tracks: list[RobotTrack]
    scenes: Changes[EnvironmentScene] = field(default_factory=list)
    meals: Changes[list[int]] = field(default_factory=list)
    environments: int = 0
    news: list[News] = field(default_factory=list)

    @property
    def first_tick(self) -> int:
        """The first tick that is retained."""
        return self.tracks[0].first_tick

    @property
    def ticks(self) -> int:
        """The number of ticks so far, including those that are no longer retained."""
        return self.tracks[0].ticks

    def at(self, tick: int, robot: int = 0) -> State:
        """The state of a robot after a tick, equal to that of `view.state.state` at the time.

        Args:
            tick: Number of the tick.
            robot: Index of the robot in `tracks`.

        Raises:
            IndexError: The tick does not exist, or is no longer retained.
        """
        if not self.first_tick <= tick < self.ticks:
            raise IndexError(f"tick {tick} of {self.first_tick}..{self.ticks - 1}")
        track = self.tracks[robot]
        known = track.known(at(self.scenes, tick)["start_tick"], tick)
        return state(track.node, tick, track.pose(tick), track.row(tick), known, at(self.meals, tick))

    def events(self, robot: int = 0) -> list[Event]:
        """A robot's events in the order of their ticks."""
        track = self.tracks[robot]
        lessons = (lesson for lesson in track.lessons if not lesson["by_hand"])
        return sorted(
            (
                *(Event(tick, "environment") for tick in self.begun()),
                *(Event(tick, "change") for tick in dict.fromkeys(tick for tick, _ in self.retained_news())),
                *(Event(tick, "trial") for tick in track.ticks_of(Reason.TRIAL)),
                *(Event(tick, "boredom") for tick in track.ticks_of(Reason.BOREDOM)),
                *(Event(lesson["tick"], "lesson") for lesson in lessons if lesson["tick"] >= self.first_tick),
                *(Event(tick, "eat") for tick in track.meals if tick >= self.first_tick),
            )
        )

    def retained_news(self) -> list[News]:
        """The news of the ticks that are retained."""
        return [news for news in self.news if self.first_tick <= news[0] < self.ticks]

    def begun(self) -> list[int]:
        """The first tick of each retained environment."""
        numbers = [(0, 0), *((tick, scene["number"]) for tick, scene in self.scenes)]
        return [tick for (_, old), (tick, new) in pairwise(numbers) if new != old]


def at(changes: Sequence[tuple[int, T]], tick: int) -> T:
    """The value that holds at a tick."""
    return changes[bisect_right(changes, tick, key=itemgetter(0)) - 1][1]


def since(changes: Changes[T], first: int) -> Changes[T]:
    """The changes from a tick on, beginning with the value at that tick."""
    return [(first, at(changes, first)), *(change for change in changes if change[0] > first)]
