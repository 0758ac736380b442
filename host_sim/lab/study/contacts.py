"""Contacts: the times that a robot was blocked, from the first turn until the way was clear."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from host_sim.lab.study.tables import Row
from host_sim.protocol.generated import AVOIDING, ROW, Reason, Side
from host_sim.recording.history import pattern_of
from host_sim.sim.native_loop import NativeLoop
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import Memory, sides_of

PROPER = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}
"""The turn away from the obstacle, for each pattern with an obstacle on one side only."""

OTHER = {Side.NOTHING: Side.NOTHING, Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT}

_COLUMNS = [ROW.index(name) for name in ("feel", "reason", "action")]

Ticks = NDArray[np.int16]
"""Shape (ticks, 3): proximity bits, reason, and number of the action."""


class BodyState(NamedTuple):
    """Changes of a robot's world and body.

    Attributes:
        is_changed: Whether a change of the run's schedule has been made.
        is_reversed: Whether motors are swapped or sensors mirrored, but not both, so that turns go the wrong way.
    """

    is_changed: bool = False
    is_reversed: bool = False


def knows_wrong(sides: Sequence[int], body: BodyState) -> bool:
    """Whether the turn known for one of the patterns of `PROPER` leads toward the obstacle."""
    return any(sides[pattern] == (side if body.is_reversed else OTHER[side]) for pattern, side in PROPER.items())


def digits_of(sides: Sequence[int]) -> str:
    """The turns known for patterns 0 to 7, as digits: 0 nothing, 1 left, 2 right."""
    return "".join(str(int(side)) for side in sides)


T = TypeVar("T")

Course = list[tuple[int, T]]
"""History of a value in an environment: pairs of (first tick, value)."""


@dataclass
class ContactWatch:
    """Watches one robot in one environment, as `Simulation.watch` does.

    Attributes:
        index: Index of the robot, from 0.
        memories: History of the eight bytes, as reported.
    """

    index: int
    memories: Course[Memory] = field(default_factory=list)
    _bodies: Course[BodyState] = field(default_factory=list)
    _ticks: list[Ticks] = field(default_factory=list)
    _count: int = 0

    def __call__(self, simulation: Simulation) -> None:
        """Takes the ticks of the last step."""
        _note(self._bodies, self._count, _state(simulation, self.index))
        if simulation.loop is None:
            feel, drive = simulation.senses[self.index].feel, simulation.drives[self.index]
            ticks = np.array([[feel, drive.reason, drive.action]], np.int16)
        else:
            ticks = _ticks_of(simulation.loop, self.index)
        self._ticks.append(ticks)
        self._count += len(ticks)
        _note(self.memories, self._count, simulation.clients[self.index].memory)

    def contacts(self, tick_s: float) -> list[Row]:
        """The environment's contacts: rows of a study's table, but for run and environment."""
        found = _contacts(np.concatenate(self._ticks), self.memories, self._bodies, tick_s) if self._ticks else ()
        return [{"robot": self.index, **contact} for contact in found]

    @property
    def body(self) -> BodyState:
        """Changes of the body so far."""
        return self._bodies[-1][1]


def _ticks_of(loop: NativeLoop, index: int) -> Ticks:
    return np.frombuffer(loop.block(index).rows, np.int16).reshape(-1, len(ROW))[:, _COLUMNS]


def _state(simulation: Simulation, index: int) -> BodyState:
    faults = simulation.arena.bodies[index].faults
    return BodyState(bool(simulation.record.happened), faults.swapped != faults.mirrored)


def _note(course: Course[T], ticks: int, value: T) -> None:
    if not course or course[-1][1] != value:
        course.append((ticks, value))


def _at(course: Course[T], tick: int) -> T:
    """The value at a tick; before the first entry, the first value."""
    return next((value for begun, value in reversed(course) if begun <= tick), course[0][1])


def _contacts(ticks: Ticks, memories: Course[Memory], bodies: Course[BodyState], tick_s: float) -> Iterator[Row]:
    feel, reason, action = ticks.T
    avoiding = np.isin(reason, AVOIDING)
    edges = np.flatnonzero(np.diff(avoiding, prepend=False, append=False))
    begun = np.diff(action, prepend=np.int16(-1)) != 0
    for first, end in edges.reshape(-1, 2).tolist():
        turns, body = reason[first:end][begun[first:end]].tolist(), _at(bodies, first)
        sides = sides_of(_at(memories, end + 1))  # the tick that finds the way clear reports the last lesson
        yield {
            "changed": body.is_changed,
            "begun_s": round(first * tick_s, 3),
            "pattern": pattern_of(int(feel[first])),
            "blocked_s": round((end - first) * tick_s, 3),
            "trials": turns.count(Reason.TRIAL),
            "remembered": turns.count(Reason.REMEMBERED),
            "boredoms": turns.count(Reason.BOREDOM),
            "cleared": end < len(ticks),
            "sides": digits_of(sides),
            "wrong": knows_wrong(sides, body),
        }
