"""A study's plan: the conditions to compare, the seeds, and the goals."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from host_sim.lab.study.trial import Trial


@dataclass(frozen=True)
class Goal:
    """A goal for a figure.

    Attributes:
        figure: Name of the figure.
        condition: Name of the condition.
        against: Name of the condition to compare with, as a ratio or in percentage points; empty for none.
        at_least: Lowest acceptable value; None for any.
        at_most: Highest acceptable value; None for any.
    """

    figure: str
    condition: str
    against: str = ""
    at_least: float | None = None
    at_most: float | None = None


@dataclass(frozen=True)
class Plan:
    """A study.

    Attributes:
        title: Title of the study.
        conditions: A run of each condition, all with the same seed; the others are compared with the first one.
        first_seed: The first seed.
        seeds: Number of seeds, the same for each condition.
        chosen_on: First and last of the seeds used to choose anything; empty if there are none.
        goals: The goals for its figures.
    """

    title: str
    conditions: Sequence[Trial]
    first_seed: int = 1
    seeds: int = 100
    chosen_on: Sequence[int] = ()
    goals: Sequence[Goal] = ()

    @property
    def is_fleet(self) -> bool:
        """Whether its robots have worlds of their own: they run without a bus, and leave no rows."""
        return any(it.config.is_fleet for it in self.conditions)

    def trials(self) -> list[Trial]:
        """All runs, ordered so that those with the same environments are adjacent."""
        return [
            replace(it, config=replace(it.config, seed=seed))
            for seed in range(self.first_seed, self.first_seed + self.seeds)
            for it in self.conditions
        ]
