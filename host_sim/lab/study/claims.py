"""The article's claims about its robot, measured: the table of docs/article.md.

.venv/bin/python -m host_sim.lab.study.claims                the seeds of studies/claims.toml
.venv/bin/python -m host_sim.lab.study.claims --seeds 100    the first hundred of them
"""

import argparse
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from host_sim.base.paths import ROOT
from host_sim.lab.study.contacts import PROPER
from host_sim.lab.study.figures import wilson
from host_sim.lab.study.plan import Plan, read_plan
from host_sim.lab.study.trial import Trial
from host_sim.lab.table import markdown
from host_sim.lab.workers import processes, run_all
from host_sim.protocol.generated import ROW, Reason, Side
from host_sim.recording.history import pattern_of
from host_sim.sim.make import make
from host_sim.sim.simulation import Simulation
from host_sim.world.memory_kinds import Memory, sides_of

STUDY = ROOT / "studies" / "claims.toml"
SYMMETRIC = (2, 5, 7)
_AFTER = 2
_PIXEL_MM = 5.0
_Z = 1.96
_FEEL, _REASON, _LEFT, _RIGHT, _ACTION = (
    ROW.index(name) for name in ("feel", "reason", "left_mm_s", "right_mm_s", "action")
)


class Life(NamedTuple):
    """The record of one robot in all its environments.

    Attributes:
        tried: For each trial the pattern of the front sensors, and the side of the turn.
        memories: The sides in its cells after each environment.
        finished: For each environment, whether all food was eaten.
        meals: For each environment and meal, whether the listing would have erased the plot that was eaten.
    """

    tried: list[tuple[int, Side]]
    memories: list[Memory]
    finished: list[bool]
    meals: list[list[bool]]

    def first(self, pattern: int) -> Side:
        """The side of the first trial at a pattern at which something was tried."""
        return next(side for at, side in self.tried if at == pattern)


class _Watch:
    """Collects the rows and places of an environment."""

    def __init__(self) -> None:
        self._rows: list[NDArray[np.int16]] = []
        self._places: list[NDArray[np.float64]] = []

    def __call__(self, simulation: Simulation) -> None:
        assert simulation.loop is not None
        block = simulation.loop.block(0)
        rows = np.frombuffer(block.rows, np.int16).reshape(-1, len(ROW)).copy()
        self._rows.append(rows)
        self._places.append(np.frombuffer(block.poses, np.float64).reshape(len(rows), -1)[:, :2].copy())

    def tried(self) -> Iterator[tuple[int, Side]]:
        """The environment's trials."""
        rows = np.concatenate(self._rows)
        begun = np.diff(rows[:, _ACTION], prepend=-1) != 0
        for i in np.flatnonzero(begun & (rows[:, _REASON] == Reason.TRIAL)):
            yield pattern_of(int(rows[i, _FEEL])), Side.LEFT if rows[i, _LEFT] < rows[i, _RIGHT] else Side.RIGHT

    def meals(self, food: Sequence[tuple[float, float]]) -> Iterator[bool]:
        """For each meal, whether the listing would have erased the plot that was eaten: the nearest one left."""
        rows, places, left = np.concatenate(self._rows), np.concatenate(self._places), dict(enumerate(food))
        for i in np.flatnonzero(rows[:, _REASON] == Reason.EAT):
            x, y = places[i]
            eaten = min(left, key=lambda it: (left[it][0] - x) ** 2 + (left[it][1] - y) ** 2)
            del left[eaten]
            yield eaten == erased(x)
            if not left:
                return


def erased(x_mm: float) -> int:
    """Index of the food that the listing erases when the robot eats at `x_mm`, the only coordinate that it checks."""
    x = x_mm / _PIXEL_MM
    return 0 if x < 200 else 1 if 230 < x < 550 else 2  # noqa: PLR2004 - as the listing has it


def life_of(trial: Trial) -> Life:
    """Runs a trial in this process, and records what its robot does."""
    life = Life([], [], [], [])
    with make(trial.config) as simulation:
        for number in range(1, trial.config.environments + 1):
            simulation.enter(number)
            watch = simulation.watch = _Watch()
            food = [(it.x_mm, it.y_mm) for it in simulation.arena.inside.food]
            while not simulation.over:
                simulation.step(1024)
            episode = simulation.leave()
            life.tried.extend(watch.tried())
            life.memories.append(sides_of(episode.robots[0].memory))
            life.finished.append(episode.finished)
            life.meals.append(list(watch.meals(food)))
    return life


