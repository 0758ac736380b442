"""One measured figure, with its target and its reference."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from host_sim.lab.table import aligned

ROUNDS = 3
"""Number of measurements of each figure. The best counts: the others were disturbed by other load."""


@dataclass(frozen=True)
class Figure:
    """One measured figure.

    Attributes:
        name: The measured quantity.
        value: Measured value.
        unit: Unit of the value.
        bar: Target for the value, such as ">= 5000"; empty if there is none.
        reached: Whether value and ratio reach their targets.
        bound: The limiting factor.
        reference: Name and value of the reference; empty if there is none.
        ratio: Value divided by that of the reference; None without one.
        ratio_bar: Target for the ratio; empty if there is none.
    """

    name: str
    value: float
    unit: str
    bar: str
    reached: bool
    bound: str
    reference: str = ""
    ratio: float | None = None
    ratio_bar: str = ""


@dataclass(frozen=True)
class Rate:
    """A rate per second and its target; 0 for no target."""

    name: str
    per_second: float
    at_least: float = 0.0


def rate_figure(ours: Rate, reference: Rate, bound: str) -> Figure:
    """A figure in ticks per second, beside a reference; `reference.at_least` is the target for the ratio."""
    ratio = ours.per_second / reference.per_second
    return Figure(
        name=ours.name,
        value=round(ours.per_second),
        unit="ticks/s",
        bar=f">= {ours.at_least:.0f}" if ours.at_least else "",
        reached=ours.per_second >= ours.at_least and ratio >= reference.at_least,
        bound=bound,
        reference=f"{reference.name}: {reference.per_second:.0f}/s",
        ratio=round(ratio, 2),
        ratio_bar=f">= {reference.at_least}" if reference.at_least else "",
    )


def most_figure(name: str, value: float, unit: str, at_most: float, bound: str) -> Figure:
    """A figure whose target is to stay below a limit."""
    return Figure(name, round(value, 2), unit, f"< {at_most:g}", value < at_most, bound)


def best(measure: Callable[[], float]) -> float:
    """The greatest of `ROUNDS` measurements."""
    return max(measure() for _ in range(ROUNDS))


def table(figures: Sequence[Figure]) -> str:
    """The figures as a table."""
    rows = [("figure", "measured", "bar", "reference", "ratio", "bar", "", "bounded by")]
    for figure in figures:
        ratio = "" if figure.ratio is None else f"{figure.ratio:.2f}"
        measured, verdict = f"{figure.value:g} {figure.unit}", "reached" if figure.reached else "MISSED"
        rows.append(
            (figure.name, measured, figure.bar, figure.reference, ratio, figure.ratio_bar, verdict, figure.bound)
        )
    return "\n".join(aligned(rows))
