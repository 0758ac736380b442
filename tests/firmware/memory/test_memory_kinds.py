"""The simulator knows the kinds of memory as the firmware does."""

import random

import pytest

from host_sim.protocol.generated import SIDES, MemoryKind
from host_sim.protocol.memory_kinds import kinds_of, sides_of, translated, with_sides
from tests.firmware.memory.memories import MEMORIES, random_memory
from tests.firmware.octet_c import load

FFI, C = load()
SAMPLE = [tuple(cells.tolist()) for kind in MemoryKind for cells in MEMORIES[kind][::7]]


def kinds_in_c(memory: bytes) -> list[MemoryKind]:
    return [kind for kind in MemoryKind if C.memory_is(memory, int(kind))]


def random_bytes(dice: random.Random) -> bytes:
    """A memory with at most one byte that may be anything."""
    memory = bytearray(random_memory(dice.choice(list(MemoryKind)), dice))
    memory[dice.randrange(8)] = dice.choice([0, 1, 2, 3, 5, 0x0F, 0x1F, dice.randrange(256)])
    return bytes(memory)


def test_bytes_are_of_the_same_kinds():
    dice = random.Random(1)
    cases = [random_bytes(dice) for _ in range(20_000)]

    assert [memory for memory in cases if kinds_of(tuple(memory)) != kinds_in_c(memory)] == []
    assert {tuple(kinds_of(tuple(memory))) for memory in cases} >= {(), *((kind,) for kind in MemoryKind)}


@pytest.mark.parametrize("kind", MemoryKind)
def test_a_memory_is_translated_to_the_same_bytes(kind):
    memory = FFI.new("struct memory *")
    for before in SAMPLE:
        memory.cell = before
        C.memory_translate(memory, int(kind))
        assert tuple(memory.cell) == translated(before, kind)
        assert kind in kinds_of(translated(before, kind))


@pytest.mark.parametrize("kind", MemoryKind)
def test_a_turn_that_is_written_is_the_one_that_is_shown(kind):
    empty = (0,) * 8
    for pattern in range(1, 8):
        for side in range(len(SIDES)):
            written = with_sides(empty, kind, [(pattern, side)])
            assert kind in kinds_of(written)
            assert sides_of(written) == tuple(side if cell == pattern else 0 for cell in range(8))


def test_what_is_too_short_is_no_memory():
    assert kinds_of((0,) * 7) == []
