"""Reduces a schedule of faults to the smallest one with the same kind of outcome."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from host_sim.lab.campaign.cell import Cell
from host_sim.lab.campaign.outcome import Outcome
from host_sim.transport.rule import Rule, fewer, in_ranges

Attempt = Callable[[Cell], Outcome]
"""Runs a cell."""

_LIMIT_S = 0.5


def shrink(cell: Cell, attempt: Attempt) -> Iterator[Outcome]:
    """Removes what is not needed: whole items, then single strikes of a random fault, then time at the end.

    Yields:
        The outcome of the whole cell, then of each smaller one of the same kind; the last is the smallest.
    """
    found = attempt(cell)
    yield found
    for smaller in (_fewer, _single, _fewer, _shorter):
        for found in smaller(found, attempt):  # noqa: B020 - each begins with the last of the one before
            yield found


def _same(found: Outcome, cell: Cell, attempt: Attempt) -> Outcome | None:
    outcome = attempt(cell)
    return outcome if outcome.kind == found.kind else None


def _fewer(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Removes items for as long as possible."""
    for _, smaller in fewer(found.cell.items, lambda rest: _same(found, found.cell.with_items(rest), attempt)):
        yield smaller


def _single(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Replaces random rules and those for many frames by their strikes, if these alone have the same effect."""
    items = [item for item in found.cell.items if not item.startswith("fault=")]
    strikes = [f"fault={rule}" for rule in in_ranges(list(map(Rule.parse, found.struck)))]
    if not strikes or len(strikes) <= len(found.cell.faults):
        return
    smaller = _same(found, found.cell.with_items([*items, *strikes]), attempt)
    if smaller is not None:
        yield smaller


def _shorter(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Halves the time for as long as the kind of outcome stays the same."""
    while found.cell.limit_s >= 2 * _LIMIT_S:
        half = round(found.cell.limit_s / 2, 1)
        smaller = _same(found, replace(found.cell, limit_s=half), attempt)
        if smaller is None:
            return
        found = smaller
        yield found
