"""The figures by which conditions are compared, each computed from some seeds of a sample."""

from collections.abc import Callable
from dataclasses import dataclass
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


_TOWARD = "robots that at the end know a turn toward an obstacle beside them"
_SCORE = "Heiserman's: turns after which the way was clear, of all turns"
_KNOWN = "robot time until a turn is known for patterns 1, 3, 4 and 6, median"

_BY_TOUR = "time until finished by that of the shortest tour, straight through all food without turning, median"
_FIRST = "robots that at some time after the change knew the turns beside an obstacle, and no wrong one"
_LASTING = "robots that still knew them, and no wrong one, when the run ended"

FIGURES: dict[str, Figure] = {
    "finished": _percentage("finished", "environments with all food eaten", "finished"),
    "median_s": Figure("median", "time until half of the environments are finished", " s", 0, _median("finished_s")),
    "mean_s": Figure("mean", "robot time of an environment, up to the limit of the run", " s", 0, _mean("robot_s")),
    "by_tour": Figure("by tour", _BY_TOUR, "", 2, _median("by_tour")),
    "blocked_s": Figure(
        "blocked",
        f"robot time from blocked to clear, mean; counted up to {TRAPPED_S:g} s",
        " s",
        2,
        _share("blocked_s", "contacts"),
    ),
    "trapped": _percentage("trapped", f"environments with more than {TRAPPED_S:g} s of that at once", "trapped"),
    "wrong": _percentage("wrong cells", _TOWARD, "wrong"),
    "bumped": _percentage("bumps", "environments in which a body touched something", "bumped"),
    "denied": _percentage("denied", "environments in which wheels did not follow the command", "denied"),
    "score": Figure("score", _SCORE, "", 2, _share("cleared", "turns")),
    "known_s": Figure("known", _KNOWN, " s", 0, _median("known_s")),
    "recovered": _percentage("recovered", _FIRST, "recovered"),
    "recovery": Figure("after", "contacts until then, median", " contacts", 0, _median("recovery")),
    "lasting": _percentage("lasting", _LASTING, "lasting"),
    "lasting_recovery": Figure(
        "to lasting recovery", "contacts until then, median", " contacts", 0, _median("settled")
    ),
}
"""The figures by their names in a study's goals."""

OF_EACH = ("finished", "median_s", "mean_s", "by_tour", "blocked_s", "trapped", "wrong", "bumped", "score")
"""The figures in every table."""
