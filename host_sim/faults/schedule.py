"""A schedule of faults: rules applied frame by frame with a seed, and a record of their effects."""

from array import array
from collections.abc import Sequence
from random import Random

from host_sim.base.frame import Frame
from host_sim.faults.bus_faults import FAULTS, Fault, Forger, Forgers, Passing
from host_sim.faults.rule import DIRECTIONS, Direction, Rule

RECORD_MAX = 100_000
"""Maximum number of faults recorded; later ones are only counted."""


class _Rolled:
    """One rule with its fault, and an independent random sequence for each direction."""

    def __init__(self, place: int, rule: Rule, fault: Fault, seed: int) -> None:
        self.place, self.rule, self.fault, self._seed = place, rule, fault, seed
        self._chances: dict[Direction, Random] = {}
        if not rule.is_certain:
            self._chances = {direction: Random(f"{seed} {rule} {direction}") for direction in DIRECTIONS}

    def strikes(self, number: int, direction: Direction) -> bool:
        """Whether the fault affects a frame. Must be called once for each frame that the rule covers."""
        if not self.rule.covers(number, direction):
            return False
        return self.rule.is_certain or self._chances[direction].random() * 100 < self.rule.chance

    def dice(self, number: int, direction: Direction) -> Random:
        """The dice of a frame: the same in a run with the rule and in one with the recorded fault."""
        return Random(f"{self._seed} {self.rule.name} {number} {direction}")


class Schedule:
    """Faults for the frames of one link. The same rules and seed damage the same frames in the same way.

    Attributes:
        count: Number of faults so far.
    """

    def __init__(self, rules: Sequence[Rule], seed: int, forgers: Forgers) -> None:
        """Prepares the faults: rules are applied in this order, those for a single frame first.

        Raises:
            UsageError: There is no such fault, or its size is invalid.
        """
        self._rules = [*rules]
        self._forgers: list[Forger] = []

        def forger_of(name: str) -> Forger:
            self._forgers.append(forgers(name))
            return self._forgers[-1]

        rolled = [
            _Rolled(place, rule, FAULTS[rule.name](rule.size, forger_of), seed) for place, rule in enumerate(rules)
        ]
        self._wide = [each for each in rolled if not each.rule.is_single]
        self._single: dict[int, list[_Rolled]] = {}
        for each in rolled:
            if each.rule.is_single:
                self._single.setdefault(each.rule.first, []).append(each)
        self._numbers = dict.fromkeys(DIRECTIONS, 0)
        self._struck = array("q")
        self.count = 0

    @property
    def struck(self) -> list[Rule]:
        """Each fault so far, as a rule for one frame: with the same seed they make the same faults again."""
        each = zip(self._struck[::3], self._struck[1::3], self._struck[2::3], strict=True)
        return [self._rules[place].at(number, DIRECTIONS[way]) for place, number, way in each]

    def passing(self, frame: Frame, direction: Direction) -> list[Passing]:
        """Returns the frames that arrive for the next frame in a direction, in order."""
        self._numbers[direction] += 1
        number = self._numbers[direction]
        arriving = [Passing(frame)]
        for rolled in (*self._single.get(number, ()), *self._wide):
            if rolled.strikes(number, direction):
                dice = rolled.dice(number, direction)
                arriving = [after for before in arriving for after in rolled.fault(before, dice)]
                self._record(rolled.place, number, direction)
        for forger in self._forgers:
            forger.hear(frame)
        return arriving

    def _record(self, place: int, number: int, direction: Direction) -> None:
        """Records a fault as numbers, since a run of a day has tens of thousands."""
        if self.count < RECORD_MAX:
            self._struck.extend((place, number, DIRECTIONS.index(direction)))
        self.count += 1
