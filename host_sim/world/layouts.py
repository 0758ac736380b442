"""One random layout of obstacles and food for each seed and number."""

import math
import random
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.native_library import NoNativeError
from host_sim.world.native_reach import Grid, native_reach
from host_sim.world.params import SimParams

_CELL_MM = 25.0
_TRIES = 1000


@dataclass(frozen=True)
class Layout:
    """The initial layout of an environment.

    Attributes:
        bars: The obstacles.
        food: Centers of the pieces of food.
        start: The first robot's start pose.
        other_starts: The other robots' start poses.
    """

    bars: tuple[Bar, ...]
    food: tuple[Point, ...]
    start: Pose
    other_starts: tuple[Pose, ...] = ()

    @property
    def starts(self) -> tuple[Pose, ...]:
        """Every robot's start pose."""
        return self.start, *self.other_starts


class NoRoomError(ValueError):
    """More robots than fit into an environment.

    Attributes:
        fitting: Number of robots that fit.
    """

    def __init__(self, number: int, fitting: int) -> None:
        """Describes the environment of that number."""
        super().__init__(f"there is room for {fitting} robots in environment {number}")
        self.fitting = fitting


def generate(seed: int, number: int, params: SimParams, robots: int = 1) -> Layout:
    """Draws the layout for a seed and a number: always the same one, with every version of Python.

    The layout is fair: nothing is within sensor reach of a start or of a piece of food, and every piece can be
    reached from each start. More robots do not change the rest of the layout.

    >>> layout = generate(seed=1, number=1, params=SimParams())
    >>> len(layout.bars), len(layout.food), len(layout.starts)
    (6, 3, 1)

    Args:
        seed: The run's seed, any integer.
        number: Number of the environment, any integer.
        params: The dimensions of the world.
        robots: Number of robots, at least 1.

    Returns:
        The first fair layout drawn.

    Raises:
        ValueError: The world is so crowded that 1000 draws gave no fair layout.
        NoRoomError: There is no room for all the robots.
    """
    draws = random.Random(f"octet {seed} {number}")
    for _ in range(_TRIES):
        layout = _draw(draws, params)
        if _is_fair(layout, params):
            return layout if robots == 1 else _with_robots(layout, number, robots, seed, params)
    raise ValueError(f"no fair environment in {_TRIES} draws for seed {seed}, number {number}: {params}")


def clearance_mm(points: NDArray[np.float64], bars: tuple[Bar, ...], params: SimParams) -> NDArray[np.float64]:
    """Distances from points to the nearest obstacle or wall.

    Args:
        points: Shape (n, 2), x and y in mm.
        bars: The obstacles.
        params: The dimensions of the world.

    Returns:
        Shape (n,), mm; negative inside an obstacle or beyond a wall.
    """
    x, y = points[:, 0], points[:, 1]
    nearest = np.minimum(np.minimum(x, params.width_mm - x), np.minimum(y, params.height_mm - y))
    for bar in bars:
        nearest = np.minimum(nearest, _distance_mm(x, y, bar) - params.bar_thickness_mm / 2)
    return nearest


