"""How much room there is around a place, and where the centre of a body can get to."""

import math

import numpy as np
from numpy.typing import NDArray

from host_sim.world.geometry import Bar, Plant, Point
from host_sim.world.native_library import NoNativeError
from host_sim.world.native_reach import Grid, native_reach
from host_sim.world.params import SimParams

_CELL_MM = 25.0


def clearance_mm(
    points: NDArray[np.float64], bars: tuple[Bar, ...], params: SimParams, plants: tuple[Plant, ...] = ()
) -> NDArray[np.float64]:
    """Distances from points to the nearest obstacle or wall.

    Args:
        points: Shape (n, 2), x and y in mm.
        bars: The bars among the obstacles.
        params: The dimensions of the world.
        plants: The plants among them.

    Returns:
        Shape (n,), mm; negative inside an obstacle or beyond a wall.
    """
    x, y = points[:, 0], points[:, 1]
    nearest = np.minimum(np.minimum(x, params.width_mm - x), np.minimum(y, params.height_mm - y))
    for bar in bars:
        nearest = np.minimum(nearest, _distance_mm(x, y, bar) - params.bar_thickness_mm / 2)
    for (at_x, at_y), radius_mm in plants:
        nearest = np.minimum(nearest, np.hypot(x - at_x, y - at_y) - radius_mm)
    return nearest


def _distance_mm(x: NDArray[np.float64], y: NDArray[np.float64], bar: Bar) -> NDArray[np.float64]:
    """Distances from points to the centre line of a bar."""
    (ax, ay), (bx, by) = bar
    dx, dy = bx - ax, by - ay
    along = np.clip(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
    return np.asarray(np.hypot(x - ax - along * dx, y - ay - along * dy))


class Reach:
    """The places that the centre of a body can get to from a start, on a grid.

    >>> reach = Reach((), (2000.0, 1500.0), SimParams())
    >>> (10.0, 10.0) in reach, (3800.0, 2800.0) in reach
    (False, True)

    Attributes:
        cells: Which cells it can get to: shape (rows, columns), with a border of one cell that it cannot.
    """

    def __init__(
        self, bars: tuple[Bar, ...], start: Point, params: SimParams, plants: tuple[Plant, ...] = ()
    ) -> None:
        """Finds the places among bars and plants."""
        grid = grid_of(params)
        row, column = cell_of(start)
        first = row * (grid.columns + 2) + column
        in_c = None if plants else _in_c(bars, first, grid, params)  # which knows no plants
        self.cells = flooded(free_cells(bars, grid, params, plants), first) if in_c is None else in_c

    def __contains__(self, point: Point) -> bool:
        """Whether it can get to the cell of a point."""
        return bool(self.cells[cell_of(point)])

    def points(self) -> NDArray[np.float64]:
        """The middles of the cells that it can get to: shape (n, 2), x and y in mm."""
        rows, columns = np.nonzero(self.cells)
        return np.asarray((np.column_stack([columns, rows]) - 0.5) * _CELL_MM, np.float64)


def _in_c(bars: tuple[Bar, ...], start: int, grid: Grid, params: SimParams) -> NDArray[np.bool_] | None:
    try:
        return native_reach(bars, start, grid, params)
    except NoNativeError:
        return None


def cell_of(point: Point) -> tuple[int, int]:
    """Row and column of a point on the grid, which has a border of one cell."""
    return 1 + int(point[1] / _CELL_MM), 1 + int(point[0] / _CELL_MM)


def grid_of(params: SimParams) -> Grid:
    """The grid of an arena."""
    rows, columns = math.ceil(params.height_mm / _CELL_MM), math.ceil(params.width_mm / _CELL_MM)
    # Clearance changes by at most the distance moved, and no point of a cell is farther than this from its centre.
    corner_mm = _CELL_MM * math.sqrt(0.5)
    return Grid(rows, columns, _CELL_MM, params.body_radius_mm + corner_mm)


def flooded(free: NDArray[np.bool_], start: int) -> NDArray[np.bool_]:
    """The free cells that can be got to: what `native_reach` finds, in Python."""
    columns, frontier, unvisited = free.shape[1], [start], bytearray(free.tobytes())
    while frontier:
        cell = frontier.pop()
        if unvisited[cell]:
            unvisited[cell] = False
            frontier += (cell - 1, cell + 1, cell - columns, cell + columns)
    left: NDArray[np.bool_] = np.frombuffer(unvisited, dtype=bool).reshape(free.shape)
    return free & ~left


def free_cells(
    bars: tuple[Bar, ...], grid: Grid, params: SimParams, plants: tuple[Plant, ...] = ()
) -> NDArray[np.bool_]:
    """The cells in which the centre of the body may be anywhere, inside a border of cells where it may not."""
    y, x = (np.indices((grid.rows, grid.columns)) + 0.5) * grid.cell_mm
    room = clearance_mm(np.column_stack([x.ravel(), y.ravel()]), bars, params, plants)
    return np.pad(room.reshape(grid.rows, grid.columns) >= grid.room_mm, 1)
