"""A study's plan: which conditions are compared, on which seeds, and what is to come of it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from host_sim.lab.study.trial import Trial


@dataclass(frozen=True)
class Goal:
    """What a figure is to reach.

    Attributes:
        figure: Name of the figure.
        condition: Name of the condition.
        against: Name of the condition that it is compared with: as a ratio, or in points of a percentage. Empty for
            none.
        at_least: The lowest value that is good enough; None for any.
        at_most: The highest value that is good enough; None for any.
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
        title: What it is about.
        conditions: A run of each condition, all with the same seed; the others are held against the first one.
        first_seed: The first seed.
        seeds: Number of seeds, the same for each condition.
        chosen_on: First and last of the seeds on which anything was chosen; empty if nothing was.
        goals: What is to come of it.
    """

    title: str
    conditions: Sequence[Trial]
    first_seed: int = 1
    seeds: int = 100
    chosen_on: Sequence[int] = ()
    goals: Sequence[Goal] = ()

    @property
    def is_fleet(self) -> bool:
        """Whether its robots have worlds of their own: they are run without a bus, and leave no rows."""
        return any(it.config.is_fleet for it in self.conditions)

    def trials(self) -> list[Trial]:
        """All runs, in an order in which those with the same environments are neighbours."""
        return [
            replace(it, config=replace(it.config, seed=seed))
            for seed in range(self.first_seed, self.first_seed + self.seeds)
            for it in self.conditions
        ]

    def of_rows(self) -> dict[str, Any]:
        """All that determines what the rows of a seed are."""
        return {"conditions": {it.condition: it.config.command() for it in self.conditions}}
