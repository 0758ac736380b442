"""Contacts: the times that a robot was blocked, from the first turn until the way was clear."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from host_sim.protocol.generated import AVOIDING, ROW, Reason
from host_sim.recording.history import pattern_of
from host_sim.sim.native_loop import NativeLoop
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import Memory, sides_of

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


T = TypeVar("T")

Course = list[tuple[int, T]]
"""History of a value in an environment: pairs of (first tick, value)."""


@dataclass(frozen=True)
class Contact:
    """A contact: a time that a robot was blocked.

    Attributes:
        tick: Tick of its environment in which it began.
        pattern: Pattern of the front sensors then, 1..7.
        blocked_ticks: Ticks until the way was clear.
        trials: Number of random turns.
        remembered: Number of remembered turns.
        boredoms: Number of about-faces.
        cleared: Whether the way became clear; if not, the environment ended first.
        body: State of the body at the start.
        sides: The turn known for each pattern at the end: 0 nothing, 1 left, 2 right.
    """

    tick: int
    pattern: int
    blocked_ticks: int
    trials: int
    remembered: int
    boredoms: int
    cleared: bool
    body: BodyState
    sides: Memory

    @property
    def turns(self) -> int:
        """Number of all turns."""
        return self.trials + self.remembered + self.boredoms


@dataclass
class ContactWatch:
    """Watches one robot in one environment, as `Simulation.watch` does.

    Attributes:
        index: Index of the robot, from 0.
    """

    index: int
    _ticks: list[Ticks] = field(default_factory=list)
    _count: int = 0
    _memories: Course[Memory] = field(default_factory=list)
    _bodies: Course[BodyState] = field(default_factory=list)

    def __call__(self, simulation: Simulation) -> None:
        """Takes the ticks of the last step."""
        _note(self._bodies, self._count, _state(simulation, self.index))
        if simulation.loop is None:
            feel, drive = simulation.senses[self.index].feel, simulation.drives[self.index]
            self._add(np.array([[feel, drive.reason, drive.action]], np.int16))
        else:
            self._add(_ticks_of(simulation.loop, self.index))
        _note(self._memories, self._count, simulation.clients[self.index].memory)

    def contacts(self) -> list[Contact]:
        """The contacts of the environment."""
        if not self._ticks:
            return []
        return list(_contacts(np.concatenate(self._ticks), self._memories, self._bodies))

    @property
    def memories(self) -> Course[Memory]:
        """History of the eight bytes, as reported."""
        return self._memories

    @property
    def body(self) -> BodyState:
        """Changes of the body so far."""
        return self._bodies[-1][1]

    def _add(self, ticks: Ticks) -> None:
        self._ticks.append(ticks)
        self._count += len(ticks)


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


def _contacts(ticks: Ticks, memories: Course[Memory], bodies: Course[BodyState]) -> Iterator[Contact]:
    feel, reason, action = ticks.T
    avoiding = np.isin(reason, AVOIDING)
    edges = np.flatnonzero(np.diff(avoiding, prepend=False, append=False))
    begun = np.diff(action, prepend=np.int16(-1)) != 0
    for first, end in edges.reshape(-1, 2).tolist():
        turns = reason[first:end][begun[first:end]].tolist()
        yield Contact(
            tick=first,
            pattern=pattern_of(int(feel[first])),
            blocked_ticks=end - first,
            trials=turns.count(Reason.TRIAL),
            remembered=turns.count(Reason.REMEMBERED),
            boredoms=turns.count(Reason.BOREDOM),
            cleared=end < len(ticks),
            body=_at(bodies, first),
            sides=sides_of(_at(memories, end + 1)),  # the tick that finds the way clear reports the last lesson
        )
