"""The fixed layout of a world that a person wrote."""

import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from host_sim.world.geometry import Bar, Point
from host_sim.world.world_library import world_library

KEYS = ("size", "start", "food", "bars")
"""The keys of a written world, in the order of `enum written_key`."""

_LISTS = KEYS[2:]


@dataclass(frozen=True)
class WrittenLayout:
    """Always the same layout; only a start that is not given is drawn.

    Attributes:
        bars: The obstacles.
        food: Centers of the pieces of food, at least one.
        start: The first robot's start, x and y in mm and the heading in degrees; None to draw one each time.
    """

    bars: tuple[Bar, ...]
    food: tuple[Point, ...]
    start: tuple[float, float, float] | None = None

    def content(self) -> dict[str, list[Any]]:
        """The keys and values that it is written with."""
        start = {} if self.start is None else {"start": list(self.start)}
        return {**start, "food": [list(at) for at in self.food], "bars": [[*a, *b] for a, b in self.bars]}

    def in_c(self) -> Any:
        """The same as a `struct written *`."""
        return written_in_c(self.content())


def written_in_c(content: Mapping[str, Any]) -> Any:
    """A `struct written *` with what was written as these keys and values, right or wrong.

    Raises:
        OctetError: The C code is not built.
    """
    ffi, library = world_library()
    written = ffi.new("struct written *")
    library.written_clear(written)
    for key in content.keys() & KEYS:
        number, value = KEYS.index(key), content[key]
        if key not in _LISTS:
            _put(library.written_entry(written, number, 0), value)
        elif not isinstance(value, list):
            library.written_list(written, number, library.WRITTEN_NO_LIST)
        else:
            library.written_list(written, number, len(value))
            for index, entry in enumerate(value[: library.LAYOUT_BARS_MAX]):
                if there := library.written_entry(written, number, index):
                    _put(there, entry)
    return written


def _put(there: Any, entry: object) -> None:
    """Fills in a `struct written_entry *`."""
    if not isinstance(entry, list):
        there.count = -1
        return
    there.count, there.numbers = len(entry), [_number(part) for part in entry[: len(there.numbers)]]


def _number(part: object) -> float:
    if isinstance(part, bool) or not isinstance(part, (int, float)):
        return math.nan
    return float(part) if abs(part) < sys.float_info.max else math.inf
