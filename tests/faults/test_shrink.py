"""The fewest faults that still bring something about."""

from host_sim.faults.rule import Rule
from host_sim.faults.shrink import fewer, in_ranges, narrower


def test_what_is_not_needed_is_left_out():
    needed = {3, 11}

    *_, (items, result) = fewer(list(range(16)), lambda some: sum(some) if needed <= set(some) else None)

    assert (items, result) == ([3, 11], 14)


def test_what_is_needed_whole_stays():
    assert list(fewer([1, 2], lambda _: None)) == []


def test_strikes_at_frame_after_frame_are_one_rule():
    strikes = [Rule.parse(text) for text in ("drop@5/to", "drop@3/to", "drop@4/to", "drop@4/from", "corrupt:2@9/to")]

    assert list(map(str, in_ranges(strikes))) == ["corrupt:2@9/to", "drop@4/from", "drop@3-5/to"]


def test_a_rule_is_narrowed_from_both_ends():
    found = narrower(Rule.parse("drop@20-500/to"), lambda rule: rule.first <= 37 and rule.last >= 41)

    assert str(found) == "drop@37-41/to"


def test_a_rule_for_one_frame_stays():
    assert str(narrower(Rule.parse("drop@20/to"), lambda _: True)) == "drop@20/to"
