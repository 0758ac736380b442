"""What a robot is put into: the measures of its world, and one random layout of obstacles and food.

Axes: x to the right, y down as on a screen, both in mm from the arena's top left corner. Heading 0 looks along +x;
a positive turn is to the right, clockwise as seen. With y down that is the ordinary rotation.
"""

import math
import random
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float]
"""x and y in mm."""

_CELL_MM = 25.0
_TRIES = 1000


@dataclass(frozen=True)
class World:
    """The measures of arena, body and senses. The defaults are the article's screen at 5 mm a pixel.

    Attributes:
        width_mm: Inside width of the walled arena.
        height_mm: Inside height of the walled arena.
        body_radius_mm: Radius of the robot, a disc that turns about its middle.
        wheel_track_mm: Distance between the two driven wheels.
        sensor_reach_mm: How far the proximity cones reach beyond the body.
        beam_width_mm: Width of the corridor straight ahead in which food is seen.
        eat_reach_mm: Food nearer than this to the middle of the body can be eaten.
        bar_count: Number of obstacles.
        bar_thickness_mm: Thickness of an obstacle, and the diameter of its round ends.
        bar_length_mm: Least and greatest length of an obstacle, round ends included.
        food_bands_mm: Least and greatest x of each piece of food.
        tick_s: Length of a control tick.
        max_wheel_speed_mm_s: Faster wheel speeds, either way, are cut to this.
    """

    width_mm: float = 4000.0
    height_mm: float = 3000.0
    body_radius_mm: float = 100.0
    wheel_track_mm: float = 160.0
    sensor_reach_mm: float = 60.0
    beam_width_mm: float = 100.0
    eat_reach_mm: float = 150.0
    bar_count: int = 6
    bar_thickness_mm: float = 40.0
    bar_length_mm: tuple[float, float] = (300.0, 1000.0)
    food_bands_mm: tuple[tuple[float, float], ...] = ((0.0, 1000.0), (1150.0, 2750.0), (2750.0, 4000.0))
    tick_s: float = 0.020
    max_wheel_speed_mm_s: float = 500.0


class Pose(NamedTuple):
    """Where a body is and looks: x and y in mm, heading in rad, -pi..pi."""

    x_mm: float
    y_mm: float
    heading_rad: float


class Bar(NamedTuple):
    """A straight obstacle with round ends: the two ends of its middle line, in mm."""

    a: Point
    b: Point


@dataclass(frozen=True)
class Environment:
    """One layout: obstacles, the middles of the pieces of food, and the robot's first pose."""

    bars: tuple[Bar, ...]
    food: tuple[Point, ...]
    start: Pose


def turned(left_mm: float, right_mm: float, track_mm: float) -> float:
    """The turn in rad, positive to the right, of a body whose wheels roll so far: left faster turns right."""
    return (left_mm - right_mm) / track_mm


def ahead_of(pose: Pose, distance_mm: float, bearing_rad: float = 0.0) -> Point:
    """The point so far from a pose, at a bearing counted to the right from where it looks."""
    angle = pose.heading_rad + bearing_rad
    return pose.x_mm + distance_mm * math.cos(angle), pose.y_mm + distance_mm * math.sin(angle)


def generate(seed: int, number: int, world: World) -> Environment:
    """Draws the environment that belongs to a seed and a number: the same for ever, on every Python.

    Where the robot starts and where food lies, nothing else is within reach of its sensors, and its middle can get
    from the start to every piece of food.

    Args:
        seed: The run's seed, any integer.
        number: Which environment of the run, any integer.
        world: The measures.

    Returns:
        The first layout drawn that is fair in this sense.

    Raises:
        ValueError: The world is so crowded that 1000 draws gave no fair layout.
    """
    draws = random.Random(f"octet {seed} {number}")
    for _ in range(_TRIES):
        environment = _draw(draws, world)
        if _is_fair(environment, world):
            return environment
    raise ValueError(f"no fair environment in {_TRIES} draws for seed {seed}, number {number}: {world}")


