"""The worlds that a run can take place in, by name, and those in files."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError, near_word
from host_sim.world.geometry import Bar, SimParams
from host_sim.world.layouts import KEYS, CrateKind, ReachRoom, World, WrittenLayout, layout_params, written_in_c
from host_sim.world.names import CRATES, RANDOM, WORLD_NAMES
from host_sim.world.world_library import world_library


class WrittenError(ValueError):
    """A mistake in a written world; the message says what is expected.

    Attributes:
        key: Where it is: one of the keys, or one that should not be there.
        number: Which entry of its list, from 0; -1 for all of it.
    """

    def __init__(self, key: str, number: int, what: str) -> None:
        """Takes the place and the message."""
        super().__init__(what)
        self.key, self.number = key, number


def read_world_file(path: Path) -> World:
    """Reads a world that a person wrote, in TOML. All its environments have the same obstacles and food.

    Raises:
        UsageError: The file cannot be read, or does not describe a fair world; the message gives the line, and
            what is expected.
    """
    from host_sim.base.toml_file import read_toml  # noqa: PLC0415 - seldom needed, and slow to load

    file = read_toml(path, "a world")
    try:
        return world_from(file.content, path.name)
    except WrittenError as error:
        raise file.error(error, error.key, entry=error.number) from None


def world_from(content: Mapping[str, Any], name: str) -> World:
    """The world that is written as these keys and values; docs/worlds.md explains them.

    >>> world_from({"size": [2000, 1500], "food": [[1000, 750]]}, "my.toml").generate(seed=1, number=1).food
    ((1000.0, 750.0),)

    Args:
        content: What was written.
        name: Name of the world.

    Raises:
        WrittenError: It is not a fair world.
        OctetError: The C code is not built.
    """
    for key in content:
        if key not in KEYS:
            near = near_word(key, KEYS)
            meant = f"did you mean {near!r}?" if near else f"a world has {', '.join(KEYS)}"
            raise WrittenError(key, -1, f"there is no {key!r}: {meant}")
    _check(content)
    usual, start = SimParams(), content.get("start")
    width_mm, height_mm = content.get("size", (usual.width_mm, usual.height_mm))
    layout = WrittenLayout(
        bars=tuple(Bar((ax, ay), (bx, by)) for ax, ay, bx, by in _floats(content.get("bars", []))),
        food=tuple((x, y) for x, y in _floats(content["food"])),
        start=None if start is None else (float(start[0]), float(start[1]), float(start[2])),
    )
    return World(name, SimParams(float(width_mm), float(height_mm)), layout)


def content_of(layout: WrittenLayout, params: SimParams) -> dict[str, Any]:
    """The keys and values from which `world_from` makes an equal world."""
    return {"size": [params.width_mm, params.height_mm], **layout.content()}


def _check(content: Mapping[str, Any]) -> None:
    ffi, library = world_library()
    fault = ffi.new("struct written_fault *")
    params = ffi.new("struct layout_params *", layout_params(SimParams()))
    room = ReachRoom(library.WRITTEN_CELLS_MAX)
    if not library.written_check(written_in_c(content), params[0], room.in_c, fault):
        words = ffi.string(fault.text).decode() % tuple(fault.values[0 : fault.value_count])
        raise WrittenError(KEYS[fault.key], fault.entry, words)


def _floats(entries: list[list[float]]) -> list[list[float]]:
    return [[float(number) for number in entry] for entry in entries]


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
