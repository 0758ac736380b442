"""Bootstrap confidence intervals over seeds."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from host_sim.lab.study.figures import Figure, Take
from host_sim.lab.study.sample import Sample

RESAMPLES = 10_000
_SEED = 1
_CELLS_MAX = 2_000_000
_95_PERCENT = (2.5, 97.5)


@dataclass(frozen=True)
class Estimate:
    """A figure, or the ratio of two.

    Attributes:
        value: Its value.
        low: Lower end of its 95 % interval.
        high: Upper end.
        seeds: Number of seeds.
    """

    value: float
    low: float
    high: float
    seeds: int

    @property
    def half_width(self) -> float:
        """Half of the interval."""
        return (self.high - self.low) / 2

    def seeds_for(self, difference: float) -> float:
        """The number of seeds with which the interval's half width would be this difference; NaN if it is unknown.

        >>> Estimate(1.0, 0.9, 1.1, seeds=100).seeds_for(0.05)
        400
        """
        needed = self.seeds * (self.half_width / difference) ** 2
        return math.ceil(round(needed, 6)) if math.isfinite(needed) else math.nan


def estimate(figure: Figure, sample: Sample, against: Sample | None = None, resamples: int = RESAMPLES) -> Estimate:
    """A figure with its interval, or its ratio to that of another sample with the same seeds, drawn together.

    Equal samples give equal intervals.
    """
    count = len(sample.seeds)
    draws, values = np.random.default_rng(_SEED), []
    batch = max(1, _CELLS_MAX // max(1, sample.robot_s.size))
    for first in range(0, resamples, batch):
        take = draws.integers(0, count, (min(batch, resamples - first), count))
        values.append(_value(figure, sample, against, take))
    low, high = _ends(np.concatenate(values))
    return Estimate(float(_value(figure, sample, against, np.arange(count))), low, high, count)


def _value(figure: Figure, sample: Sample, against: Sample | None, take: Take) -> Any:
    value = figure.of(sample, take)
    with np.errstate(divide="ignore", invalid="ignore"):
        return value if against is None else value / figure.of(against, take)


def _ends(values: Any) -> tuple[float, float]:
    """The ends of the interval, without interpolation: some values may be infinite."""
    low, high = np.percentile(values, _95_PERCENT, method="nearest")
    return float(low), float(high)
