"""The goals for the figures of a study, and whether they were reached.

A goal is reached if the figure's whole interval is within its bounds, and missed if all of it is outside; else the
seeds are too few to tell. The interval is one of 90 %, so that each bound is tested at 5 %: with at_least and
at_most, that is a test of equivalence (two one-sided tests).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from host_sim.lab.study.figures import FIGURES, Estimate, compare, estimate
from host_sim.lab.study.plan import Goal
from host_sim.lab.study.sample import Sample
from host_sim.lab.study.table import interval_of, text_of

_LEVEL = 0.9


@dataclass(frozen=True)
class Judged:
    """A goal, and the estimate held against it."""

    goal: Goal
    found: Estimate

    @property
    def is_reached(self) -> bool:
        """Whether the interval is within the goal's bounds."""
        return self._low <= self.found.low and self.found.high <= self._high

    @property
    def verdict(self) -> str:
        """The verdict that these seeds permit."""
        if self.is_reached:
            return "reached"
        return "MISSED " if self.found.high < self._low or self._high < self.found.low else "UNSURE "

    @property
    def _low(self) -> float:
        return -math.inf if self.goal.at_least is None else self.goal.at_least

    @property
    def _high(self) -> float:
        return math.inf if self.goal.at_most is None else self.goal.at_most

    def __str__(self) -> str:
        goal, figure = self.goal, FIGURES[self.goal.figure]
        of = f"{goal.condition} by {goal.against}" if goal.against else goal.condition
        bounds = (("least", goal.at_least), ("most", goal.at_most))
        wanted = " and ".join(f"at {word} {bound:g}" for word, bound in bounds if bound is not None)
        found = self.found
        if goal.against:
            unit = " points" if figure.counted else ""
            value = f"{found.value:.3f} ({found.low:.3f}..{found.high:.3f}){unit}"
        else:
            value = f"{text_of(figure, found.value)} ({interval_of(figure, found.low, found.high)})"
        return f"{self.verdict}  {goal.figure} of {of}: {value}, wanted {wanted}"


def judge(goals: Sequence[Goal], samples: Sequence[Sample]) -> list[Judged]:
    """Compares samples with goals."""
    by_name = {sample.name: sample for sample in samples}

    def found(goal: Goal) -> Estimate:
        figure, sample = FIGURES[goal.figure], by_name[goal.condition]
        if goal.against:
            return compare(figure, sample, by_name[goal.against], _LEVEL)
        return estimate(figure, sample, _LEVEL)

    return [Judged(goal, found(goal)) for goal in goals]
