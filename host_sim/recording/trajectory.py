"""A run, tick by tick, as there is to see of it: what a page to keep, an animation and the tests are made from."""

from array import array
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from operator import itemgetter
from struct import Struct
from typing import NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from host_sim.robot_io import Drive, Senses
from host_sim.view.history import LearningHistory, Lesson, Trial
from host_sim.view.state import EnvironmentScene, State
from host_sim.world.geometry import Pose
from host_sim.world.params import SimParams

T = TypeVar("T")
Changes = list[tuple[int, T]]
"""What changes seldom: from which tick on, and what."""

TICKS_MAX = 1_000_000
"""Of longer runs the last environments are kept: 58 MB, and some 5 MB as a page."""

_REMEMBERED, _TRIAL, _BOREDOM = 4, 5, 6
_ROW = (*Senses._fields, *Drive._fields, "pattern", "lifted", "frozen")
_PACKED = Struct(f"={len(_ROW)}h")
_AXES = len(Pose._fields)


class Body(Protocol):
    """As much of an arena as a trajectory takes down."""

    @property
    def pose(self) -> Pose:
        """Where the robot is and looks."""

    @property
    def lifted(self) -> bool:
        """Whether a person holds the robot in the air."""

    @property
    def eaten(self) -> Sequence[bool]:
        """For each piece of food, whether it has been eaten."""


class Event(NamedTuple):
    """Something to jump to: kind is environment, trial, lesson, boredom or eat."""

    tick: int
    kind: str


