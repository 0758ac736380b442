"""Many brains of the firmware, asked all at once, with random numbers that are wanted.

Memories of each kind, for tests: what a cell may hold, many of them, and any at random.
"""

import itertools
import random
from functools import cache

import numpy as np

from host_sim.protocol.generated import PROFILES, MemoryKind
from tests.firmware.octet_c import library_path, load
from tests.firmware.oracle_robots import Reading

FFI, C = load()
FFI.cdef("void brain_next_each(struct action *, struct brain *, struct config *, struct senses *, size_t);")
ask = FFI.dlopen(str(library_path())).brain_next_each


def default_config():
    config = FFI.new("struct config *")
    C.config_reset(config)
    return config


@cache
def generator_state(choices: tuple[int, ...], wanted: tuple[int, ...]) -> tuple[int, int]:
    """A state of the generator from which random(choices[0]), random(choices[1]).. are as wanted."""
    dice = FFI.new("struct random *")
    drawn, seeds = None, itertools.count()
    while drawn != wanted:
        C.random_seed(dice, next(seeds))
        state = tuple(dice.state)
        drawn = tuple(C.random_below(dice, n) for n in choices)
    return state


KINDS = {"uint8_t": "u1", "_Bool": "?", "int16_t": "i2", "uint16_t": "u2", "enum reason": "u4"}
KINDS |= {"struct memory": "8u1", "struct random": "2u4", "uint8_t[8]": "8u1"}


def layout(struct: str) -> np.dtype:
    """The C struct as numpy sees it."""
    fields = FFI.typeof(struct).fields
    return np.dtype(
        {
            "names": [name for name, _ in fields],
            "formats": [KINDS[field.type.cname] for _, field in fields],
            "offsets": [field.offset for _, field in fields],
            "itemsize": FFI.sizeof(struct),
        }
    )


BRAIN, ACTION = layout("struct brain"), layout("struct action")


class Brains:
    """Many brains of one profile, all asked at once."""

    def __init__(self, profile: str, memories: np.ndarray, repeat_counts: np.ndarray | int) -> None:
        self._config = default_config()
        self.now = np.zeros(np.broadcast_shapes(memories.shape[:-1], np.shape(repeat_counts)), BRAIN)
        self.now["profile"] = PROFILES[profile]
        self.now["memory"], self.now["repeat_count"] = memories, repeat_counts

    def decide(self, reading: Reading, choices: tuple[int, ...] = (2,), draws: tuple[int, ...] = (0,)) -> np.ndarray:
        """What each does next, as an array of ACTION, where its random numbers will be these."""
        self.now["random"] = generator_state(choices, draws)
        actions = np.zeros(self.now.shape, ACTION)
        senses = FFI.new("struct senses *", reading._asdict())
        ask(
            FFI.from_buffer("struct action[]", actions.reshape(-1)),
            FFI.from_buffer("struct brain[]", self.now.reshape(-1), require_writable=True),
            self._config,
            senses,
            self.now.size,
        )
        return actions


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
