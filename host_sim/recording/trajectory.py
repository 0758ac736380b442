"""The visible part of a run, tick by tick. Pages, pictures and animations are made from it."""

from array import array
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from operator import itemgetter
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from host_sim.protocol.generated import CELL_COUNT, ROW, Reason
from host_sim.recording.history import Cell
from host_sim.recording.phrases import News
from host_sim.recording.state import state
from host_sim.recording.state_types import EnvironmentScene, Learned, Lesson, State, Trial
from host_sim.world.geometry import Pose, SimParams

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

T = TypeVar("T")
Changes = list[tuple[int, T]]
"""The history of a value that changes rarely: pairs of (first tick, value)."""

AXES = len(Pose._fields)


class Event(NamedTuple):
    """An event that a page can jump to; `kind` is environment, change, trial, lesson, boredom or eat."""

    tick: int
    kind: str


_EVENT_OF = {Reason.TRIAL: "trial", Reason.BOREDOM: "boredom"}

NEW_CELLS = [Cell(0, cell, uses=0, learned=-1, by_hand=0) for cell in range(CELL_COUNT)]
"""State of the cells of a robot that has just been started."""


@dataclass
class RobotTrack:
    """One robot's part of a run.

    Attributes:
        node: Its node number on the bus.
        first_tick: The first tick that is retained.
        memories: The eight cells.
        trials: The last trial, current or ended.
        lessons: Changes of cells, learned or by hand; before `first_tick`, only the last of each cell.
        meals: Ticks in which it ate.
        poses_flat: x and y in mm, heading in rad, tick after tick.
        rows_flat: The fields of `ROW`, 16 bits each, tick after tick.
        begun: Ticks in which trials and about-faces began, each with the reason.
        cells: History of the cells: each change, in order.
    """

    node: int
    first_tick: int = 0
    memories: Changes[list[int]] = field(default_factory=list)
    trials: Changes[Trial | None] = field(default_factory=list)
    lessons: list[Lesson] = field(default_factory=list)
    meals: list[int] = field(default_factory=list)
    poses_flat: "array[float]" = field(default_factory=lambda: array("d"))
    rows_flat: "array[int]" = field(default_factory=lambda: array("h"))
    begun: list[tuple[int, int]] = field(default_factory=list)
    cells: list[Cell] = field(default_factory=NEW_CELLS.copy)

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
        import numpy as np  # noqa: PLC0415 - most commands do without

        return np.frombuffer(self.poses_flat, np.float64).reshape(-1, AXES)

    def column(self, name: str) -> "array[int]":
        """One field of `ROW`, tick after tick."""
        return self.rows_flat[ROW.index(name) :: len(ROW)]

    def trail(self, first: int, end: int) -> list[tuple[float, float, int]]:
        """For each tick from `first` to before `end`: x and y in mm after it, and the reason of its drive."""
        begin, stop = (AXES * (tick - self.first_tick) for tick in (first, end))
        reasons = self.column("reason")[begin // AXES : stop // AXES]
        return list(zip(*(self.poses_flat[begin + axis : stop : AXES] for axis in (0, 1)), reasons, strict=True))

    def ticks_of(self, reason: Reason) -> list[int]:
        """The retained ticks in which turns for a reason began."""
        return [tick for tick, why in self.begun if why == reason]

    def cells_at(self, tick: int) -> list[Cell]:
        """State of each cell after a retained tick."""
        return list({it.cell: it for it in self.cells[: bisect_right(self.cells, tick, key=itemgetter(0))]}.values())

    def forget(self, first: int) -> None:
        """Drops everything before a tick, except for the state of the cells; lessons are not dropped here."""
        del self.poses_flat[: (first - self.first_tick) * AXES]
        del self.rows_flat[: (first - self.first_tick) * len(ROW)]
        self.memories, self.trials = since(self.memories, first), since(self.trials, first)
        held = [it._replace(tick=first) for it in self.cells_at(first - 1)]
        self.cells = [*held, *(it for it in self.cells if it.tick >= first)]
        self.begun = [begun for begun in self.begun if begun[0] >= first]
        self.meals = [tick for tick in self.meals if tick >= first]
        self.first_tick = first

    def known(self, tick: int) -> Learned:
        """The robot's knowledge after a retained tick."""
        cells = self.cells_at(tick)
        return Learned(
            memory=at(self.memories, tick),
            uses=[it.uses for it in cells],
            learned=[it.learned for it in cells],
            by_hand=[it.by_hand for it in cells],
            frozen=self.row(tick)[ROW.index("frozen")],
            trial=at(self.trials, tick),
        )


@dataclass
class Trajectory:
    """The visible part of a run, recorded by a `RunRecorder`.

    Attributes:
        params: The dimensions of the world.
        boredom_limit: Number of remembered turns in a row at which a robot is bored.
        tracks: The robots, in the order of their nodes.
        scenes: The environments, each repeated after every change by a person.
        news: Changes of the world and the bodies, in sentences.
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
        """The state of a robot, by its index in `tracks`, after a tick; equal to `state.state` then.

        Raises:
            IndexError: The tick does not exist, or is no longer retained.
        """
        if not self.first_tick <= tick < self.ticks:
            raise IndexError(f"tick {tick} of {self.first_tick}..{self.ticks - 1}")
        track = self.tracks[robot]
        return state(track.node, tick, track.pose(tick), track.row(tick), track.known(tick), at(self.meals, tick))

    def events(self, robot: int = 0, first: int = 0) -> list[Event]:
        """A robot's events from a tick on, in the order of their ticks."""
        track, first = self.tracks[robot], max(first, self.first_tick)
        turns, lessons = _from(track.begun, first), _from(track.lessons, first, "tick")
        return sorted(
            (
                *(Event(tick, "environment") for tick in self.begun(first)),
                *(Event(tick, "change") for tick in dict.fromkeys(tick for tick, _ in self.retained_news(first))),
                *(Event(tick, _EVENT_OF[reason]) for tick, reason in turns),
                *(Event(lesson["tick"], "lesson") for lesson in lessons if not lesson["by_hand"]),
                *(Event(tick, "eat") for tick in track.meals[bisect_left(track.meals, first) :]),
            )
        )

    def retained_news(self, first: int = 0) -> list[News]:
        """The news from a tick on, of the ticks that are retained."""
        return [news for news in _from(self.news, max(first, self.first_tick)) if news[0] < self.ticks]

    def begun(self, first: int = 0) -> list[int]:
        """The first tick of each retained environment that begins at a tick or later."""
        begun = dict.fromkeys(scene["first_tick"] for _, scene in _from(self.scenes, first))
        return [tick for tick in begun if tick >= first]


def _from(entries: Sequence[Any], first: int, key: int | str = 0) -> Sequence[Any]:
    """The entries of a tick or later, of some in the order of their ticks."""
    return entries[bisect_left(entries, first, key=itemgetter(key)) :]


def at(changes: Sequence[tuple[int, T]], tick: int) -> T:
    """The value that holds at a tick."""
    return changes[bisect_right(changes, tick, key=itemgetter(0)) - 1][1]


def since(changes: Changes[T], first: int) -> Changes[T]:
    """The changes from a tick on, starting with the value at that tick."""
    return [(first, at(changes, first)), *(change for change in changes if change[0] > first)]