@dataclass
class Trajectory:
    """Grows tick by tick, as far as `TICKS_MAX` and the environment under way.

    Attributes:
        params: The measures.
        boredom_limit: The remembered turn in a row after which the robot is bored.
        first_tick: The first tick that is kept.
        scenes: The environments, and what people made of them.
        memories: The eight cells.
        meals: For each piece of the scene's food, 1 if it is eaten.
        trials: The last trial, under way or judged.
        lessons: All that was learned or written by hand.
    """

    params: SimParams
    boredom_limit: int = 10
    first_tick: int = 0
    scenes: Changes[EnvironmentScene] = field(default_factory=list)
    memories: Changes[list[int]] = field(default_factory=list)
    meals: Changes[list[int]] = field(default_factory=list)
    trials: Changes[Trial | None] = field(default_factory=list)
    lessons: list[Lesson] = field(default_factory=list)
    _poses: "array[float]" = field(default_factory=lambda: array("d"))
    _rows: "array[int]" = field(default_factory=lambda: array("h"))
    _old_turns: list[tuple[int, int]] = field(default_factory=list)
    _action: int = -1
    _memory: Sequence[int] = ()

    @property
    def ticks(self) -> int:
        """The number of ticks so far, those no longer kept too."""
        return self.first_tick + len(self._poses) // _AXES

    def enter(self, scene: EnvironmentScene) -> None:
        """An environment begins with the next tick, or a person has changed the present one."""
        self.scenes.append((self.ticks, scene))
        self._action = -1
        begun = [scene["first_tick"] for _, scene in self.scenes]
        self._forget(next((first for first in begun if self.ticks - first <= TICKS_MAX), begun[-1]))

    def add(self, body: Body, senses: Senses, drive: Drive, history: LearningHistory) -> None:
        """Adds a tick: `senses` and `drive` are the tick's, `body` has moved and `story` has taken it."""
        if drive.action != self._action or drive.eat or history.memory is not self._memory:
            self._action, self._memory = drive.action, history.memory
            self._add_changes(body, history)
        self._poses.extend(body.pose)
        self._rows.frombytes(_PACKED.pack(*senses, *drive, history.pattern, body.lifted, history.frozen))

    def at(self, tick: int) -> State:
        """The state after a tick, equal to what `scene.state` said then.

        Raises:
            IndexError: There is no such tick, or it is kept no longer.
        """
        if not self.first_tick <= tick < self.ticks:
            raise IndexError(f"tick {tick} of {self.first_tick}..{self.ticks - 1}")
        at_row = tick - self.first_tick
        row = dict(zip(_ROW, self._rows[at_row * len(_ROW) : (at_row + 1) * len(_ROW)], strict=True))
        x, y, heading = self._poses[at_row * _AXES : (at_row + 1) * _AXES]
        return State(
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
            memory=at(self.memories, tick),
            uses=self._uses(tick),
            learned=self._learned(tick),
            frozen=row["frozen"],
            trial=at(self.trials, tick),
        )

    def poses(self) -> NDArray[np.float64]:
        """A view of the poses: shape (ticks, 3), x and y in mm, heading in rad. Add no tick while it lives."""
        return np.frombuffer(self._poses, np.float64).reshape(-1, _AXES)

    def column(self, name: str) -> NDArray[np.int16]:
        """A field of `Senses` or `Drive`, pattern, lifted or frozen, by tick. A view, as `poses` is."""
        return np.frombuffer(self._rows, np.int16).reshape(-1, len(_ROW))[:, _ROW.index(name)]

    def begun(self, reason: int) -> NDArray[np.int64]:
        """The ticks in which actions with that reason began."""
        news = np.diff(self.column("action"), prepend=np.int16(-1)) != 0
        return np.flatnonzero(news & (self.column("reason") == reason)) + self.first_tick

    def turns(self) -> list[tuple[int, int]]:
        """Each remembered turn of the whole run: its first tick, and the cell that it was remembered from."""
        ticks = self.begun(_REMEMBERED)
        cells = self.column("pattern")[ticks - self.first_tick]
        return [*self._old_turns, *zip(ticks.tolist(), cells.tolist(), strict=True)]

    def events(self) -> list[Event]:
        """All that can be jumped to, in the order of ticks."""
        first, lessons = self.first_tick, (lesson for lesson in self.lessons if not lesson["by_hand"])
        numbers = [(tick, scene["number"]) for tick, scene in self.scenes]
        return sorted(
            (
                *(Event(tick, "environment") for (_, old), (tick, new) in pairwise([(0, 0), *numbers]) if new != old),
                *(Event(tick, "trial") for tick in self.begun(_TRIAL).tolist()),
                *(Event(tick, "boredom") for tick in self.begun(_BOREDOM).tolist()),
                *(Event(lesson["tick"], "lesson") for lesson in lessons if lesson["tick"] >= first),
                *(Event(tick, "eat") for (_, old), (tick, new) in pairwise(self.meals) if sum(new) > sum(old)),
            )
        )

    def _add_changes(self, body: Body, history: LearningHistory) -> None:
        """Notes what can change with an action, a bite or a frame of the memory."""
        _note(self.memories, self.ticks, list(history.memory))
        _note(self.meals, self.ticks, [int(eaten) for eaten in body.eaten])
        _note(self.trials, self.ticks, history.trial)
        self.lessons = history.lessons

    def _forget(self, first: int) -> None:
        """Keeps only what is from a tick on."""
        if first > self.first_tick:
            self._old_turns = [turn for turn in self.turns() if turn[0] < first]
            del self._poses[: (first - self.first_tick) * _AXES]
            del self._rows[: (first - self.first_tick) * len(_ROW)]
            self.scenes, self.memories = _since(self.scenes, first), _since(self.memories, first)
            self.meals, self.trials = _since(self.meals, first), _since(self.trials, first)
            self.first_tick = first

    def _uses(self, tick: int) -> list[int]:
        cells = [cell for begun, cell in self.turns() if begun <= tick]
        return [cells.count(cell) for cell in range(8)]

    def _learned(self, tick: int) -> list[int]:
        learned = [-1] * 8
        for lesson in self.lessons:
            if lesson["tick"] <= tick:
                learned[lesson["cell"]] = lesson["tick"]
        return learned


def at(changes: Sequence[tuple[int, T]], tick: int) -> T:
    """What holds at a tick."""
    return changes[bisect_right(changes, tick, key=itemgetter(0)) - 1][1]


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
