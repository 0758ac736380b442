"""Heiserman's creatures of 1981 and their score, reimplemented from the rules of his BASIC programs.

A creature moves in a walled rectangle, by the same step of -2..2 cells each way until it meets a wall. Then it draws
steps until one is free. Each step tried there is a contact, and each free one a good move; the score is good moves
divided by contacts. Its class determines its use of experience:

- Alpha draws a new step each time.
- Beta remembers for each of the 24 steps which one freed it, with a confidence of up to 4.
- Gamma is a Beta that generalises: steps with low confidence take the mean of confident ones in the same
  direction.
"""

import random
from collections.abc import Iterator
from typing import NamedTuple

_WIDTH, _HEIGHT = 122, 37
_SPAN = (-2, -1, 0, 1, 2)
_SURE = 4

Step = tuple[int, int]


class _Known(NamedTuple):
    step: Step
    sure: int


CLASSES = ("Alpha", "Beta", "Gamma")
"""The classes of creatures."""


def scores(kind: str, seed: int, contacts: int) -> Iterator[float]:
    """The score of a creature of one of `CLASSES` after each of a number of contacts."""
    creature, good, count = _Creature(kind, random.Random(seed)), 0, 0
    while count < contacts:
        for free in creature.meet():
            good, count = good + free, count + 1
            yield good / count
            if count == contacts:
                return


class _Creature:
    def __init__(self, kind: str, dice: random.Random) -> None:
        self._kind, self._dice = kind, dice
        self._x, self._y, self._step = _WIDTH // 2, _HEIGHT // 2, self._drawn()
        self._memory: dict[Step, _Known] = {}

    def meet(self) -> Iterator[bool]:
        """Moves to a wall and away from it; yields for each contact whether the step tried is free."""
        while self._is_free(self._step):
            self._x, self._y = self._x + self._step[0], self._y + self._step[1]
        met = self._step
        step, sure = self._memory.get(met, _Known(self._drawn(), 0))
        while not self._is_free(step):
            yield False
            if sure > 1:
                sure -= 1
            else:
                step, sure = self._drawn(), 0
        self._step = step
        if self._kind != "Alpha":
            self._memory[met] = _Known(step, min(sure + 1, _SURE))
        if self._kind == "Gamma" and self._memory[met].sure == _SURE:
            self._generalise()
        yield True

    def _generalise(self) -> None:
        """Gives each step with low confidence the mean of the confident ones in its direction."""
        for met in ((i, j) for i in _SPAN for j in _SPAN):
            known = self._memory.get(met, _Known((0, 0), 0))
            alike = [it.step for of, it in self._memory.items() if it.sure == _SURE and _signs(of) == _signs(met)]
            mean = (_sign(sum(i for i, _ in alike)), _sign(sum(j for _, j in alike)))
            if known.sure <= 1 and mean != (0, 0):
                self._memory[met] = _Known(mean, 1)

    def _drawn(self) -> Step:
        step = (0, 0)
        while step == (0, 0):
            step = (self._dice.choice(_SPAN), self._dice.choice(_SPAN))
        return step

    def _is_free(self, step: Step) -> bool:
        x, y = self._x + step[0], self._y + step[1]
        return 0 <= x < _WIDTH and 0 <= y < _HEIGHT


def _sign(number: int) -> int:
    return (number > 0) - (number < 0)


def _signs(step: Step) -> Step:
    return _sign(step[0]), _sign(step[1])
