"""What a robot has learned in a run: its trials and their results, its lessons, and the use of each cell."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypedDict

from host_sim.protocol.generated import CELL_COUNT, Reason
from host_sim.protocol.memory_kinds import sides_of
from host_sim.robot_io import Drive, Senses


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
    """One robot's history, built from every tick of a run in order.

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
    _reason: int = Reason.STOP

    def __post_init__(self) -> None:
        self.memory = sides_of(tuple(self.memory))

    def take(self, tick: int, senses: Senses, drive: Drive, memory: Sequence[int]) -> None:
        """Adds a tick.

        Args:
            tick: Number of the tick, from the start of the run.
            senses: The senses of the tick.
            drive: The robot's answer.
            memory: The eight bytes after the answer.
        """
        judged, forgets, begins = None, False, drive.action != self.action
        if begins:
            self.action = drive.action
            self.pattern = pattern_of(senses.feel)
            judged = self._judge()
            forgets = Reason.REMEMBERED in (drive.reason, self._reason) or drive.reason == Reason.BOREDOM
        self.relearn(tick, memory, judged, forgets=forgets)
        if begins:
            self._begin(tick, drive)

    def pass_over(self, drive: Drive, pattern: int) -> None:
        """Skips ticks in which no remembered turn and no trial began or ended, and the memory stayed the same.

        Args:
            drive: The robot's answer in the last of these ticks.
            pattern: The pattern when its action was decided.
        """
        self.action, self._reason, self.pattern = drive.action, drive.reason, pattern

    def relearn(self, tick: int, memory: Sequence[int], trial: Trial | None = None, *, forgets: bool = False) -> None:
        """Adds a lesson for each pattern whose turn changed.

        Args:
            tick: Number of the tick.
            memory: The eight bytes now.
            trial: The trial that has just ended, if any: a turn that it does not explain was told, by
                a person or by another robot.
            forgets: Whether the robot itself may just have erased what it used.
        """
        sides = sides_of(tuple(memory))
        if sides == self.memory:
            return
        for cell, (before, side) in enumerate(zip(self.memory, sides, strict=True)):
            if side != before:
                learned = trial is not None and (trial["cell"], trial["side"], trial["helped"]) == (cell, side, 1)
                itself = learned or (forgets and not side)
                self.lessons.append(Lesson(node=self.node, tick=tick, cell=cell, side=side, by_hand=int(not itself)))
                self.learned[cell], self.by_hand[cell], self.uses[cell] = tick, int(not itself), 0
        self.memory = sides

    def restart(self, tick: int, memory: Sequence[int]) -> None:
        """Begins anew, as the robot has been started again; earlier lessons stay in the list.

        Args:
            tick: Number of the next tick. Lessons of this tick are dropped: no tick of either run was after them.
            memory: The eight cells now.
        """
        while self.lessons and self.lessons[-1]["tick"] >= tick:
            self.lessons.pop()
        self.memory, self.frozen, self.trial = sides_of(tuple(memory)), False, None
        self.uses, self.by_hand, self.learned = [0] * CELL_COUNT, [0] * CELL_COUNT, [-1] * CELL_COUNT

    def forget_lessons(self, first: int) -> None:
        """Drops the lessons before a tick but the last one of each cell."""
        last = {lesson["cell"]: lesson for lesson in self.lessons if lesson["tick"] < first}
        kept = [lesson for lesson in self.lessons if lesson["tick"] >= first or lesson is last[lesson["cell"]]]
        self.forgotten += len(self.lessons) - len(kept)
        self.lessons[:] = kept

    def _judge(self) -> Trial | None:
        """Ends the current trial, if any, with the senses that decide the next action, and returns it."""
        if self.trial is None or self.trial["helped"] is not None:
            return None
        fewer = self.pattern.bit_count() < self.trial["cell"].bit_count()
        self.trial = {**self.trial, "helped": int(fewer), "frozen": int(self.frozen)}
        return self.trial

    def _begin(self, tick: int, drive: Drive) -> None:
        self._reason = drive.reason
        if drive.reason == Reason.REMEMBERED:
            self.uses[self.pattern] += 1
        elif drive.reason == Reason.TRIAL:
            side = 1 if drive.left_mm_s < drive.right_mm_s else 2
            self.trial = Trial(tick=tick, cell=self.pattern, side=side, helped=None, frozen=0)
            self.trials += 1
