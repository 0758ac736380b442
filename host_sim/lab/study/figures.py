"""The figures by which conditions are compared, with their confidence intervals and their differences.

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
from numpy.typing import NDArray

from host_sim.lab.study.sample import TRAPPED_S, Floats, Sample

Take = NDArray[np.int64]
"""Shape (..., seeds): indices of the seeds to take, possibly repeated."""


@dataclass(frozen=True)
class Figure:
    """A figure.

    Attributes:
        heading: Column heading in a table.
        meaning: Description for people.
        unit: Its unit, with a leading space; empty if it has none.
        digits: Digits after the decimal point.
        of: Computes it from the seeds taken: shape (...).
        counted: For a percentage, the attribute of the sample with zeros and ones; empty for other figures.
    """

    heading: str
    meaning: str
    unit: str
    digits: int
    of: Callable[[Sample, Take], Any]
    counted: str = ""


def _mean(name: str, factor: float = 1.0) -> Callable[[Sample, Take], Any]:
    """The mean over all environments, or over all seeds."""
    return lambda sample, take: factor * _flat(getattr(sample, name)[take], take).mean(-1)


def _percentage(heading: str, meaning: str, counted: str) -> Figure:
    return Figure(heading, meaning, " %", 1, _mean(counted, 100), counted)


def _median(name: str) -> Callable[[Sample, Take], Any]:
    return lambda sample, take: np.median(_flat(getattr(sample, name)[take], take), -1)


def _share(part: str, whole: str) -> Callable[[Sample, Take], Any]:
    def of(sample: Sample, take: Take) -> Any:
        parts, wholes = getattr(sample, part)[take].sum(-1), getattr(sample, whole)[take].sum(-1)
        return np.divide(parts, wholes, out=np.full(np.shape(parts), np.nan), where=wholes > 0)

    return of


def _flat(values: Floats, take: Take) -> Floats:
    return values.reshape(*take.shape[:-1], -1)


_BLOCKED = f"robot time from blocked to clear, mean; counted up to {TRAPPED_S:g} s"
_TOWARD = "robots that at the end know a turn toward an obstacle beside them"
_SCORE = "Heiserman's: turns after which the way was clear, of all turns"
_KNOWN = "robot time until a turn is known for patterns 1, 3, 4 and 6, median"

_BY_TOUR = "time until finished by that of the shortest tour, straight through all food without turning, median"
_FIRST = "robots that at some time after the change knew the turns beside an obstacle, and no wrong one"
_UNTIL = "contacts until then, median"
_LASTING = "robots that still knew them, and no wrong one, when the run ended"

FIGURES: dict[str, Figure] = {
    "finished": _percentage("finished", "environments with all food eaten", "finished"),
    "median_s": Figure("median", "time until half of the environments are finished", " s", 0, _median("finished_s")),
    "mean_s": Figure("mean", "robot time of an environment, up to the limit of the run", " s", 0, _mean("robot_s")),
    "by_tour": Figure("by tour", _BY_TOUR, "", 2, _median("by_tour")),
    "blocked_s": Figure("blocked", _BLOCKED, " s", 2, _share("blocked_s", "contacts")),
    "trapped": _percentage("trapped", f"environments with more than {TRAPPED_S:g} s of that at once", "trapped"),
    "wrong": _percentage("wrong cells", _TOWARD, "wrong"),
    "bumped": _percentage("bumps", "environments in which a body touched something", "bumped"),
    "denied": _percentage("denied", "environments in which wheels did not follow the command", "denied"),
    "score": Figure("score", _SCORE, "", 2, _share("cleared", "turns")),
    "known_s": Figure("known", _KNOWN, " s", 0, _median("known_s")),
    "recovered": _percentage("recovered", _FIRST, "recovered"),
    "recovery": Figure("after", _UNTIL, " contacts", 0, _median("recovery")),
    "lasting": _percentage("lasting", _LASTING, "lasting"),
    "lasting_recovery": Figure("to lasting recovery", _UNTIL, " contacts", 0, _median("settled")),
}
"""The figures by their names in a study's goals."""

OF_EACH = ("finished", "median_s", "mean_s", "by_tour", "blocked_s", "trapped", "wrong", "bumped", "score")
"""The figures in every table."""


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
        return math.ceil(round(needed, 6)) if math.isfinite(needed) and self.seeds > 1 else math.nan


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