def clearance_mm(points: NDArray[np.float64], bars: tuple[Bar, ...], world: World) -> NDArray[np.float64]:
    """Distances from points to the nearest obstacle or wall.

    Args:
        points: Shape (n, 2), x and y in mm.
        bars: The obstacles.
        world: The measures.

    Returns:
        Shape (n,), mm; negative inside an obstacle or beyond a wall.
    """
    x, y = points[:, 0], points[:, 1]
    nearest = np.minimum(np.minimum(x, world.width_mm - x), np.minimum(y, world.height_mm - y))
    for bar in bars:
        nearest = np.minimum(nearest, _distance_mm(x, y, bar) - world.bar_thickness_mm / 2)
    return nearest


def _distance_mm(x: NDArray[np.float64], y: NDArray[np.float64], bar: Bar) -> NDArray[np.float64]:
    """Distances from points to the middle line of a bar."""
    (ax, ay), (bx, by) = bar
    dx, dy = bx - ax, by - ay
    along = np.clip(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
    return np.asarray(np.hypot(x - ax - along * dx, y - ay - along * dy))


def _draw(draws: random.Random, world: World) -> Environment:
    bars = tuple(_draw_bar(draws, world) for _ in range(world.bar_count))
    food = tuple(
        (_between(draws, low, high), _between(draws, 0.0, world.height_mm)) for low, high in world.food_bands_mm
    )
    x, y = _between(draws, 0.0, world.width_mm), _between(draws, 0.0, world.height_mm)
    return Environment(bars, food, Pose(x, y, _between(draws, -math.pi, math.pi)))


def _draw_bar(draws: random.Random, world: World) -> Bar:
    """A bar of any length and angle, anywhere inside the walls."""
    half = (_between(draws, *world.bar_length_mm) - world.bar_thickness_mm) / 2
    angle = _between(draws, 0.0, math.pi)
    dx, dy = half * math.cos(angle), half * math.sin(angle)
    margin_x, margin_y = abs(dx) + world.bar_thickness_mm / 2, abs(dy) + world.bar_thickness_mm / 2
    x = _between(draws, margin_x, world.width_mm - margin_x)
    y = _between(draws, margin_y, world.height_mm - margin_y)
    return Bar((x - dx, y - dy), (x + dx, y + dy))


def _between(draws: random.Random, low: float, high: float) -> float:
    # Of all the generator's methods only random() is promised to stay the same from one Python to the next.
    return low + (high - low) * draws.random()


def _is_fair(environment: Environment, world: World) -> bool:
    """Nothing is in sensor reach at the start or at the food, and a way for the body leads to each piece of food."""
    places = np.array([environment.start[:2], *environment.food])
    reach_mm = world.body_radius_mm + world.sensor_reach_mm
    if clearance_mm(places, environment.bars, world).min() < reach_mm:
        return False
    way = _reachable(environment, world)
    return all(way[_cell(point)] for point in environment.food)


def _cell(point: Point) -> tuple[int, int]:
    """Row and column of a point on the grid of the flood fill, which has a border of one cell."""
    return 1 + int(point[1] / _CELL_MM), 1 + int(point[0] / _CELL_MM)


def _reachable(environment: Environment, world: World) -> NDArray[np.bool_]:
    """The cells of the grid that the middle of the body can get to from the start: shape (rows, columns)."""
    free = _free(environment.bars, world)
    columns, frontier = free.shape[1], [int(np.ravel_multi_index(_cell(environment.start[:2]), free.shape))]
    unvisited = bytearray(free.tobytes())
    while frontier:
        cell = frontier.pop()
        if unvisited[cell]:
            unvisited[cell] = False
            frontier += (cell - 1, cell + 1, cell - columns, cell + columns)
    left: NDArray[np.bool_] = np.frombuffer(unvisited, dtype=bool).reshape(free.shape)
    return free & ~left


def _free(bars: tuple[Bar, ...], world: World) -> NDArray[np.bool_]:
    """The cells in which the middle of the body may be anywhere, inside a border of cells in which it may not."""
    rows, columns = math.ceil(world.height_mm / _CELL_MM), math.ceil(world.width_mm / _CELL_MM)
    y, x = (np.indices((rows, columns)) + 0.5) * _CELL_MM
    room = clearance_mm(np.column_stack([x.ravel(), y.ravel()]), bars, world)
    # Clearance shrinks by at most the way gone, and no point of a cell is farther than this from its middle.
    corner_mm = _CELL_MM * math.sqrt(0.5)
    return np.pad(room.reshape(rows, columns) >= world.body_radius_mm + corner_mm, 1)
