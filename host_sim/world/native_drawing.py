"""What C code is handed to draw layouts and to look for ways (`native/layouts.h`, `native/reach.h`)."""

from collections.abc import Sequence
from typing import Any

from host_sim.world.geometry import Bar, Plant
from host_sim.world.params import SimParams
from host_sim.world.world_library import world_library


class Obstacles:
    """The obstacles and walls of an arena for C code.

    Attributes:
        in_c: A `struct obstacles *`, as long as this object lives.
    """

    def __init__(self, bars: Sequence[Bar], plants: Sequence[Plant], params: SimParams) -> None:
        """Copies them."""
        ffi, _ = world_library()
        self._bars, self._plants = ffi.new("struct bar[]", bars), ffi.new("struct plant[]", plants)
        size = params.width_mm, params.height_mm, params.bar_thickness_mm / 2
        self.in_c: Any = ffi.new("struct obstacles *", (*size, len(bars), len(plants), self._bars, self._plants))


class ReachRoom:
    """Room in which C code looks for ways.

    Attributes:
        in_c: A `struct reach *`, as long as this object lives.
    """

    def __init__(self, cells: int) -> None:
        """Makes room for a number of cells."""
        ffi, _ = world_library()
        self._cells, self._stack = ffi.new("uint8_t[]", cells), ffi.new("uint32_t[]", cells)
        self.in_c: Any = ffi.new("struct reach *", (self._cells, self._stack))


def layout_params(params: SimParams) -> tuple[object, ...]:
    """What a `struct layout_params` is made of."""
    bands = params.food_bands_mm
    return (
        params.width_mm,
        params.height_mm,
        params.body_radius_mm,
        params.sensor_reach_mm,
        params.bar_thickness_mm,
        *params.bar_length_mm,
        [low for low, _ in bands],
        [high for _, high in bands],
        params.bar_count,
        len(bands),
    )
