"""A run, tick by tick, as there is to see of it: what pages, pictures, animations and the tests are made from."""

from array import array
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from operator import itemgetter
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from host_sim.protocol.generated import CELL_COUNT, Reason
from host_sim.robot_io import Drive, Senses
from host_sim.view.history import Lesson, Trial
from host_sim.view.state import EnvironmentScene, State
from host_sim.world.geometry import Pose
from host_sim.world.params import SimParams

T = TypeVar("T")
Changes = list[tuple[int, T]]
"""What changes seldom: from which tick on, and what."""

ROW = (*Senses._fields, *Drive._fields, "pattern", "lifted", "frozen")
"""What is kept of a robot at each tick, in 16 bits each, beside its pose."""

AXES = len(Pose._fields)


class Event(NamedTuple):
    """Something to jump to: kind is environment, trial, lesson, boredom or eat."""

    tick: int
    kind: str


@dataclass
class RobotTrack:
    """One robot's part of a run.

    Attributes:
        node: Its number on the bus.
        first_tick: The first tick that is kept.
        memories: The eight cells.
        trials: The last trial, under way or judged.
        lessons: All that was learned or written by hand.
        meals: The ticks in which it ate.
        poses_flat: x and y in mm, heading in rad, tick after tick.
        rows_flat: The fields of `ROW`, tick after tick.
        old_turns: Remembered turns of ticks that are no longer kept.
    """

    node: int
    first_tick: int = 0
    memories: Changes[list[int]] = field(default_factory=list)
    trials: Changes[Trial | None] = field(default_factory=list)
    lessons: list[Lesson] = field(default_factory=list)
    meals: list[int] = field(default_factory=list)
    poses_flat: "array[float]" = field(default_factory=lambda: array("d"))
    rows_flat: "array[int]" = field(default_factory=lambda: array("h"))
    old_turns: list[tuple[int, int]] = field(default_factory=list)

    @property
    def ticks(self) -> int:
        """The number of ticks so far, those no longer kept too."""
        return self.first_tick + len(self.poses_flat) // AXES

    def row(self, tick: int) -> dict[str, int]:
        """The fields of `ROW` at a tick that is kept."""
        at_row = tick - self.first_tick
        return dict(zip(ROW, self.rows_flat[at_row * len(ROW) : (at_row + 1) * len(ROW)], strict=True))

    def pose(self, tick: int) -> Pose:
        """The pose after a tick that is kept."""
        at_row = tick - self.first_tick
        return Pose(*self.poses_flat[at_row * AXES : (at_row + 1) * AXES])

    def poses(self) -> NDArray[np.float64]:
        """A view of the poses: shape (ticks, 3), x and y in mm, heading in rad. Add no tick while it lives."""
        return np.frombuffer(self.poses_flat, np.float64).reshape(-1, AXES)

    def column(self, name: str) -> NDArray[np.int16]:
        """A field of `ROW` by tick. A view, as `poses` is."""
        return np.frombuffer(self.rows_flat, np.int16).reshape(-1, len(ROW))[:, ROW.index(name)]

    def begun(self, reason: int) -> NDArray[np.int64]:
        """The ticks in which actions with that reason began."""
        news = np.diff(self.column("action"), prepend=np.int16(-1)) != 0
        return np.flatnonzero(news & (self.column("reason") == reason)) + self.first_tick

    def turns(self) -> list[tuple[int, int]]:
        """Each remembered turn of the whole run: its first tick, and the cell that it was remembered from."""
        ticks = self.begun(Reason.REMEMBERED)
        cells = self.column("pattern")[ticks - self.first_tick]
        return [*self.old_turns, *zip(ticks.tolist(), cells.tolist(), strict=True)]

    def uses(self, tick: int) -> list[int]:
        """How often each cell was used until a tick."""
        cells = [cell for begun, cell in self.turns() if begun <= tick]
        return [cells.count(cell) for cell in range(CELL_COUNT)]

    def learned(self, tick: int) -> list[int]:
        """For each cell, the tick of its last change until a tick; -1 if there was none."""
        learned = [-1] * CELL_COUNT
        for lesson in self.lessons:
            if lesson["tick"] <= tick:
                learned[lesson["cell"]] = lesson["tick"]
        return learned


@dataclass
class Trajectory:
    """All robots of a run. A `RunRecorder` lets it grow.

    Attributes:
        params: The measures.
        boredom_limit: The remembered turn in a row after which a robot is bored.
        tracks: The robots, in the order of their nodes.
        scenes: The environments, and what people made of them.
        meals: For each piece of the scene's food, 1 if it is eaten.
    """

    params: SimParams
    boredom_limit: int
    tracks: list[RobotTrack]
    scenes: Changes[EnvironmentScene] = field(default_factory=list)
    meals: Changes[list[int]] = field(default_factory=list)

    @property
    def first_tick(self) -> int:
        """The first tick that is kept."""
        return self.tracks[0].first_tick

    @property
    def ticks(self) -> int:
        """The number of ticks so far, those no longer kept too."""
        return self.tracks[0].ticks

    def at(self, tick: int, robot: int = 0) -> State:
        """The state of a robot after a tick, equal to what `view.state.state` said then.

        Args:
            tick: Which.
            robot: Its place among `tracks`.

        Raises:
            IndexError: There is no such tick, or it is kept no longer.
        """
        if not self.first_tick <= tick < self.ticks:
            raise IndexError(f"tick {tick} of {self.first_tick}..{self.ticks - 1}")
        track = self.tracks[robot]
        row, (x, y, heading) = track.row(tick), track.pose(tick)
        return State(
            node=track.node,
            tick=tick,
            x=round(x, 1),
            y=round(y, 1),
            heading=round(heading * 1000),
            lifted=row["lifted"],
            feel=row["feel"],
            bump=row["bump"],
            beacon=row["beacon_mm"],
            left=row["left_mm_s"],
            right=row["right_mm_s"],
            reason=row["reason"],
            repeat_count=row["repeat_count"],
            action=row["action"],
            pattern=row["pattern"],
            eaten=at(self.meals, tick),
            memory=at(track.memories, tick),
            uses=track.uses(tick),
            learned=track.learned(tick),
            frozen=row["frozen"],
            trial=at(track.trials, tick),
        )

    def events(self, robot: int = 0) -> list[Event]:
        """All of a robot's that can be jumped to, in the order of ticks."""
        track = self.tracks[robot]
        lessons = (lesson for lesson in track.lessons if not lesson["by_hand"])
        return sorted(
            (
                *(Event(tick, "environment") for tick in self.begun()),
                *(Event(tick, "trial") for tick in track.begun(Reason.TRIAL).tolist()),
                *(Event(tick, "boredom") for tick in track.begun(Reason.BOREDOM).tolist()),
                *(Event(lesson["tick"], "lesson") for lesson in lessons if lesson["tick"] >= self.first_tick),
                *(Event(tick, "eat") for tick in track.meals if tick >= self.first_tick),
            )
        )

    def begun(self) -> list[int]:
        """The first tick of each environment that is kept."""
        numbers = [(0, 0), *((tick, scene["number"]) for tick, scene in self.scenes)]
        return [tick for (_, old), (tick, new) in pairwise(numbers) if new != old]


def at(changes: Sequence[tuple[int, T]], tick: int) -> T:
    """What holds at a tick."""
    return changes[bisect_right(changes, tick, key=itemgetter(0)) - 1][1]
