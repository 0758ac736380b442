"""The data of one condition, seed by seed, from which figures are computed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from host_sim.lab.study.tables import Columns, Tables

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Sample:
    """One condition. All arrays have an entry per seed; those marked so, one per seed and environment.

    Attributes:
        name: The condition.
        robots: Number of robots in each environment.
        seeds: The seeds, ascending.
        finished: For each environment, 1 if all food was eaten, else 0.
        robot_s: For each environment, robot time, s.
        tour_s: For each environment, robot time of the shortest tour through all food at the robot's speed, s; NaN
            where several robots share it.
        trapped: For each environment, 1 if one of its contacts took more than 60 s, else 0.
        bumped: For each environment, 1 if a body touched something, else 0.
        denied: For each environment, 1 if wheels did not follow the command, else 0.
        wrong: For each robot that knows a wrong turn at the end 1, then 0 for each of the others.
        contacts: Number of contacts.
        blocked_s: Robot time of all contacts, s; if one trapped the robot, only its first 60 s.
        turns: Number of turns in all contacts.
        cleared: Number of contacts after which the way was clear.
        known_s: Robot time until a turn was known for patterns 1, 3, 4 and 6, s; infinite if it never was.
        blocked_at: For each of the first robot's first contacts, its duration, s; NaN where there was none.
        wrong_at: For each of the first robot's first contacts after the change, 1 if it knew a wrong turn then, else
            0; NaN where there was none.
        recovery: Contacts after the change until the turns for patterns 1 and 4 were right, and no wrong one known;
            infinite if never, and NaN without a change.
        settled: As `recovery`, but of a recovery that lasted to the end of the run.
    """

    name: str
    robots: int
    seeds: NDArray[np.int64]
    finished: Floats
    robot_s: Floats
    tour_s: Floats
    trapped: Floats
    bumped: Floats
    denied: Floats
    wrong: Floats
    contacts: Floats
    blocked_s: Floats
    turns: Floats
    cleared: Floats
    known_s: Floats
    blocked_at: Floats
    wrong_at: Floats
    recovery: Floats
    settled: Floats

    @property
    def finished_s(self) -> Floats:
        """For each environment, robot time until it was finished, s; infinite if it was not."""
        return np.where(self.finished > 0, self.robot_s, np.inf)

    @property
    def by_tour(self) -> Floats:
        """For each environment, the time until it was finished divided by that of the shortest tour."""
        return self.finished_s / self.tour_s

    @property
    def recovered(self) -> Floats:
        """1 if the robot recovered, else 0; NaN without a change."""
        return _has_been(self.recovery)

    @property
    def lasting(self) -> Floats:
        """1 if the robot recovered for good, else 0; NaN without a change."""
        return _has_been(self.settled)

    def take(self, seeds: NDArray[np.int64]) -> "Sample":
        """A sample of some of its seeds, by index, possibly repeated."""
        taken: dict[str, Any] = {name: getattr(self, name)[seeds] for name in _arrays()}
        return replace(self, **taken)


def joined(samples: Sequence[Sample]) -> Sample:
    """Joins samples of one condition with different seeds."""
    every: dict[str, Any] = {name: np.concatenate([getattr(it, name) for it in samples]) for name in _arrays()}
    return replace(samples[0], **every)


def _arrays() -> list[str]:
    return [it.name for it in fields(Sample) if it.name not in ("name", "robots")]


CURVE = 100
"""Number of contacts in a curve."""

TRAPPED_S = 60.0
"""Duration beyond which a contact has trapped the robot, s."""

_BESIDE = (1, 4)
"""The patterns of an obstacle on one side of the robot."""


def samples_of(tables: Tables, conditions: Sequence[str] = (), wanted: range | None = None) -> list[Sample]:
    """A sample for each condition, all with the same seeds: those common to all conditions.

    Args:
        tables: The rows.
        conditions: The conditions in the desired order; by default that of the rows.
        wanted: The seeds to take; None for all.
    """
    runs = tables["runs"]
    names = conditions or list(dict.fromkeys(runs["condition"].tolist()))
    by_name = [set(runs["seed"][runs["condition"] == name].tolist()) for name in names]
    common = sorted(set.intersection(*by_name)) if by_name else []
    seeds = np.array([seed for seed in common if wanted is None or seed in wanted], np.int64)
    return [
        _sample({name: _of(table, condition, seeds) for name, table in tables.items()}, condition, seeds)
        for condition in names
    ]


def _of(table: Columns, condition: str, seeds: NDArray[np.int64]) -> Columns:
    """The rows of a condition, sorted by seed; rows of one seed keep their order."""
    wanted = np.flatnonzero((table["condition"] == condition) & np.isin(table["seed"], seeds))
    wanted = wanted[np.argsort(table["seed"][wanted], kind="stable")]
    return {name: column[wanted] for name, column in table.items()}


def _sample(tables: Tables, name: str, seeds: NDArray[np.int64]) -> Sample:
    runs, environments, contacts = tables["runs"], tables["environments"], tables["contacts"]
    count = len(seeds)
    index, first = np.searchsorted(seeds, contacts["seed"]), contacts["robot"] == 0

    def each(column: NDArray[Any]) -> Floats:
        return column.astype(np.float64).reshape(count, -1)

    def total(column: Any) -> Floats:
        return np.bincount(index, column, count).astype(np.float64)

    robots = int(np.max(runs["robots"], initial=1))
    trapped = np.zeros((count, len(environments["seed"]) // max(count, 1)))
    long = contacts["blocked_s"] > TRAPPED_S
    trapped[index[long], contacts["environment"][long] - 1] = 1
    recoveries = np.array([_recovery(contacts, environments, seed) for seed in seeds]).reshape(count, 2)
    return Sample(
        name=name,
        robots=robots,
        seeds=seeds,
        finished=each(environments["finished"]),
        robot_s=each(environments["robot_s"]),
        tour_s=each(environments["tour_s"]),
        trapped=trapped,
        bumped=each(environments["collisions"] > 0),
        denied=each(environments["denied"] > 0),
        wrong=(np.arange(robots) < each(environments["wrong"])[:, -1:]).astype(np.float64),
        contacts=total(np.ones(len(index))),
        blocked_s=total(np.minimum(contacts["blocked_s"], TRAPPED_S)),
        turns=total(contacts["trials"] + contacts["remembered"] + contacts["boredoms"]),
        cleared=total(contacts["cleared"]),
        known_s=runs["known_s"].astype(np.float64),
        blocked_at=_curve(index, contacts["blocked_s"], first, count),
        wrong_at=_curve(index, contacts["wrong"], first & contacts["changed"], count),
        recovery=recoveries[:, 0],
        settled=recoveries[:, 1],
    )


def _curve(index: NDArray[np.int64], values: NDArray[Any], wanted: NDArray[np.bool_], count: int) -> Floats:
    """The first `CURVE` wanted values of each seed, in the order of the rows."""
    curve = np.full((count, CURVE), np.nan)
    for seed in range(count):
        found = values[wanted & (index == seed)][:CURVE]
        curve[seed, : len(found)] = found
    return curve


def _recovery(contacts: Columns, environments: Columns, seed: int) -> tuple[float, float]:
    """Number of the first robot's contacts after the change until recovery: the first time, and for good."""
    if not environments["changed"][environments["seed"] == seed].any():
        return math.nan, math.nan
    ours = (contacts["seed"] == seed) & contacts["changed"] & (contacts["robot"] == 0)
    knows = [all(sides[pattern] != "0" for pattern in _BESIDE) for sides in contacts["sides"][ours]]
    recovered = np.array(knows, bool) & ~contacts["wrong"][ours]
    if not recovered.any():
        return math.inf, math.inf
    lost = np.flatnonzero(~recovered)
    settled = lost[-1] + 2 if len(lost) else 1
    return float(np.argmax(recovered) + 1), float(settled) if recovered[-1] else math.inf


def _has_been(contacts: Floats) -> Floats:
    return np.where(np.isnan(contacts), np.nan, np.isfinite(contacts).astype(np.float64))
