"""What a robot has learned in a run: its trials and their results, its lessons, and the use of each cell."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypedDict

from host_sim.protocol.generated import CELL_COUNT, Reason
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
        by_hand: 1 if a person wrote or erased it, 0 if the robot learned it.
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
        memory: The eight cells.
        frozen: Whether learning is frozen; set by the caller that sends the command.
        pattern: The front sensors' pattern when the current action was decided, 0..7.
        uses: For each cell, the number of remembered turns that used its present content.
        learned: For each cell, the tick of its last change; -1 if there was none.
        by_hand: For each cell, 1 if a person made its last change, else 0.
        trial: The last trial, or None.
        trials: Number of trials.
        action: Number of the current action; -1 before the first.
        lessons: All lessons, in order.
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
    action: int = -1

    def take(self, tick: int, senses: Senses, drive: Drive, memory: Sequence[int]) -> None:
        """Adds a tick.

        Args:
            tick: Number of the tick, from the start of the run.
            senses: The senses of the tick.
            drive: The robot's answer.
            memory: The eight cells after the answer.
        """
        judged, begins = None, drive.action != self.action
        if begins:
            self.action = drive.action
            self.pattern = pattern_of(senses.feel)
            judged = self._judge()
        if memory != self.memory:
            self.relearn(tick, memory, judged)
        if begins:
            self._begin(tick, drive)

    def pass_over(self, drive: Drive, pattern: int) -> None:
        """Skips ticks in which no remembered turn and no trial began or ended, and the memory stayed the same.

        Args:
            drive: The robot's answer in the last of these ticks.
            pattern: The pattern when its action was decided.
        """
        self.action, self.pattern = drive.action, pattern

    def relearn(self, tick: int, memory: Sequence[int], trial: Trial | None = None) -> None:
        """Adds a lesson for each cell that changed.

        Args:
            tick: Number of the tick.
            memory: The eight cells now.
            trial: The trial that has just ended, if any: a change that it does not explain was made by hand.
        """
        for cell, (before, side) in enumerate(zip(self.memory, memory, strict=True)):
            if side != before:
                learned = trial is not None and (trial["cell"], trial["side"], trial["helped"]) == (cell, side, 1)
                self.lessons.append(Lesson(node=self.node, tick=tick, cell=cell, side=side, by_hand=int(not learned)))
                self.learned[cell], self.by_hand[cell], self.uses[cell] = tick, int(not learned), 0
        self.memory = memory

    def restart(self, tick: int, memory: Sequence[int]) -> None:
        """Begins anew, as the robot has been started again; earlier lessons stay in the list.

        Args:
            tick: Number of the next tick. Lessons of this tick are dropped: no tick of either run was after them.
            memory: The eight cells now.
        """
        while self.lessons and self.lessons[-1]["tick"] >= tick:
            self.lessons.pop()
        self.memory, self.frozen, self.trial = memory, False, None
        self.uses, self.by_hand, self.learned = [0] * CELL_COUNT, [0] * CELL_COUNT, [-1] * CELL_COUNT

    def _judge(self) -> Trial | None:
        """Ends the current trial, if any, with the senses that decide the next action, and returns it."""
        if self.trial is None or self.trial["helped"] is not None:
            return None
        fewer = self.pattern.bit_count() < self.trial["cell"].bit_count()
        self.trial = {**self.trial, "helped": int(fewer), "frozen": int(self.frozen)}
        return self.trial

    def _begin(self, tick: int, drive: Drive) -> None:
        if drive.reason == Reason.REMEMBERED:
            self.uses[self.pattern] += 1
        elif drive.reason == Reason.TRIAL:
            side = 1 if drive.left_mm_s < drive.right_mm_s else 2
            self.trial = Trial(tick=tick, cell=self.pattern, side=side, helped=None, frozen=0)
            self.trials += 1
