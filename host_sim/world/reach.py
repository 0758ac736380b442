"""Where in a layout the centre of a body can get to."""

import math
from typing import TYPE_CHECKING

from host_sim.world.geometry import Bar, Plant, Point
from host_sim.world.native_library import NoNativeError
from host_sim.world.native_reach import Grid, native_reach
from host_sim.world.params import SimParams

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_CELL_MM = 25.0


class Reach:
    """The places that the centre of a body can get to from a start, on a grid.

    >>> reach = Reach((), (2000.0, 1500.0), SimParams())
    >>> (10.0, 10.0) in reach, (3800.0, 2800.0) in reach
    (False, True)

    Attributes:
        cells: Which cells it can get to, row by row, with a border of one cell that it cannot: 1, else 0.
    """

    def __init__(
        self, bars: tuple[Bar, ...], start: Point, params: SimParams, plants: tuple[Plant, ...] = ()
    ) -> None:
        """Finds the places among bars and plants."""
        self._grid = grid = grid_of(params)
        first = _cell_of(start, grid)
        in_c = None if plants else _in_c(bars, first, grid, params)  # which knows no plants
        self.cells = _in_python(bars, first, params, plants) if in_c is None else in_c

    def __contains__(self, point: Point) -> bool:
        """Whether it can get to the cell of a point."""
        return bool(self.cells[_cell_of(point, self._grid)])

    def points(self) -> "NDArray[np.float64]":
        """The middles of the cells that it can get to: shape (n, 2), x and y in mm."""
        from host_sim.world.grid import middles  # noqa: PLC0415 - a run begins sooner without numpy

        return middles(self.cells, self._grid)

    def distance_mm(self, point: Point) -> float:
        """The distance from a point to the nearest of these middles; infinite if there are none."""
        from host_sim.world.grid import distance_mm  # noqa: PLC0415 - see above

        return distance_mm(point, self.points())


def _in_c(bars: tuple[Bar, ...], start: int, grid: Grid, params: SimParams) -> bytearray | None:
    try:
        return native_reach(bars, start, grid, params)
    except NoNativeError:
        return None


def _in_python(bars: tuple[Bar, ...], start: int, params: SimParams, plants: tuple[Plant, ...]) -> bytearray:
    from host_sim.world.grid import flooded, free_cells  # noqa: PLC0415 - a run begins sooner without numpy

    return bytearray(flooded(free_cells(bars, grid_of(params), params, plants), start).tobytes())


def _cell_of(point: Point, grid: Grid) -> int:
    """The cell of a point, counted row by row with the border of one cell."""
    return (1 + int(point[1] / _CELL_MM)) * (grid.columns + 2) + 1 + int(point[0] / _CELL_MM)


def grid_of(params: SimParams) -> Grid:
    """The grid of an arena."""
    rows, columns = math.ceil(params.height_mm / _CELL_MM), math.ceil(params.width_mm / _CELL_MM)
    # Clearance changes by at most the distance moved, and no point of a cell is farther than this from its centre.
    corner_mm = _CELL_MM * math.sqrt(0.5)
    return Grid(rows, columns, _CELL_MM, params.body_radius_mm + corner_mm)
