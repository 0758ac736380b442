"""What a robot has learned in a run: its trials and their results, its lessons, and the use of each cell."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, TypedDict

from host_sim.base.robot_io import Drive, Senses
from host_sim.protocol.generated import CELL_COUNT
from host_sim.protocol.memory_kinds import sides_of
from host_sim.world.world_library import world_library


class Trial(TypedDict):
    """A random turn, tried because the pattern's cell was empty.

    Attributes:
        tick: Tick in which it began.
        cell: The pattern, 1..7.
        side: Direction of the turn: 1 left, 2 right.
        helped: 1 if fewer front sensors were triggered afterwards, 0 if not; None during the turn.
        frozen: 1 if learning was frozen when it ended, else 0.
    """

    tick: int
    cell: int
    side: int
    helped: int | None
    frozen: int


class Lesson(TypedDict):
    """A change of a cell.

    Attributes:
        node: Node number of the robot.
        tick: Tick of the change.
        cell: The cell, 1..7.
        side: Its new content: 0 nothing, 1 left, 2 right.
        by_hand: 1 if a person wrote or erased it, 0 if the robot learned or forgot it.
    """

    node: int
    tick: int
    cell: int
    side: int
    by_hand: int


def pattern_of(feel: int) -> int:
    """The pattern of the three front sensors: bit 0 front-right, bit 1 front, bit 2 front-left.

    >>> pattern_of(0b00110)
    3
    """
    return feel >> 1 & 7


@dataclass
class LearningHistory:
    """One robot's history, built from every tick of a run in order, in C (`host_sim/world/native/history.h`).

    Attributes:
        node: The robot's node number on the bus.
        memory: The turn for each pattern, whatever kind of memory the robot has.
        frozen: Whether learning is frozen; set by the caller that sends the command.
        pattern: The front sensors' pattern when the current action was decided, 0..7.
        uses: For each cell, the number of remembered turns that used its present content.
        learned: For each cell, the tick of its last change; -1 if there was none.
        by_hand: For each cell, 1 if its last change came from outside, from a person or from another robot; else 0.
        trial: The last trial, or None.
        trials: Number of trials.
        action: Number of the current action; -1 before the first.
        lessons: All lessons that were not forgotten, in order.
        forgotten: Number of lessons that were forgotten.
    """

    node: int = 1
    memory: Sequence[int] = (0,) * CELL_COUNT
    frozen: bool = False
    pattern: int = 0
    uses: list[int] = field(default_factory=lambda: [0] * CELL_COUNT)
    learned: list[int] = field(default_factory=lambda: [-1] * CELL_COUNT)
    by_hand: list[int] = field(default_factory=lambda: [0] * CELL_COUNT)
    trial: Trial | None = None
    trials: int = 0
    lessons: list[Lesson] = field(default_factory=list)
    forgotten: int = 0
    action: int = -1
    _in_c: Any = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        ffi, library = world_library()
        self._in_c = ffi.new("struct history *")
        self.memory = sides_of(tuple(self.memory))
        library.history_begin(self._in_c, self.memory)

    def take(self, tick: int, senses: Senses, drive: Drive, memory: Sequence[int]) -> None:
        """Adds a tick.

        Args:
            tick: Number of the tick, from the start of the run.
            senses: The senses of the tick.
            drive: The robot's answer.
            memory: The eight bytes after the answer.
        """
        _, library = world_library()
        self._in_c.frozen = self.frozen
        what = senses.feel, drive.left_mm_s, drive.right_mm_s, drive.reason, drive.action
        library.history_take(self._in_c, tick, [what], sides_of(tuple(memory)))
        self._refresh(tick)

    def pass_over(self, drive: Drive, pattern: int) -> None:
        """Skips ticks in which no remembered turn and no trial began or ended, and the memory stayed the same.

        Args:
            drive: The robot's answer in the last of these ticks.
            pattern: The pattern when its action was decided.
        """
        _, library = world_library()
        library.history_pass_over(self._in_c, [(0, 0, 0, drive.reason, drive.action)], pattern)
        self.action, self.pattern = drive.action, pattern

    def relearn(self, tick: int, memory: Sequence[int]) -> None:
        """Adds a lesson for each pattern whose turn changed: it was told, by a person or by another robot.

        Args:
            tick: Number of the tick.
            memory: The eight bytes now.
        """
        _, library = world_library()
        library.history_relearn(self._in_c, tick, sides_of(tuple(memory)))
        self._refresh(tick)

    def restart(self, tick: int, memory: Sequence[int]) -> None:
        """Begins anew, as the robot has been started again; earlier lessons stay in the list.

        Args:
            tick: Number of the next tick. Lessons of this tick are dropped: no tick of either run was after them.
            memory: The eight cells now.
        """
        _, library = world_library()
        while self.lessons and self.lessons[-1]["tick"] >= tick:
            self.lessons.pop()
        library.history_restart(self._in_c, sides_of(tuple(memory)))
        self.frozen = False
        self._refresh(tick)

    def forget_lessons(self, first: int) -> None:
        """Drops the lessons before a tick but the last one of each cell."""
        last = {lesson["cell"]: lesson for lesson in self.lessons if lesson["tick"] < first}
        kept = [lesson for lesson in self.lessons if lesson["tick"] >= first or lesson is last[lesson["cell"]]]
        self.forgotten += len(self.lessons) - len(kept)
        self.lessons[:] = kept

    def _refresh(self, tick: int) -> None:
        """Takes over what C code knows now, and its lessons of a tick."""
        ffi, _ = world_library()
        now = self._in_c
        self.memory, self.action, self.pattern, self.trials = tuple(now.sides), now.action, now.pattern, now.trials
        self.uses, self.by_hand = ffi.unpack(now.uses, CELL_COUNT), ffi.unpack(now.by_hand, CELL_COUNT)
        self.learned = list(map(int, now.learned))
        self.trial = _trial(now.trial)
        for it in now.lessons[0 : now.lesson_count]:
            self.lessons.append(Lesson(node=self.node, tick=tick, cell=it.cell, side=it.side, by_hand=it.by_hand))


def _trial(it: Any) -> Trial | None:
    """A trial, from a `struct history_trial`."""
    if it.tick < 0:
        return None
    helped = None if it.helped < 0 else it.helped
    return Trial(tick=int(it.tick), cell=it.cell, side=it.side, helped=helped, frozen=it.frozen)
