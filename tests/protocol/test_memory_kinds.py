"""Kinds of memories, their two halves on the wire, and frames of any node."""

import pytest

from host_sim.protocol.codec import DecodedFrame, Frame, Protocol
from host_sim.protocol.every_node import IDS, Heard, hear
from host_sim.protocol.generated import CELL_COUNT, MemoryKind, Senses
from host_sim.protocol.memory_kinds import kinds_of, sides_of, translated, with_sides
from host_sim.protocol.memory_report import MemoryReport

EMPTY = (0,) * CELL_COUNT
SIDES = (0, 1, 2, 0, 0, 0, 2, 1)


@pytest.mark.parametrize(
    ("memory", "kinds"),
    [
        (EMPTY, list(MemoryKind)),
        ((0, 1, 2, 0, 0, 0, 0, 0), [MemoryKind.SIDES]),
        ((0, 5, 0, 0, 14, 0, 0, 0), [MemoryKind.CONFIDENCE]),
        ((0, 3, 0, 0, 0, 0, 0, 0), []),
        ((1, 0, 0, 0, 0, 0, 0, 0), []),
        ((15, 3, 0, 0, 0, 0, 0, 0), []),
        ((0,) * 7, []),
    ],
)
def test_a_memory_is_of_the_kinds_that_its_bytes_allow(memory, kinds):
    assert kinds_of(memory) == kinds


@pytest.mark.parametrize("kind", MemoryKind)
def test_a_memory_that_becomes_another_kind_keeps_its_turns(kind):
    memory = translated(SIDES, kind)

    assert kind in kinds_of(memory)
    assert sides_of(memory) == SIDES
    assert translated(memory, kind) == memory


@pytest.mark.parametrize("kind", MemoryKind)
def test_a_turn_that_is_taken_away_leaves_an_empty_cell(kind):
    memory = with_sides(translated(SIDES, kind), kind, [(1, 0)])

    assert sides_of(memory) == (0, 0, *SIDES[2:])


def test_readings_of_a_pattern_that_disagree_evenly_are_no_turn():
    memories = (with_sides(EMPTY, MemoryKind.ALL_SENSORS, [(1, side)]) for side in (1, 2))
    left, right = (int.from_bytes(bytes(memory), "little") for memory in memories)
    half = (1 << 12) - 1  # pattern 1 is at readings 2, 3, 18 and 19, two bits each

    mixed = tuple((left & half | right & ~half).to_bytes(CELL_COUNT, "little"))

    assert kinds_of(mixed) == [MemoryKind.ALL_SENSORS]
    assert sides_of(mixed)[1] == 0


def half(number: int, counter: int = 1) -> DecodedFrame:
    cells = {f"cell_{4 * number + i}": 10 * number + i for i in range(4)}
    return DecodedFrame("MEMORY", {"half": number, "counter": counter, **cells})


WHOLE = (0, 1, 2, 3, 10, 11, 12, 13)


def test_halves_are_joined_in_whichever_order_they_come():
    report = MemoryReport()

    assert [report.join(half(0)), report.join(half(1))] == [None, WHOLE]
    assert [report.join(half(1)), report.join(half(0))] == [None, WHOLE]


def test_halves_of_two_reports_are_not_joined():
    report = MemoryReport()

    assert [report.join(half(0, counter=1)), report.join(half(1, counter=2))] == [None, None]
    assert report.join(half(0, counter=2)) == WHOLE


def test_a_half_that_there_is_not_is_left_out():
    report = MemoryReport()
    report.join(half(0))

    assert report.join(half(2)) is None
    assert report.join(half(1)) == WHOLE


SENSES = Protocol(3).encode_senses(Senses(7, 4, False, False, 0, 1, 2), 5)


def test_a_frame_is_heard_as_that_of_its_node():
    heard = hear(SENSES)

    assert (heard.node, heard.name) == (3, "SENSES")
    assert (heard.signals["tick"], heard.signals["feel"]) == (7, 4)


def test_a_damaged_frame_is_its_nodes_and_says_nothing():
    assert hear(Frame(SENSES.id, bytes(8))) == Heard(3, "SENSES", None)


def test_an_identifier_of_no_message_is_nobodys():
    unknown = next(number for number in range(0x800) if number not in IDS)

    assert hear(Frame(unknown, b"")) is None
