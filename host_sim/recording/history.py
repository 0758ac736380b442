"""A robot's learning history in a run: its trials and their results, its lessons, and the use of each cell."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from host_sim.protocol.generated import CELL_COUNT, ROW
from host_sim.recording.state_types import Learned, Lesson, Trial
from host_sim.world.memory_kinds import sides_of
from host_sim.world.world_library import world_library


class Cell(NamedTuple):
    """State of a cell from a tick on: see `State.uses`, `learned` and `by_hand`."""

    tick: int
    cell: int
    uses: int
    learned: int
    by_hand: int


class Note(NamedTuple):
    """A turn or a trial that began, or a trial that ended.

    Attributes:
        tick: Number of the tick.
        reason: Reason of the action that began.
        cell: Cell of the pattern when the action was decided.
        trial: The last trial, after it.
    """

    tick: int
    reason: int
    cell: Cell
    trial: Trial | None


def pattern_of(feel: int) -> int:
    """The pattern of the three front sensors: bit 0 front-right, bit 1 front, bit 2 front-left.

    >>> pattern_of(0b00110)
    3
    """
    return feel >> 1 & 7


class LearningHistory:
    """One robot's history, built from every tick of a run in order, in C (`host_sim/world/native/history.h`).

    Attributes:
        node: The robot's node number on the bus.
        lessons: All lessons that were not forgotten, in order.
        forgotten: Number of lessons that were forgotten.
        ticks: Number of ticks so far.
    """

    def __init__(self, node: int = 1, memory: Sequence[int] = (0,) * CELL_COUNT) -> None:
        """Starts with the eight bytes of a memory of any kind."""
        self.node, self.forgotten, self.ticks = node, 0, 0
        self.lessons: list[Lesson] = []
        self._ffi, self._library = world_library()
        self._in_c: Any = self._ffi.new("struct history *")
        self._notes: Any = self._ffi.new("struct history_note[]", 1)
        self._library.history_begin(self._in_c, sides_of(tuple(memory)))

    @property
    def memory(self) -> tuple[int, ...]:
        """The turn for each pattern."""
        return tuple(self._in_c.sides)

    @property
    def frozen(self) -> bool:
        """Whether learning is frozen; set by the caller that sends the command."""
        return bool(self._in_c.frozen)

    @frozen.setter
    def frozen(self, frozen: bool) -> None:
        self._in_c.frozen = frozen

    @property
    def pattern(self) -> int:
        """The front sensors' pattern when the current action was decided, 0..7."""
        return int(self._in_c.pattern)

    @property
    def trials(self) -> int:
        """Number of trials."""
        return int(self._in_c.trials)

    def known(self) -> Learned:
        """The robot's current knowledge."""
        now = self._in_c
        return Learned(
            memory=list(now.sides),
            uses=list(now.uses),
            learned=list(map(int, now.learned)),
            by_hand=list(now.by_hand),
            frozen=int(now.frozen),
            trial=_trial(now.trial),
        )

    def take(self, rows: Any) -> list[Note]:
        """Adds ticks, and fills in what their rows have of learning: `pattern` and `frozen`.

        Args:
            rows: A writable buffer: 16-bit numbers, those of `ROW` for each tick.
        """
        numbers = self._ffi.from_buffer("int16_t[]", rows)
        if (ticks := len(numbers) // len(ROW)) > len(self._notes):
            self._notes = self._ffi.new("struct history_note[]", ticks)
        count = self._library.history_take(self._in_c, self.ticks, numbers, ticks, self._notes)
        self.ticks += ticks
        if not count:
            return []
        return [_note(it) for it in self._notes[0:count]]

    def learn(self, memory: Sequence[int]) -> list[Cell]:
        """Adds a lesson for each pattern whose turn changed in the last tick: these are the eight bytes after it."""
        self._library.history_learn(self._in_c, self.ticks - 1, sides_of(tuple(memory)))
        return self._add_lessons(self.ticks - 1)

    def relearn(self, tick: int, memory: Sequence[int]) -> list[Cell]:
        """Adds a lesson for each pattern whose turn was changed from outside, by a person or another robot.

        Args:
            tick: Number of the next tick.
            memory: The eight bytes now.
        """
        self._library.history_relearn(self._in_c, tick, sides_of(tuple(memory)))
        return self._add_lessons(tick)

    def restart(self, tick: int, memory: Sequence[int]) -> None:
        """Starts over, as the robot was started again; earlier lessons stay in the list.

        Args:
            tick: Number of the next tick. Lessons of this tick are dropped: no tick of either run came after them.
            memory: The eight cells now.
        """
        while self.lessons and self.lessons[-1]["tick"] >= tick:
            self.lessons.pop()
        self._library.history_restart(self._in_c, sides_of(tuple(memory)))

    def forget_lessons(self, first: int) -> None:
        """Drops the lessons before a tick except the last one of each cell."""
        last = {lesson["cell"]: lesson for lesson in self.lessons if lesson["tick"] < first}
        kept = [lesson for lesson in self.lessons if lesson["tick"] >= first or lesson is last[lesson["cell"]]]
        self.forgotten += len(self.lessons) - len(kept)
        self.lessons[:] = kept

    def _add_lessons(self, tick: int) -> list[Cell]:
        lessons = self._in_c.lessons[0 : self._in_c.lesson_count]
        for it in lessons:
            self.lessons.append(Lesson(node=self.node, tick=tick, cell=it.cell, side=it.side, by_hand=it.by_hand))
        return [Cell(tick, it.cell, it.uses, tick, it.by_hand) for it in lessons]


def _note(it: Any) -> Note:
    """Converts a `struct history_note`."""
    cell = Cell(int(it.tick), it.cell, it.uses, int(it.learned), it.by_hand)
    return Note(cell.tick, it.reason, cell, _trial(it.trial))


def _trial(it: Any) -> Trial | None:
    """Converts a `struct history_trial`."""
    if it.tick < 0:
        return None
    helped = None if it.helped < 0 else it.helped
    return Trial(tick=int(it.tick), cell=it.cell, side=it.side, helped=helped, frozen=it.frozen)
