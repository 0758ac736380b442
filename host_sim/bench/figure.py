"""One measured figure, with the bar that it is to reach and the reference that it is held against."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

ROUNDS = 3
"""Each is measured so often and the best taken: the rest is what else the machine was doing."""


@dataclass(frozen=True)
class Figure:
    """One measured figure.

    Attributes:
        name: What was measured.
        value: How much.
        unit: Of the value.
        bar: What it is to reach, in words; empty if it may be anything.
        reached: Whether it does, and its ratio too.
        bound: What bounds it.
        reference: What it is held against, and how much that is; empty if nothing is.
        ratio: Value by that of the reference; None without one.
        ratio_bar: What the ratio is to reach, in words; empty if it may be anything.
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
    """Something done so many times a second, with the least that is wanted; 0 for anything."""

    name: str
    per_second: float
    at_least: float = 0.0


def rate_figure(ours: Rate, reference: Rate, bound: str) -> Figure:
    """A figure in ticks a second, beside a reference; its `at_least` is that of the ratio."""
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
    """A figure that is to stay below a bar."""
    return Figure(name, round(value, 2), unit, f"< {at_most:g}", value < at_most, bound)


def best(measure: Callable[[], float]) -> float:
    """The greatest of some rounds."""
    return max(measure() for _ in range(ROUNDS))


def table(figures: Sequence[Figure]) -> str:
    """The figures for people."""
    rows = [("figure", "measured", "bar", "reference", "ratio", "bar", "", "bounded by")]
    for figure in figures:
        ratio = "" if figure.ratio is None else f"{figure.ratio:.2f}"
        measured, verdict = f"{figure.value:g} {figure.unit}", "reached" if figure.reached else "MISSED"
        rows.append(
            (figure.name, measured, figure.bar, figure.reference, ratio, figure.ratio_bar, verdict, figure.bound)
        )
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)
