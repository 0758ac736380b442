"""What the figures of a study were to reach, and whether they did."""

from collections.abc import Sequence
from dataclasses import dataclass

from host_sim.lab.study.bootstrap import Estimate, estimate
from host_sim.lab.study.figures import FIGURES
from host_sim.lab.study.plan import Goal
from host_sim.lab.study.sample import Sample
from host_sim.lab.study.table import text_of


@dataclass(frozen=True)
class Judged:
    """A goal, and what came of it."""

    goal: Goal
    found: Estimate

    @property
    def is_reached(self) -> bool:
        """Whether the figure is within the goal's bounds."""
        low, high = self.goal.at_least, self.goal.at_most
        return (low is None or self.found.value >= low) and (high is None or self.found.value <= high)

    def __str__(self) -> str:
        goal, figure = self.goal, FIGURES[self.goal.figure]
        of = f"{goal.condition} by {goal.against}" if goal.against else goal.condition
        bounds = (("least", goal.at_least), ("most", goal.at_most))
        wanted = " and ".join(f"at {word} {bound:g}" for word, bound in bounds if bound is not None)
        value = f"{self.found.value:.3f}" if goal.against else text_of(figure, self.found.value)
        verdict = "reached" if self.is_reached else "MISSED "
        return f"{verdict}  {goal.figure} of {of}: {value}, wanted {wanted}"


def judge(goals: Sequence[Goal], samples: Sequence[Sample]) -> list[Judged]:
    """Holds samples against goals."""
    by_name = {sample.name: sample for sample in samples}
    return [
        Judged(goal, estimate(FIGURES[goal.figure], by_name[goal.condition], by_name.get(goal.against)))
        for goal in goals
    ]
