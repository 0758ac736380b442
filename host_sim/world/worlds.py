"""The worlds that a run can take place in, by name, and those in files."""

from pathlib import Path

from host_sim.base.errors import UsageError
from host_sim.base.near_word import near_word
from host_sim.world.layouts import CrateKind, World
from host_sim.world.params import SimParams
from host_sim.world.world_names import CRATES, RANDOM, WORLD_NAMES
from host_sim.world.written_world import read_world_file

_SMALL = SimParams(
    width_mm=2000.0,
    height_mm=1500.0,
    bar_count=2,
    bar_length_mm=(200.0, 500.0),
    food_bands_mm=((0.0, 600.0), (600.0, 1400.0), (1400.0, 2000.0)),
)

_WORLDS = {
    world.name: world
    for world in (
        World(RANDOM, SimParams()),
        World("corridors", SimParams(), "corridors"),
        World("dead-ends", SimParams(), "dead_ends"),
        World("posts", SimParams(bar_count=24, bar_length_mm=(80.0, 120.0))),
        World("crowded", SimParams(bar_count=14, bar_length_mm=(300.0, 800.0))),
        World("small", _SMALL),
        World(
            CRATES,
            SimParams(bar_count=16, bar_length_mm=(180.0, 240.0), bar_thickness_mm=80.0),
            crates=CrateKind(kg_per_m2=15.0, friction=0.3),
        ),
    )
}


def world_of(text: str) -> World:
    """The world with a name, or the one in a file.

    >>> world_of("small").params.width_mm
    2000.0

    Args:
        text: One of `WORLD_NAMES`, or the path of a file whose name ends with .toml.

    Raises:
        UsageError: There is no such world, or the file does not describe one.
    """
    if text in _WORLDS:
        return _WORLDS[text]
    if text.endswith(".toml"):
        return read_world_file(Path(text))
    near = near_word(text, WORLD_NAMES)
    names = f"choose from {', '.join(WORLD_NAMES)}, or name a file ending in .toml"
    meant = f"did you mean {near}?" if near else names
    raise UsageError(f"there is no world {text!r}: {meant}")
