"""Kinds of memories, and how those of one become those of another."""

import pytest

from host_sim.protocol.generated import CELL_COUNT, MemoryKind, Side
from host_sim.world.memory_kinds import kinds_of, sides_of, translated, with_sides

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


@pytest.mark.parametrize("kind", MemoryKind)
def test_a_turn_that_is_written_is_the_one_that_is_shown(kind):
    for pattern in range(1, 8):
        for side in Side:
            written = with_sides(EMPTY, kind, [(pattern, side)])
            assert kind in kinds_of(written)
            assert sides_of(written) == tuple(side if cell == pattern else 0 for cell in range(8))