def lives_of(trials: Sequence[Trial]) -> list[tuple[tuple[str, int], Life]]:
    """Runs trials in this process. Returns the key and the record of each."""
    return [(trial.key, life_of(trial)) for trial in trials]


class Row(NamedTuple):
    """A figure with its 95 % interval."""

    name: str
    value: float
    low: float
    high: float
    unit: str = " %"

    def cells(self) -> tuple[str, str]:
        """The row as text."""
        digits = 1 if self.unit else 2
        value, low, high = (f"{it:.{digits}f}" for it in (self.value, self.low, self.high))
        return self.name, f"{value}{self.unit} ({low}..{high})"


def _share(name: str, truths: Sequence[Sequence[bool]] | Sequence[bool]) -> Row:
    counted = np.array(truths, np.float64).reshape(len(truths), -1)
    value, low, high = wilson(counted)
    return Row(name, 100 * value, 100 * low, 100 * high)


def _mean(name: str, values: Sequence[float]) -> Row:
    mean, half = float(np.mean(values)), _Z * float(np.std(values)) / len(values) ** 0.5
    return Row(name, mean, mean - half, mean + half, "")


def proper_rows(lives: Sequence[Life]) -> Iterator[Row]:
    """Rows about the cells of obstacles on one side."""
    for cell, side in PROPER.items():
        known = [life.memories[_AFTER - 1][cell] == side for life in lives]
        yield _share(f"cell {cell} right after two environments", known)
    every = [all(life.memories[_AFTER - 1][it] == side for it, side in PROPER.items()) for life in lives]
    yield _share("all four", every)
    for cell, side in PROPER.items():
        learned = [life.memories[-1][cell] for life in lives if life.memories[-1][cell]]
        yield _share(f"cell {cell} right in the end, if learned", [it == side for it in learned])


def symmetric_rows(lives: Sequence[Life], patterns: Sequence[int] = SYMMETRIC) -> Iterator[Row]:
    """Rows about the cells of symmetric patterns."""
    for cell in patterns:
        ends = [life.memories[-1][cell] for life in lives]
        kept = [life for life, end in zip(lives, ends, strict=True) if end]
        tried = [len([1 for pattern, _ in life.tried if pattern == cell]) for life in kept]
        yield _share(f"cell {cell} left in the end", [end == Side.LEFT for end in ends])
        yield _share(f"cell {cell} right in the end", [end == Side.RIGHT for end in ends])
        first = [life.first(cell) == life.memories[-1][cell] for life in kept]
        yield _share(f"pattern {cell} keeps the side of its first trial", first)
        yield _mean(f"pattern {cell}: trials until one is kept", tried)


def world_rows(lives: Sequence[Life]) -> Iterator[Row]:
    """Rows about environments and food."""
    yield _share("environments finished within 600 s", [life.finished for life in lives])
    other = [[not all(meals) for meals in life.meals] for life in lives]
    yield _share("environments in which the listing would erase another plot", other)
    yield _share("meals at which it would", [not ours for life in lives for meals in life.meals for ours in meals])


def table_of(lives: Sequence[Sequence[Life]]) -> str:
    """The table: the ideal body's lives, then those of the body whose front sensor reaches farther."""
    ours, far = lives
    rows = [*proper_rows(ours), *symmetric_rows(ours), *world_rows(ours)]
    rows += [it._replace(name=f"front sensor + 5 mm: {it.name}") for it in symmetric_rows(far, (2,))]
    met = [any(pattern in (5, 7) for pattern, _ in life.tried) for life in far]
    rows.append(_share("front sensor + 5 mm: a trial at pattern 5 or 7 in five environments", met))
    return markdown([("what", "measured (95 % interval)"), *(it.cells() for it in rows)])


def measured(plan: Plan, jobs: int) -> list[list[Life]]:
    """The lives of each condition of a plan, by seed."""
    known = dict(it for some in run_all(lives_of, plan.trials(), processes(jobs)) for it in some)
    seeds = range(plan.first_seed, plan.first_seed + plan.seeds)
    return [[known[it.condition, seed] for seed in seeds] for it in plan.conditions]


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    plan = read_plan(STUDY)
    parser.add_argument("--seeds", type=int, default=plan.seeds, metavar="N", help="how many of the study's seeds")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="processes")
    arguments = parser.parse_args()
    plan = replace(plan, seeds=arguments.seeds)
    print(f"seeds {plan.first_seed}..{plan.first_seed + plan.seeds - 1}, five environments each\n")
    print(table_of(measured(plan, arguments.jobs)))


if __name__ == "__main__":
    main()
