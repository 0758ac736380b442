"""A figure beside its reference, both measured in turn in the same run."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from host_sim.lab.table import aligned

ROUNDS = 3
"""Number of measurements of each figure. The best counts: the others were disturbed by other load."""


class Value(NamedTuple):
    """A measured quantity: its name, its value, and how to measure it again in the next round."""

    name: str
    measure: Callable[[], float]


@dataclass(frozen=True)
class Figure:
    """One row: our value, that of the reference, and their ratio.

    Attributes:
        name: The measured quantity.
        value: Measured value.
        unit: Unit of both values.
        reference: Name of the reference.
        reference_value: Its value.
        ratio: Value divided by that of the reference.
        bar: Target for the ratio, such as ">= 0.7".
        reached: Whether the ratio reaches it.
    """

    name: str
    value: float
    unit: str
    reference: str
    reference_value: float
    ratio: float
    bar: str
    reached: bool


def rate(ours: Value, reference: Value, at_least: float, unit: str = "ticks/s") -> Figure:
    """A figure of which more is better."""
    rounds = [(ours.measure(), reference.measure()) for _ in range(ROUNDS)]
    mine, other = (max(column) for column in zip(*rounds, strict=True))
    ratio = mine / other
    return Figure(ours.name, mine, unit, reference.name, other, ratio, f">= {at_least:g}", ratio >= at_least)


def cost(ours: Value, reference: Value, at_most: float, unit: str = "ms") -> Figure:
    """A figure of which less is better."""
    rounds = [(ours.measure(), reference.measure()) for _ in range(ROUNDS)]
    mine, other = (min(column) for column in zip(*rounds, strict=True))
    ratio = mine / other
    return Figure(ours.name, mine, unit, reference.name, other, ratio, f"<= {at_most:g}", ratio <= at_most)


def table(figures: Sequence[Figure]) -> str:
    """The figures as a table."""
    rows = [("figure", "measured", "reference", "measured", "ratio", "bar", "")]
    for it in figures:
        values = [f"{value:.{0 if value >= 100 else 2}f} {it.unit}" for value in (it.value, it.reference_value)]  # noqa: PLR2004
        verdict = "reached" if it.reached else "MISSED"
        rows.append((it.name, values[0], it.reference, values[1], f"{it.ratio:.2f}", it.bar, verdict))
    return "\n".join(aligned(rows))
