"""The grid on which `Reach` finds its places, and what it needs where the C code cannot do it: in numpy."""

import numpy as np
from numpy.typing import NDArray

from host_sim.world.geometry import Bar, Plant, Point
from host_sim.world.native_reach import Grid
from host_sim.world.params import SimParams


def clearances_mm(
    points: NDArray[np.float64], bars: tuple[Bar, ...], params: SimParams, plants: tuple[Plant, ...] = ()
) -> NDArray[np.float64]:
    """For each of many points, what `clearance_mm` is for one, bit for bit.

    Args:
        points: Shape (n, 2), x and y in mm.
        bars: The bars among the obstacles.
        params: The dimensions of the world.
        plants: The plants among them.

    Returns:
        Shape (n,), mm.
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


def middles(cells: bytes | bytearray, grid: Grid) -> NDArray[np.float64]:
    """The middles of the cells that are set, which go row by row, border included: shape (n, 2), x and y in mm."""
    rows, columns = np.nonzero(np.frombuffer(cells, np.bool_).reshape(grid.rows + 2, grid.columns + 2))
    return np.asarray((np.column_stack([columns, rows]) - 0.5) * grid.cell_mm, np.float64)


def distance_mm(point: Point, points: NDArray[np.float64]) -> float:
    """The distance from a point to the nearest of these; infinite if there are none."""
    return float(np.hypot(*(points - point).T).min(initial=np.inf))


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
    room = clearances_mm(np.column_stack([x.ravel(), y.ravel()]), bars, params, plants)
    return np.pad(room.reshape(grid.rows, grid.columns) >= grid.room_mm, 1)
