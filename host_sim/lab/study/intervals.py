"""Figures with their confidence intervals, and their differences between conditions.

The sampling unit is the seed: the environments of one seed share a robot and its memory. A percentage has Wilson's
interval, with the number of environments reduced for correlation within a seed (Kish's effective sample size); so it
is valid for rare events, even for none at all. Every other figure has the percentile interval of the bootstrap over
seeds.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np

from host_sim.lab.study.figures import Figure, Take
from host_sim.lab.study.sample import Floats, Sample

RESAMPLES = 4_000
LEVEL = 0.95
_POWER = 0.8
_COVERAGE_DRAWS, _COVERAGE_RESAMPLES = 1000, 500
_SEED = 1
_TAKEN_MAX = 200_000


@dataclass(frozen=True)
class Estimate:
    """A figure, or the difference of two figures.

    Attributes:
        value: Its value.
        low: Lower end of its interval.
        high: Upper end.
        seeds: Number of seeds.
    """

    value: float
    low: float
    high: float
    seeds: int

    def seeds_for(self, difference: float) -> float:
        """The number of seeds that show this difference with a power of 80 %; NaN if unknown.

        The interval is one of 95 %.

        >>> Estimate(1.0, 0.9, 1.1, seeds=100).seeds_for(0.1)
        205
        """
        normal = NormalDist()
        both = 1 + normal.inv_cdf(_POWER) / normal.inv_cdf((1 + LEVEL) / 2)
        needed = self.seeds * ((self.high - self.low) / 2 * both / difference) ** 2
        return math.ceil(round(needed, 6)) if math.isfinite(needed) else math.nan


def estimate(figure: Figure, sample: Sample, level: float = LEVEL, resamples: int = RESAMPLES) -> Estimate:
    """A figure with its interval. Equal samples give equal intervals."""
    if figure.counted:
        value, low, high = (100 * it for it in wilson(_counted(figure, sample), level))
        return Estimate(value, low, high, len(sample.seeds))
    return _bootstrap(lambda take: figure.of(sample, take), len(sample.seeds), level, resamples)


def compare(figure: Figure, sample: Sample, against: Sample, level: float = LEVEL) -> Estimate:
    """The difference of a figure between two samples with the same seeds.

    In percentage points for a percentage, as a ratio for any other figure. The seeds of both are drawn together.
    """
    count = len(sample.seeds)
    if figure.counted:
        return _difference(figure, sample, against, level)

    def ratio(take: Take) -> Any:
        with np.errstate(divide="ignore", invalid="ignore"):
            return figure.of(sample, take) / figure.of(against, take)

    return _bootstrap(ratio, count, level, RESAMPLES)


def coverage(figure: Figure, sample: Sample, seeds: int, draws: int = _COVERAGE_DRAWS) -> float:
    """Coverage, 0 to 1: how often the interval from some seeds of a sample contains the figure of all its seeds."""
    take = np.random.default_rng(_SEED).integers(0, len(sample.seeds), (draws, seeds))
    found = [estimate(figure, sample.take(some), resamples=_COVERAGE_RESAMPLES) for some in take]
    whole = float(figure.of(sample, np.arange(len(sample.seeds))))
    return float(np.mean([it.low <= whole <= it.high for it in found]))


def wilson(counted: Floats, level: float = LEVEL) -> tuple[float, float, float]:
    """A proportion and its interval.

    Args:
        counted: Zeros and ones, shape (seeds, values of each).
        level: Confidence level of the interval.

    >>> [round(it, 3) for it in wilson(np.zeros((100, 1)))]
    [0.0, 0.0, 0.037]
    """
    p, n, z = float(counted.mean()), float(counted.size), NormalDist().inv_cdf((1 + level) / 2)
    if len(counted) > 1 and (variance := float(counted.mean(-1).var()) / len(counted)) > 0:
        n = min(n, p * (1 - p) / variance)
    middle, half = p + z * z / (2 * n), z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    low, high = (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)
    return p, low if p > 0 else 0.0, high if p < 1 else 1.0


def _counted(figure: Figure, sample: Sample) -> Floats:
    counted: Floats = getattr(sample, figure.counted)
    return counted.reshape(len(sample.seeds), -1)


def _difference(figure: Figure, sample: Sample, against: Sample, level: float) -> Estimate:
    """Newcombe's interval of a paired difference, from both intervals and the correlation over seeds."""
    pair = [_counted(figure, it) for it in (sample, against)]
    (p, low_p, high_p), (q, low_q, high_q) = (wilson(counted, level) for counted in pair)
    means = [counted.mean(-1) for counted in pair]
    spread = math.sqrt(float(means[0].var() * means[1].var()))
    shared = float(np.mean((means[0] - p) * (means[1] - q))) / spread if spread > 0 else 0.0

    def reach(a: float, b: float) -> float:
        return math.sqrt(max(0.0, a * a - 2 * shared * a * b + b * b))

    low, high = p - q - reach(p - low_p, high_q - q), p - q + reach(high_p - p, q - low_q)
    return Estimate(100 * (p - q), 100 * low, 100 * high, len(sample.seeds))


def _bootstrap(of: Callable[[Take], Any], count: int, level: float, resamples: int) -> Estimate:
    draws, batch = np.random.default_rng(_SEED), max(1, _TAKEN_MAX // count)
    sizes = [min(batch, resamples - first) for first in range(0, resamples, batch)]
    values = np.concatenate([of(draws.integers(0, count, (size, count))) for size in sizes])
    # Without interpolation: some values may be infinite.
    low, high = np.percentile(values, (50 * (1 - level), 50 * (1 + level)), method="nearest")
    return Estimate(float(of(np.arange(count))), float(low), float(high), count)
