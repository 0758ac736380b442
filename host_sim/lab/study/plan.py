"""A study's plan: which conditions are compared, on which seeds, and what is to come of it."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from host_sim.lab.study.trial import Trial
from host_sim.world.world_names import RANDOM


@dataclass(frozen=True)
class Condition:
    """What is the same in all runs that are pooled.

    Attributes:
        name: Its name in tables and plots.
        profile: The behaviour.
        settings: Parameters to change from their defaults, by name.
        world: Name of the world that the environments are drawn from.
        change: What the world and the bodies meet with; empty for nothing.
        robots: Number of robots in each environment.
        robot: Where they come from, as in `Trial`.
    """

    name: str
    profile: str
    settings: dict[str, int] = field(default_factory=dict)
    world: str = RANDOM
    change: str = ""
    robots: int = 1
    robot: str = "spawn"


@dataclass(frozen=True)
class Goal:
    """What a figure is to reach.

    Attributes:
        figure: Name of the figure.
        condition: Name of the condition.
        against: Name of the condition by whose figure it is divided; empty for none.
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
        conditions: What is compared; the first one is what the others are held against.
        first_seed: The first seed.
        seeds: Number of seeds, the same for each condition.
        environments: Number of environments of each run.
        limit_s: Time limit for each environment, s of robot time.
        goals: What is to come of it.
    """

    title: str
    conditions: Sequence[Condition]
    first_seed: int = 1
    seeds: int = 20
    environments: int = 5
    limit_s: float = 600.0
    goals: Sequence[Goal] = ()

    def trials(self) -> list[Trial]:
        """All runs, in an order in which those with the same environments are neighbours."""
        return [
            self._trial(condition, seed)
            for seed in range(self.first_seed, self.first_seed + self.seeds)
            for condition in self.conditions
        ]

    def of_rows(self) -> dict[str, Any]:
        """All that determines what the rows of a seed are."""
        return {
            "conditions": [asdict(condition) for condition in self.conditions],
            "environments": self.environments,
            "limit_s": self.limit_s,
        }

    def _trial(self, condition: Condition, seed: int) -> Trial:
        return Trial(
            profile=condition.profile,
            seed=seed,
            environments=self.environments,
            settings=condition.settings,
            world=condition.world,
            change=condition.change,
            limit_s=self.limit_s,
            robots=condition.robots,
            robot=condition.robot,
            condition=condition.name,
        )
