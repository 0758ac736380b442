"""Samples side by side as a table for people, and the goals for their figures."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from host_sim.lab.study.figures import FIGURES, LEVEL, OF_EACH, Estimate, Figure, compare, coverage, estimate
from host_sim.lab.study.plan import Goal
from host_sim.lab.study.sample import Sample
from host_sim.lab.table import aligned

_RATIO = "mean_s"
_GOAL_LEVEL = 0.9


def table(samples: Sequence[Sample], difference: float = 0.05) -> str:
    """Each figure of each sample, compared with that of the first one; all have the same seeds.

    The last lines say how many seeds it takes to detect a relative difference of mean times.
    """
    others = len(samples) - 1
    lines: list[str] = []
    for name in (*OF_EACH, *_of_some(samples)):
        figure = FIGURES[name]
        rows = [_row(figure, sample, samples[0], others) for sample in samples]
        lines += ["", f"{figure.heading}: {figure.meaning}", *(f"  {row}" for row in aligned(rows, right=(1,)))]
    return "\n".join([*lines[1:], "", *_notes(samples, difference)])


def coverage_table(samples: Sequence[Sample], seeds: int) -> str:
    """Coverage of each figure's intervals from a number of seeds; 95 % is correct."""
    names = [*OF_EACH, *_of_some(samples)]
    rows = [("", *(sample.name for sample in samples))]
    for name in names:
        figure = FIGURES[name]
        rows.append((figure.heading, *(f"{100 * coverage(figure, sample, seeds):.1f} %" for sample in samples)))
    return "\n".join(aligned(rows, right=range(1, len(samples) + 1)))


def text_of(figure: Figure, value: float) -> str:
    """A value of a figure, with its unit.

    >>> text_of(FIGURES["finished"], 94.66)
    '94.7 %'
    """
    if math.isnan(value):
        return "-"
    return "never" if math.isinf(value) else f"{value:.{figure.digits}f}{figure.unit}"


def interval_of(figure: Figure, low: float, high: float) -> str:
    """The interval of a figure, with its unit.

    >>> interval_of(FIGURES["mean_s"], 90.2, math.inf)
    '90 s..never'
    """
    ends = text_of(figure, low), text_of(figure, high)
    return f"{ends[0].removesuffix(figure.unit) if math.isfinite(high) else ends[0]}..{ends[1]}"


def _of_some(samples: Sequence[Sample]) -> list[str]:
    """The figures present only in some studies."""
    changed = any(not np.isnan(sample.recovery).all() for sample in samples)
    several = any(sample.robots > 1 for sample in samples)
    denied = any(sample.denied.any() for sample in samples)
    after = ["recovered", "recovery", "lasting", "lasting_recovery"] * changed
    return ["denied"] * denied + after + ["known_s"] * several


def _row(figure: Figure, sample: Sample, first: Sample, others: int) -> tuple[str, ...]:
    found = estimate(figure, sample)
    cells = sample.name, text_of(figure, found.value), interval_of(figure, found.low, found.high)
    if sample is first:
        return *cells, ""
    return *cells, compared(figure, compare(figure, sample, first, _level(others)))


def _level(others: int) -> float:
    """Bonferroni-corrected level, so that all comparisons of a figure hold jointly."""
    return 1 - (1 - LEVEL) / max(1, others)


def compared(figure: Figure, it: Estimate) -> str:
    """What two figures differ by, with its interval."""
    if math.isnan(it.value):
        return ""
    if figure.counted:
        return f"{it.value:+.1f} points ({it.low:+.1f}..{it.high:+.1f})"
    return f"x {it.value:.2f} ({it.low:.2f}..{it.high:.2f})"


def _notes(samples: Sequence[Sample], difference: float) -> Iterator[str]:
    yield f"The first interval is one of {100 * LEVEL:g} %, over seeds."
    if len(samples) == 1:
        return
    together = f", and all {len(samples) - 1} of a figure hold together" if len(samples) > 2 else ""  # noqa: PLR2004
    yield f"The last column compares with {samples[0].name}: points of a percentage, ratio of all else{together}."
    for sample in samples[1:]:
        ratio = compare(FIGURES[_RATIO], sample, samples[0])
        if ratio.low == ratio.value == ratio.high == 1:
            yield f"{sample.name} takes as long as {samples[0].name} with each seed."
            continue
        needed = ratio.seeds_for(difference)
        seeds = "an unknown number of" if math.isnan(needed) else f"{needed:g}"
        yield f"To detect {100 * difference:g} % of the mean time of {sample.name}: {seeds} seeds (power 80 %)."


@dataclass(frozen=True)
class Judged:
    """A goal, and the estimate held against it."""

    goal: Goal
    found: Estimate

    @property
    def is_reached(self) -> bool:
        """Whether the interval is within the goal's bounds."""
        return self.goal.at_least <= self.found.low and self.found.high <= self.goal.at_most

    @property
    def verdict(self) -> str:
        """The verdict that these seeds permit."""
        if self.is_reached:
            return "reached"
        return "MISSED " if self.found.high < self.goal.at_least or self.goal.at_most < self.found.low else "UNSURE "

    def __str__(self) -> str:
        goal, found, figure = self.goal, self.found, FIGURES[self.goal.figure]
        of = f"{goal.condition} by {goal.against}" if goal.against else goal.condition
        bounds = (("least", goal.at_least), ("most", goal.at_most))
        wanted = " and ".join(f"at {word} {bound:g}" for word, bound in bounds if math.isfinite(bound))
        value = f"{text_of(figure, found.value)} ({interval_of(figure, found.low, found.high)})"
        if goal.against:
            value = f"{found.value:.3f} ({found.low:.3f}..{found.high:.3f}){' points' if figure.counted else ''}"
        return f"{self.verdict}  {goal.figure} of {of}: {value}, wanted {wanted}"


def judge(goals: Sequence[Goal], samples: Sequence[Sample]) -> Iterator[Judged]:
    """Compares samples with goals.

    A goal is reached if the figure's whole interval is within its bounds, and missed if all of it is outside; else
    the seeds are too few to tell. The interval is one of 90 %, so that each bound is tested at 5 %: with at_least and
    at_most, that is a test of equivalence (two one-sided tests).
    """
    by_name = {sample.name: sample for sample in samples}
    for goal in goals:
        figure, sample = FIGURES[goal.figure], by_name[goal.condition]
        if goal.against:
            yield Judged(goal, compare(figure, sample, by_name[goal.against], _GOAL_LEVEL))
        else:
            yield Judged(goal, estimate(figure, sample, _GOAL_LEVEL))
