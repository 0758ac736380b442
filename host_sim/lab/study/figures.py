"""The figures by which conditions are compared, each a number that is made of some seeds of a sample."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from host_sim.lab.study.sample import Floats, Sample

Take = NDArray[np.int64]
"""Shape (..., seeds): which seeds to take, by index, each as often as it is there."""


@dataclass(frozen=True)
class Figure:
    """A figure.

    Attributes:
        heading: What stands above it in a table.
        meaning: What it is, for people.
        unit: Its unit, with a space before it; empty if it has none.
        digits: Digits after the point.
        of: Makes it of the seeds that are taken: shape (...).
    """

    heading: str
    meaning: str
    unit: str
    digits: int
    of: Callable[[Sample, Take], Any]


def _mean(name: str, factor: float = 1.0) -> Callable[[Sample, Take], Any]:
    """The mean over all environments, or over all seeds."""
    return lambda sample, take: factor * _flat(getattr(sample, name)[take], take).mean(-1)


def _median(name: str) -> Callable[[Sample, Take], Any]:
    return lambda sample, take: np.median(_flat(getattr(sample, name)[take], take), -1)


def _share(part: str, whole: str) -> Callable[[Sample, Take], Any]:
    def of(sample: Sample, take: Take) -> Any:
        parts, wholes = getattr(sample, part)[take].sum(-1), getattr(sample, whole)[take].sum(-1)
        return np.divide(parts, wholes, out=np.full(np.shape(parts), np.nan), where=wholes > 0)

    return of


def _flat(values: Floats, take: Take) -> Floats:
    return values.reshape(*take.shape[:-1], -1)


def interquartile_mean(values: Floats) -> Any:
    """The mean of the middle half, along the last axis.

    >>> float(interquartile_mean(np.array([1.0, 2.0, 4.0, 1000.0])))
    3.0
    """
    cut = values.shape[-1] // 4
    return np.sort(values)[..., cut : values.shape[-1] - cut].mean(-1)


def _iqm(sample: Sample, take: Take) -> Any:
    return interquartile_mean(_flat(sample.robot_s[take], take))


def _recovered(sample: Sample, take: Take) -> Any:
    return 100 * np.isfinite(sample.recovery[take]).mean(-1)


_TOWARD = "robots that in the end know a turn toward what is beside them"
_SCORE = "Heiserman's: turns after which the way was clear, of all turns"
_RECOVERED = "robots that after the change know what to do beside things again, and no wrong turn"
_KNOWN = "robot time until a turn is known for patterns 1, 3, 4 and 6, median"

FIGURES: dict[str, Figure] = {
    "finished": Figure("finished", "environments with all food eaten", " %", 1, _mean("finished", 100)),
    "median_s": Figure("median", "robot time of an environment", " s", 0, _median("robot_s")),
    "iqm_s": Figure("IQM", "the mean of the middle half of these times", " s", 0, _iqm),
    "mean_s": Figure("mean", "the mean of all of them", " s", 0, _mean("robot_s")),
    "blocked_s": Figure(
        "blocked", "robot time from blocked to clear, mean", " s", 2, _share("blocked_s", "contacts")
    ),
    "trapped": Figure("trapped", "environments with more than 60 s of that at once", " %", 1, _mean("trapped", 100)),
    "wrong": Figure("wrong cells", _TOWARD, " %", 1, _mean("wrong", 100)),
    "bumped": Figure("bumps", "environments in which a body touched something", " %", 1, _mean("bumped", 100)),
    "denied": Figure(
        "denied", "environments in which wheels did not do what they were told", " %", 1, _mean("denied", 100)
    ),
    "score": Figure("score", _SCORE, "", 2, _share("cleared", "turns")),
    "known_s": Figure("known", _KNOWN, " s", 0, _median("known_s")),
    "recovered": Figure("recovered", _RECOVERED, " %", 1, _recovered),
    "recovery": Figure("after", "contacts until then, median", " contacts", 0, _median("recovery")),
}
"""Each figure by its name in a study's goals."""

ALWAYS = ("finished", "median_s", "iqm_s", "mean_s", "blocked_s", "trapped", "wrong", "bumped", "score")
"""The figures that each table has."""
