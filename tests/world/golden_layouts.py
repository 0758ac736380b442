"""What layouts were drawn when this was written; they stay the same for ever.

`layouts.json` has a digest for each world: of its numbers to the last bit, which are the same on every machine.
"""

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from host_sim.world.layouts import Layout, World
from host_sim.world.names import WORLD_NAMES
from host_sim.world.worlds import world_from, world_of

DIGESTS: dict[str, str] = json.loads(Path(__file__).with_name("layouts.json").read_text())

WRITTEN = {
    "start drawn": {
        "size": [3000, 2000],
        "food": [[2700, 300], [1500, 1000.5]],
        "bars": [[1000, 0, 1000, 1400], [2000, 600, 2000, 2000]],
    },
    "start given": {"start": [300, 300, -1270.5], "food": [[3500, 2500]], "bars": []},
}


class Which(NamedTuple):
    """Which layout of a world."""

    seed: int
    number: int
    robots: int


WANTED = [Which(seed * 21_474_836, 1 + seed % 3, 1 + seed % 4) for seed in range(100)]


def world(name: str) -> World:
    """One of those in `DIGESTS`."""
    return world_of(name) if name in WORLD_NAMES else world_from(WRITTEN[name], name)


def numbers(layout: Layout) -> list[float]:
    """All numbers of a layout."""
    bars = [x for bar in layout.bars for end in bar for x in end]
    return [*bars, *(x for at in layout.food for x in at), *(x for start in layout.starts for x in start)]


def digest(layouts: Iterable[list[float]]) -> str:
    """The digest of the numbers of layouts."""
    text = "\n".join(" ".join((number + 0.0).hex() for number in layout) for layout in layouts)
    return hashlib.sha256(text.encode()).hexdigest()
