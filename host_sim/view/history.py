"""What a robot has learned in a run so far: trials and their verdicts, lessons, how often each cell was used."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypedDict

from host_sim.protocol.generated import CELL_COUNT, Reason
from host_sim.robot_io import Drive, Senses


class Trial(TypedDict):
    """A random turn that was tried because the pattern's cell was empty.

    Attributes:
        tick: When it began.
        cell: The pattern.
        side: Which way it turned: 1 left, 2 right.
        helped: 1 if fewer front sensors saw something afterwards, 0 if not; None while the turn lasts.
    """

    tick: int
    cell: int
    side: int
    helped: int | None


class Lesson(TypedDict):
    """A cell that changed.

    Attributes:
        node: Whose.
        tick: When.
        cell: Which, 1..7.
        side: What it holds now: 0 nothing, 1 left, 2 right.
        by_hand: 1 if a person wrote or erased it, 0 if the robot learned it.
    """

    node: int
    tick: int
    cell: int
    side: int
    by_hand: int


def pattern_of(feel: int) -> int:
    """The three front sensors of a feel: bit 0 front-right, bit 1 front, bit 2 front-left."""
    return feel >> 1 & 7


@dataclass
class LearningHistory:
    """Takes every tick of a run in its order.

    Attributes:
        node: The robot's number on the bus.
        memory: The eight cells.
        frozen: Whether the robot does not learn; whoever gives the command sets it.
        pattern: The front sensors when the action under way was decided.
        uses: For each cell, the remembered turns it was used for.
        learned: For each cell, the tick of its last change; -1 if there was none.
        trial: The last trial.
        trials: How many there were.
        lessons: All lessons.
    """

    node: int = 1
    memory: Sequence[int] = (0,) * CELL_COUNT
    frozen: bool = False
    pattern: int = 0
    uses: list[int] = field(default_factory=lambda: [0] * CELL_COUNT)
    learned: list[int] = field(default_factory=lambda: [-1] * CELL_COUNT)
    trial: Trial | None = None
    trials: int = 0
    lessons: list[Lesson] = field(default_factory=list)
    _action: int = -1

    def take(self, tick: int, senses: Senses, drive: Drive, memory: Sequence[int]) -> None:
        """Takes a tick: what was sensed, what the robot answered, and its memory after the answer."""
        judged = None
        if drive.action != self._action:
            self._action = drive.action
            self.pattern = pattern_of(senses.feel)
            judged = self._judge()
            self._begin(tick, drive)
        if memory != self.memory:
            self.relearn(tick, memory, judged)

    def relearn(self, tick: int, memory: Sequence[int], trial: Trial | None = None) -> None:
        """Takes a changed memory: what the trial just judged does not explain was written by hand."""
        for cell, (before, side) in enumerate(zip(self.memory, memory, strict=True)):
            if side != before:
                learned = trial is not None and (trial["cell"], trial["side"], trial["helped"]) == (cell, side, 1)
                self.lessons.append(Lesson(node=self.node, tick=tick, cell=cell, side=side, by_hand=int(not learned)))
                self.learned[cell] = tick
        self.memory = memory

    def _judge(self) -> Trial | None:
        """The trial that ends with the reading which decides the next action."""
        if self.trial is None or self.trial["helped"] is not None:
            return None
        fewer = self.pattern.bit_count() < self.trial["cell"].bit_count()
        self.trial = {**self.trial, "helped": int(fewer)}
        return self.trial

    def _begin(self, tick: int, drive: Drive) -> None:
        if drive.reason == Reason.REMEMBERED:
            self.uses[self.pattern] += 1
        elif drive.reason == Reason.TRIAL:
            side = 1 if drive.left_mm_s < drive.right_mm_s else 2
            self.trial = Trial(tick=tick, cell=self.pattern, side=side, helped=None)
            self.trials += 1
