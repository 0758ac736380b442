"""Where in a layout a body can get to, computed in C (`native/reach.h`)."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from host_sim.world.geometry import Bar
from host_sim.world.params import SimParams
from host_sim.world.world_library import world_library


class Grid(NamedTuple):
    """The cells of an arena, without the border of one blocked cell around them.

    Attributes:
        rows: Number of rows.
        columns: Number of columns.
        cell_mm: Size of a cell.
        room_mm: Clearance from walls and bars that the middle of a free cell has at least.
    """

    rows: int
    columns: int
    cell_mm: float
    room_mm: float


def native_reach(bars: Sequence[Bar], start: int, grid: Grid, params: SimParams) -> bytearray:
    """The cells that can be got to.

    Args:
        bars: The obstacles.
        start: The cell to start from, counted row by row with the border.
        grid: The cells.
        params: The dimensions of the world.

    Returns:
        1 for each of them, 0 for the others, row by row with the border.

    Raises:
        NoNativeError: The library cannot be used.
    """
    ffi, library = world_library()
    cells = bytearray((grid.rows + 2) * (grid.columns + 2))
    ends, stack = ffi.new("struct reach_bar[]", [(*bar.a, *bar.b) for bar in bars]), ffi.new("uint32_t[]", len(cells))
    reach: Any = ffi.new("struct reach *")
    reach.width_mm, reach.height_mm = params.width_mm, params.height_mm
    reach.cell_mm, reach.room_mm, reach.bar_radius_mm = grid.cell_mm, grid.room_mm, params.bar_thickness_mm / 2
    reach.rows, reach.columns = grid.rows, grid.columns
    reach.bars, reach.bar_count, reach.stack = ends, len(bars), stack
    library.reach_find(reach, start, ffi.from_buffer("uint8_t[]", cells))
    return cells
