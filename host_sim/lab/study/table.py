"""Samples side by side, as a table for people."""

import math
from collections.abc import Sequence

import numpy as np

from host_sim.lab.study.bootstrap import Estimate, estimate
from host_sim.lab.study.figures import ALWAYS, FIGURES, Figure
from host_sim.lab.study.sample import Sample
from host_sim.lab.table import aligned

_WITH_HALF_WIDTH = frozenset(("finished", "median_s", "iqm_s", "mean_s", "blocked_s"))
_RATIO = "mean_s"


def table(samples: Sequence[Sample], difference: float = 0.05) -> str:
    """The samples, each compared with the first one.

    Args:
        samples: Samples with the same seeds.
        difference: The difference of two mean times, as a part of them, for which the number of seeds is wanted.
    """
    names = [*ALWAYS, *_others(samples)]
    wanted = f"seeds for {100 * difference:g} %"
    head = ("condition", *(FIGURES[name].heading for name in names), "ratio to the first", wanted)
    lines = [head]
    for sample in samples:
        ratio = estimate(FIGURES[_RATIO], sample, samples[0])
        needed = "-" if sample is samples[0] else _whole(ratio.seeds_for(difference))
        lines.append((sample.name, *(_figure(name, sample) for name in names), _interval(ratio), needed))
    return "\n".join([*aligned(lines), "", _notes(names, wanted)])


def _others(samples: Sequence[Sample]) -> list[str]:
    """The figures that only some studies have."""
    changed = any(not np.isnan(sample.recovery).all() for sample in samples)
    several = any(sample.robots > 1 for sample in samples)
    denied = any(sample.denied.any() for sample in samples)
    return ["denied"] * denied + ["recovered", "recovery"] * changed + ["known_s"] * several


def _figure(name: str, sample: Sample) -> str:
    figure = FIGURES[name]
    if name not in _WITH_HALF_WIDTH:
        return text_of(figure, float(figure.of(sample, np.arange(len(sample.seeds)))))
    found = estimate(figure, sample)
    half = f" ±{found.half_width:.{figure.digits}f}" if math.isfinite(found.half_width) else ""
    return text_of(figure, found.value).replace(figure.unit, half + figure.unit)


def text_of(figure: Figure, value: float) -> str:
    """A value of a figure, with its unit.

    >>> text_of(FIGURES["finished"], 94.66)
    '94.7 %'
    """
    if math.isnan(value):
        return "-"
    return "never" if math.isinf(value) else f"{value:.{figure.digits}f}{figure.unit}"


def _interval(ratio: Estimate) -> str:
    if ratio.seeds == 1:
        return f"{ratio.value:.2f}"
    return f"{ratio.value:.2f} ({ratio.low:.2f}..{ratio.high:.2f})"


def _whole(number: float) -> str:
    return "-" if math.isnan(number) else str(number)


def _notes(names: Sequence[str], wanted: str) -> str:
    notes = {FIGURES[name].heading: FIGURES[name].meaning for name in names}
    notes["±"] = "half of the 95 % interval, by drawing the seeds anew 10,000 times"
    notes["ratio"] = "of the mean times on the same seeds, with its 95 % interval"
    notes[wanted] = "with so many, half of that interval would be this difference"
    return "\n".join(aligned(list(notes.items())))
