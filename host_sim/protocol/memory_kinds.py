"""What the eight bytes of a memory mean, by the behaviour's kind, and how those of one kind become those of another.

The firmware's `memory_kind.c` has the same rules; the bytes tell their kind. An empty memory is one of every kind.
"""

from collections.abc import Iterable, Sequence
from functools import lru_cache

from host_sim.protocol.generated import CELL_COUNT, FEEL, SIDES, MemoryKind, Side

Memory = tuple[int, ...]

_SIDE_BITS, _CONFIDENCES = 2, range(1, 4)
_SIDE_MASK = (1 << _SIDE_BITS) - 1
_TURNS = (Side.LEFT, Side.RIGHT)
_CELLS = {
    MemoryKind.SIDES: {0, *_TURNS},
    MemoryKind.CONFIDENCE: {0, *(sure << _SIDE_BITS | side for sure in _CONFIDENCES for side in _TURNS)},
}
_CACHED = 4096
_READINGS = range(1 << len(FEEL))
_MARK = 0b1111
_BESIDE = (0, FEEL["RIGHT"], FEEL["LEFT"], FEEL["RIGHT"] | FEEL["LEFT"])


@lru_cache(_CACHED)
def kinds_of(memory: Memory) -> list[MemoryKind]:
    """The kinds of memory that some bytes can be; none if they are not a memory.

    >>> kinds_of((0, 1, 0, 0, 2, 0, 0, 0)), kinds_of((0, 3, 0, 0, 0, 0, 0, 0))
    ([<MemoryKind.SIDES: 0>], [])
    """
    if len(memory) != CELL_COUNT:
        return []
    return [kind for kind in MemoryKind if _is(memory, kind)]


@lru_cache(_CACHED)
def sides_of(memory: Memory) -> Memory:
    """The turn for each pattern: what people are shown of a memory of any kind.

    >>> sides_of((0, 5, 0, 0, 14, 0, 0, 0))
    (0, 1, 0, 0, 2, 0, 0, 0)
    """
    if not memory[0]:
        return tuple(cell & _SIDE_MASK for cell in memory)
    return (0, *(_side_of_most(memory, pattern) for pattern in range(1, CELL_COUNT)))


def with_sides(memory: Memory, kind: MemoryKind, sides: Iterable[tuple[int, int]]) -> Memory:
    """A memory with other turns for some patterns: with the least confidence, and whatever the side sensors say."""
    cells = list(memory)
    for pattern, side in sides:
        if kind == MemoryKind.SIDES:
            cells[pattern] = side
        elif kind == MemoryKind.CONFIDENCE:
            cells[pattern] = _CONFIDENCES[0] << _SIDE_BITS | side if side else 0
        else:
            _set_readings(cells, pattern, side)
    return tuple(cells)


def translated(memory: Memory, kind: MemoryKind) -> Memory:
    """A memory as one of a kind; the same if it is one already.

    >>> translated((0, 1, 0, 0, 2, 0, 0, 0), MemoryKind.CONFIDENCE)
    (0, 5, 0, 0, 6, 0, 0, 0)
    """
    if kind in kinds_of(memory):
        return memory
    return with_sides((0,) * CELL_COUNT, kind, list(enumerate(sides_of(memory)))[1:])


def _is(memory: Sequence[int], kind: MemoryKind) -> bool:
    if kind == MemoryKind.ALL_SENSORS:
        return _is_all_sensors(memory)
    return memory[0] == 0 and all(cell in _CELLS[kind] for cell in memory)


def _is_all_sensors(memory: Sequence[int]) -> bool:
    if not any(memory):
        return True
    sides = [_reading(memory, feel) for feel in _READINGS]
    blocked = [feel >> 1 & (CELL_COUNT - 1) for feel in _READINGS]
    in_use = zip(sides[2:], blocked[2:], strict=True)
    return memory[0] & _MARK == _MARK and all(side < (len(SIDES) if blocks else 1) for side, blocks in in_use)


def _reading(memory: Sequence[int], feel: int) -> int:
    """The two bits of a reading of all five sensors."""
    return int.from_bytes(bytes(memory), "little") >> _SIDE_BITS * feel & _SIDE_MASK


def _readings_of(pattern: int) -> list[int]:
    return [pattern << 1 | beside for beside in _BESIDE]


def _side_of_most(memory: Memory, pattern: int) -> int:
    """The turn that more of the readings with a pattern have; where as many have either, none."""
    sides = [_reading(memory, feel) for feel in _readings_of(pattern)]
    left, right = (sides.count(side) for side in _TURNS)
    return Side.NOTHING if left == right else Side.LEFT if left > right else Side.RIGHT


def _set_readings(cells: list[int], pattern: int, side: int) -> None:
    number = int.from_bytes(bytes(cells), "little") | _MARK
    for feel in _readings_of(pattern):
        number = number & ~(_SIDE_MASK << _SIDE_BITS * feel) | side << _SIDE_BITS * feel
    cells[:] = number.to_bytes(CELL_COUNT, "little")
