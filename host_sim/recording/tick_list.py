"""The ticks of a recording, kept in little room: a run of an hour has 180,000."""

from array import array
from collections.abc import Iterator
from typing import NamedTuple

from host_sim.robot_io import Drive, Senses


class Tick(NamedTuple):
    """One control tick.

    Attributes:
        senses: The body's senses.
        drive: The drive that the body applied: the robot's answer, or an earlier one that was still held.
        memory: The robot's eight cells when it answered.
        frozen: Whether learning was frozen.
        started: The robot's eight cells when it was started again since the tick before; None if it was not.
        written: Its eight cells after each report between the two ticks, since it was started if it was.
    """

    senses: Senses
    drive: Drive
    memory: tuple[int, ...]
    frozen: bool
    started: tuple[int, ...] | None = None
    written: tuple[tuple[int, ...], ...] = ()


_SENSES, _ALL = len(Senses._fields), len(Senses._fields) + len(Drive._fields)


class TickList:
    """Ticks in their order, like a list that can only grow."""

    def __init__(self) -> None:
        """Has no ticks."""
        self._numbers = array("h")  # of each tick, the fields of its senses, then those of its drive
        self._frozen = bytearray()
        self._memories: list[tuple[int, ...]] = []
        self._memory = array("L")  # of each tick, the place of its memory
        self._started: dict[int, tuple[int, ...]] = {}
        self._written: dict[int, tuple[tuple[int, ...], ...]] = {}

    def __len__(self) -> int:
        return len(self._frozen)

    def __iter__(self) -> Iterator[Tick]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, i: int) -> Tick:
        i = range(len(self))[i]
        numbers = self._numbers[i * _ALL : (i + 1) * _ALL].tolist()
        return Tick(
            _senses(numbers[:_SENSES]),
            _drive(numbers[_SENSES:]),
            self._memories[self._memory[i]],
            bool(self._frozen[i]),
            self._started.get(i),
            self._written.get(i, ()),
        )

    def append(self, tick: Tick) -> None:
        """Adds a tick at the end."""
        if tick.started is not None:
            self._started[len(self)] = tick.started
        if tick.written:
            self._written[len(self)] = tick.written
        self._numbers.extend(tick.senses)
        self._numbers.extend(tick.drive)
        self._frozen.append(tick.frozen)
        if not self._memories or self._memories[-1] != tick.memory:
            self._memories.append(tick.memory)
        self._memory.append(len(self._memories) - 1)


def _senses(numbers: list[int]) -> Senses:
    senses = Senses._make(numbers)
    return senses._replace(bump=bool(senses.bump), look=bool(senses.look))


def _drive(numbers: list[int]) -> Drive:
    drive = Drive._make(numbers)
    return drive._replace(eat=bool(drive.eat))
