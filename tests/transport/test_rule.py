"""Rules and events of faults, as a person writes them; the fewest faults that still bring something about."""

import pytest

from host_sim.base.errors import UsageError
from host_sim.protocol.codec import Protocol
from host_sim.protocol.forgery import forgers
from host_sim.transport.faulty_link import FAULTS, Schedule
from host_sim.transport.rule import Event, Rule, fewer, in_ranges, narrower, read_rules

TEXTS = [
    "drop",
    "drop:30%",
    "drop:0.5%@7/to",
    "duplicate:10%:2@100-200",
    "reorder:5%:3/from",
    "delay:0-300ms@100-",
    "corrupt:1%:13",
    "truncate:2",
    "flood:50@9",
    "forge:stop@17/to",
    "forge:MEMORY/from",
    "forge",
]


@pytest.mark.parametrize("text", TEXTS)
def test_rule_is_formatted_as_it_was_parsed(text):
    assert str(Rule.parse(text)) == text


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_has_a_default_size(name):
    Schedule([Rule.parse(name)], 1, forgers(Protocol()))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "drop:",
        "drop:30",
        "drop:101%",
        "drop@0",
        "drop@9-3",
        "drop/up",
        "drop:30%:30%",
        "delay:fast",
        "delay:300-0ms",
        "duplicate:0",
        "corrupt:65",
        "truncate:9",
        "flood:1001",
        "forge:fire",
        "forge:STOP",
        "meteor",
    ],
)
def test_malformed_fault_rule_is_refused_in_one_line(text):
    with pytest.raises(UsageError) as refused:
        Schedule([Rule.parse(text)], 1, forgers(Protocol()))

    assert "\n" not in str(refused.value)


def test_rule_range_counts_from_one_and_includes_its_last_frame():
    rule = Rule.parse("drop@2-3/to")

    assert [rule.covers(number, "to") for number in range(1, 5)] == [False, True, True, False]
    assert not rule.covers(2, "from")


def test_rules_are_read_from_text_or_a_file(tmp_path):
    file = tmp_path / "faults.txt"
    file.write_text("# both ways\ndrop:30%\n\nforge:stop@17/to\n")

    assert read_rules("drop:30%") == ["drop:30%"]
    assert read_rules(f"@{file}") == ["drop:30%", "forge:stop@17/to"]


def test_unreadable_rules_file_is_reported(tmp_path):
    (tmp_path / "binary").write_bytes(b"\xff\xfe")

    with pytest.raises(UsageError, match="cannot read"):
        read_rules(f"@{tmp_path / 'none'}")
    with pytest.raises(UsageError, match="not text"):
        read_rules(f"@{tmp_path / 'binary'}")


@pytest.mark.parametrize("word", ["dorp", "d" * 100_000, "!" * 100_000])
def test_malformed_fault_in_a_file_is_reported_with_its_line(tmp_path, word):
    (tmp_path / "faults.txt").write_text(f"drop\n{word}\n")

    with pytest.raises(UsageError, match=r"^\S+faults\.txt:2: .{10,400}$"):
        read_rules(f"@{tmp_path / 'faults.txt'}")


@pytest.mark.parametrize("text", ["hang:300@150", "reset@150"])
def test_event_is_formatted_as_it_was_parsed(text):
    assert str(Event.parse(text)) == text


@pytest.mark.parametrize("text", ["", "hang", "hang@", "hang:@5", "Hang@5", "hang:300@150s"])
def test_malformed_event_is_refused(text):
    with pytest.raises(UsageError, match="is not an event"):
        Event.parse(text)


def test_fewer_leaves_out_unneeded_items():
    needed = {3, 11}

    *_, (items, result) = fewer(list(range(16)), lambda some: sum(some) if needed <= set(some) else None)

    assert (items, result) == ([3, 11], 14)


def test_fewer_finds_no_smaller_set_if_all_are_needed():
    assert list(fewer([1, 2], lambda _: None)) == []


def test_consecutive_faults_are_merged_into_one_rule():
    strikes = [Rule.parse(text) for text in ("drop@5/to", "drop@3/to", "drop@4/to", "drop@4/from", "corrupt:2@9/to")]

    assert list(map(str, in_ranges(strikes))) == ["corrupt:2@9/to", "drop@4/from", "drop@3-5/to"]


def test_rule_range_is_narrowed_from_both_ends():
    found = narrower(Rule.parse("drop@20-500/to"), lambda rule: rule.first <= 37 and rule.last >= 41)

    assert str(found) == "drop@37-41/to"


def test_rule_for_a_single_frame_is_not_narrowed():
    assert str(narrower(Rule.parse("drop@20/to"), lambda _: True)) == "drop@20/to"
