"""Memories of each kind, for tests: what a cell may hold, many of them, and any at random."""

import itertools
import random

import numpy as np

from host_sim.protocol.generated import MemoryKind

_SIDES = (0, 1, 2)

CELL_VALUES = {MemoryKind.SIDES: _SIDES, MemoryKind.CONFIDENCE: (0, 5, 6, 9, 10, 13, 14)}
"""What the cell of a pattern may hold, where each has one."""


def random_memory(kind: MemoryKind, dice: random.Random) -> bytes:
    """Eight bytes that are a memory of a kind."""
    if kind != MemoryKind.ALL_SENSORS:
        return bytes((0, *dice.choices(CELL_VALUES[kind], k=7)))
    sides = [dice.choice(_SIDES) if feel >> 1 & 7 else 0 for feel in range(32)]
    sides[:2] = (3, 3) if any(sides) else (0, 0)
    return sum(side << 2 * feel for feel, side in enumerate(sides)).to_bytes(8, "little")


def _some(kind: MemoryKind, count: int) -> np.ndarray:
    dice = random.Random(int(kind))
    return np.array([list(random_memory(kind, dice)) for _ in range(count)], np.uint8)


MEMORIES = {
    MemoryKind.SIDES: np.array([(0, *cells) for cells in itertools.product(_SIDES, repeat=7)], np.uint8),
    MemoryKind.CONFIDENCE: _some(MemoryKind.CONFIDENCE, 2187),
    MemoryKind.ALL_SENSORS: _some(MemoryKind.ALL_SENSORS, 256),
}
"""Every memory with a side a cell; so many others that each cell has each content beside each of another cell."""
