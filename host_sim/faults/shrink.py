"""Reduces a list of faults to the fewest that still cause the same effect."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import TypeVar

from host_sim.faults.rule import Rule

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


def fewer(
    items: list[_Item], attempt: Callable[[list[_Item]], _Result | None]
) -> Iterator[tuple[list[_Item], _Result]]:
    """Delta debugging: leaves out ever smaller parts of the items for as long as possible.

    Yields:
        Ever fewer items that cause the effect, and the result of `attempt` for them; None means no effect.
    """
    size = max(len(items) // 2, 1)
    while size:
        at = 0
        while at < len(items):
            rest = items[:at] + items[at + size :]
            result = attempt(rest) if rest else None
            if result is None:
                at += size
            else:
                items = rest
                yield items, result
        size //= 2


def in_ranges(rules: Sequence[Rule]) -> Iterator[Rule]:
    """Joins strikes of one kind at consecutive frames into one rule."""
    kinds = sorted(rules, key=lambda rule: (rule.name, rule.size, rule.directions, rule.first))
    numbered = enumerate(kinds)
    for _, run in groupby(
        numbered, lambda each: (each[1].name, each[1].size, each[1].directions, each[1].first - each[0])
    ):
        strikes = [rule for _, rule in run]
        yield replace(strikes[0], last=strikes[-1].last)


def narrower(rule: Rule, holds: Callable[[Rule], bool]) -> Rule:
    """Narrows a rule to as few frames as `holds` accepts, removing them at its end, else at its beginning."""
    step = (rule.last - rule.first + 1) // 2
    while step:
        ends = [replace(rule, last=rule.last - step), replace(rule, first=rule.first + step)]
        found = next((each for each in ends if each.first <= each.last and holds(each)), None)
        rule, step = (rule, step // 2) if found is None else (found, step)
    return rule
