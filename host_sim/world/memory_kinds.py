"""The kinds of memory, and conversion between them.

Calls the firmware's own `memory.h`. The bytes show their kind; an empty memory is of every kind.
"""

from collections.abc import Iterable
from functools import lru_cache

from host_sim.protocol.generated import CELL_COUNT, MemoryKind
from host_sim.world.world_library import world_library

Memory = tuple[int, ...]

_CACHED = 4096


@lru_cache(_CACHED)
def kinds_of(memory: Memory) -> list[MemoryKind]:
    """The kinds of memory that some bytes can be; none if they are not a memory.

    >>> kinds_of((0, 1, 0, 0, 2, 0, 0, 0)), kinds_of((0, 3, 0, 0, 0, 0, 0, 0))
    ([<MemoryKind.SIDES: 0>], [])
    """
    _, library = world_library()
    return [kind for kind in MemoryKind if len(memory) == CELL_COUNT and library.memory_is(memory, kind)]


@lru_cache(_CACHED)
def sides_of(memory: Memory) -> Memory:
    """The turn for each pattern: what people are shown of a memory of any kind.

    >>> sides_of((0, 5, 0, 0, 14, 0, 0, 0))
    (0, 1, 0, 0, 2, 0, 0, 0)
    """
    return translated(memory, MemoryKind.SIDES)


def with_sides(memory: Memory, kind: MemoryKind, sides: Iterable[tuple[int, int]]) -> Memory:
    """A memory with new turns for some patterns: with the lowest confidence, for all readings of the side sensors."""
    ffi, library = world_library()
    cells = bytearray(memory)
    for pattern, side in sides:
        library.memory_put(ffi.from_buffer("struct memory *", cells), kind, pattern, side)
    return tuple(cells)


def translated(memory: Memory, kind: MemoryKind) -> Memory:
    """A memory converted to a kind; unchanged if it is of that kind already.

    >>> translated((0, 1, 0, 0, 2, 0, 0, 0), MemoryKind.CONFIDENCE)
    (0, 5, 0, 0, 6, 0, 0, 0)
    """
    ffi, library = world_library()
    cells = bytearray(memory)
    library.memory_translate(ffi.from_buffer("struct memory *", cells), kind)
    return tuple(cells)