def _distance_mm(x: NDArray[np.float64], y: NDArray[np.float64], bar: Bar) -> NDArray[np.float64]:
    """Distances from points to the centre line of a bar."""
    (ax, ay), (bx, by) = bar
    dx, dy = bx - ax, by - ay
    along = np.clip(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
    return np.asarray(np.hypot(x - ax - along * dx, y - ay - along * dy))


def _with_robots(layout: Layout, number: int, robots: int, seed: int, params: SimParams) -> Layout:
    """The layout with a start for each robot; adding robots does not move the starts of the others."""
    draws = random.Random(f"octet {seed} {number} starts")
    reach_mm = params.body_radius_mm + params.sensor_reach_mm
    way, starts = _reachable(layout, params), [layout.start]
    for _ in range(_TRIES):
        if len(starts) == robots:
            return replace(layout, other_starts=tuple(starts[1:]))
        start = _draw_start(draws, params)
        clear_mm = float(clearance_mm(np.array([start[:2]]), layout.bars, params)[0])
        apart_mm = min(math.dist(start[:2], other[:2]) for other in starts) - params.body_radius_mm
        if way[_cell(start[:2])] and min(clear_mm, apart_mm) >= reach_mm:
            starts.append(start)
    raise NoRoomError(number, len(starts))


def _draw_start(draws: random.Random, params: SimParams) -> Pose:
    x, y = _between(draws, 0.0, params.width_mm), _between(draws, 0.0, params.height_mm)
    return Pose(x, y, _between(draws, -math.pi, math.pi))


def _draw(draws: random.Random, params: SimParams) -> Layout:
    bars = tuple(_draw_bar(draws, params) for _ in range(params.bar_count))
    food = tuple(
        (_between(draws, low, high), _between(draws, 0.0, params.height_mm)) for low, high in params.food_bands_mm
    )
    return Layout(bars, food, _draw_start(draws, params))


def _draw_bar(draws: random.Random, params: SimParams) -> Bar:
    """A bar of random length and angle, anywhere inside the walls."""
    half = (_between(draws, *params.bar_length_mm) - params.bar_thickness_mm) / 2
    angle = _between(draws, 0.0, math.pi)
    dx, dy = half * math.cos(angle), half * math.sin(angle)
    margin_x, margin_y = abs(dx) + params.bar_thickness_mm / 2, abs(dy) + params.bar_thickness_mm / 2
    x = _between(draws, margin_x, params.width_mm - margin_x)
    y = _between(draws, margin_y, params.height_mm - margin_y)
    return Bar((x - dx, y - dy), (x + dx, y + dy))


def _between(draws: random.Random, low: float, high: float) -> float:
    # random() is the only method of the generator that is guaranteed to stay the same across versions of Python.
    return low + (high - low) * draws.random()


def _is_fair(layout: Layout, params: SimParams) -> bool:
    """Whether nothing is within sensor reach of the start or the food, and the body can get to all the food."""
    places = np.array([layout.start[:2], *layout.food])
    reach_mm = params.body_radius_mm + params.sensor_reach_mm
    if clearance_mm(places, layout.bars, params).min() < reach_mm:
        return False
    way = _reachable(layout, params)
    return all(way[_cell(point)] for point in layout.food)


def _cell(point: Point) -> tuple[int, int]:
    """Row and column of a point on the flood-fill grid, which has a border of one cell."""
    return 1 + int(point[1] / _CELL_MM), 1 + int(point[0] / _CELL_MM)


def _reachable(layout: Layout, params: SimParams) -> NDArray[np.bool_]:
    """The grid cells that the centre of the body can get to from the start: shape (rows, columns)."""
    grid = _grid(params)
    row, column = _cell(layout.start[:2])
    start = row * (grid.columns + 2) + column
    try:
        return native_reach(layout.bars, start, grid, params)
    except NoNativeError:
        return _flooded(_free(layout.bars, grid, params), start)


def _grid(params: SimParams) -> Grid:
    rows, columns = math.ceil(params.height_mm / _CELL_MM), math.ceil(params.width_mm / _CELL_MM)
    # Clearance changes by at most the distance moved, and no point of a cell is farther than this from its centre.
    corner_mm = _CELL_MM * math.sqrt(0.5)
    return Grid(rows, columns, _CELL_MM, params.body_radius_mm + corner_mm)


def _flooded(free: NDArray[np.bool_], start: int) -> NDArray[np.bool_]:
    """The free cells that can be got to: what `native_reach` finds, in Python."""
    columns, frontier, unvisited = free.shape[1], [start], bytearray(free.tobytes())
    while frontier:
        cell = frontier.pop()
        if unvisited[cell]:
            unvisited[cell] = False
            frontier += (cell - 1, cell + 1, cell - columns, cell + columns)
    left: NDArray[np.bool_] = np.frombuffer(unvisited, dtype=bool).reshape(free.shape)
    return free & ~left


def _free(bars: tuple[Bar, ...], grid: Grid, params: SimParams) -> NDArray[np.bool_]:
    """The grid cells in which the centre of the body may be anywhere, inside a border of cells where it may not."""
    y, x = (np.indices((grid.rows, grid.columns)) + 0.5) * grid.cell_mm
    room = clearance_mm(np.column_stack([x.ravel(), y.ravel()]), bars, params)
    return np.pad(room.reshape(grid.rows, grid.columns) >= grid.room_mm, 1)
