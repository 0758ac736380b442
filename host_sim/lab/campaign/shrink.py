"""From a schedule of faults the smallest that still brings the same about."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby

from host_sim.faults.rule import Rule
from host_sim.lab.campaign.cell import Cell
from host_sim.lab.campaign.outcome import Outcome

Attempt = Callable[[Cell], Outcome]
"""Runs a cell."""

_LIMIT_S = 0.5


def shrink(cell: Cell, attempt: Attempt) -> Iterator[Outcome]:
    """Takes away what is not needed: whole items, then single strikes of a fault with a chance, then time at the end.

    Args:
        cell: A run with faults.
        attempt: Runs it.

    Yields:
        The outcome of the whole cell, then that of each smaller one of the same kind; the last is the smallest.
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
    """Delta debugging: ever smaller parts of the items are left out, as long as one can be."""
    size = max(len(found.cell.items) // 2, 1)
    while size:
        at = 0
        while at < len(items := found.cell.items):
            rest = items[:at] + items[at + size :]
            smaller = _same(found, found.cell.with_items(rest), attempt) if rest else None
            if smaller is None:
                at += size
            else:
                found = smaller
                yield found
        size //= 2


def _single(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Rules with a chance, or for many frames, become the strikes that they made, if those alone do the same."""
    items = [item for item in found.cell.items if not item.startswith("fault=")]
    strikes = [f"fault={rule}" for rule in _ranges(list(map(Rule.parse, found.struck)))]
    if not strikes or len(strikes) <= len(found.cell.faults):
        return
    smaller = _same(found, found.cell.with_items([*items, *strikes]), attempt)
    if smaller is not None:
        yield smaller


def _ranges(rules: Sequence[Rule]) -> Iterator[Rule]:
    """Strikes of one kind at frame after frame are one rule."""
    kinds = sorted(rules, key=lambda rule: (rule.name, rule.size, rule.directions, rule.first))
    numbered = enumerate(kinds)
    for _, run in groupby(
        numbered, lambda each: (each[1].name, each[1].size, each[1].directions, each[1].first - each[0])
    ):
        strikes = [rule for _, rule in run]
        yield replace(strikes[0], last=strikes[-1].last)


def _shorter(found: Outcome, attempt: Attempt) -> Iterator[Outcome]:
    """Halves the time as long as that changes nothing."""
    while found.cell.limit_s >= 2 * _LIMIT_S:
        half = round(found.cell.limit_s / 2, 1)
        smaller = _same(found, replace(found.cell, limit_s=half), attempt)
        if smaller is None:
            return
        found = smaller
        yield found
