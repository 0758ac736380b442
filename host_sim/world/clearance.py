"""How much room there is around a place; for many places at once, `clearances_mm` of `host_sim/world/grid.py`."""

from collections.abc import Iterable

from host_sim.world.geometry import Bar, Plant, Point
from host_sim.world.params import SimParams


def clearance_mm(point: Point, bars: Iterable[Bar], params: SimParams, plants: Iterable[Plant] = ()) -> float:
    """The distance from a point to the nearest obstacle or wall.

    >>> clearance_mm((2000.0, 1500.0), [Bar((1900.0, 1800.0), (2100.0, 1800.0))], SimParams())
    280.0

    Args:
        point: The point.
        bars: The bars among the obstacles.
        params: The dimensions of the world.
        plants: The plants among them.

    Returns:
        mm; negative inside an obstacle or beyond a wall.
    """
    x, y = point
    nearest = min(x, params.width_mm - x, y, params.height_mm - y)
    for bar in bars:
        nearest = min(nearest, _distance_mm(x, y, bar) - params.bar_thickness_mm / 2)
    for (at_x, at_y), radius_mm in plants:
        nearest = min(nearest, _length(x - at_x, y - at_y) - radius_mm)
    return nearest


def _distance_mm(x: float, y: float, bar: Bar) -> float:
    """The distance from a point to the centre line of a bar."""
    (ax, ay), (bx, by) = bar
    dx, dy = bx - ax, by - ay
    along = min(max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    return _length(x - ax - along * dx, y - ay - along * dy)


def _length(x: float, y: float) -> float:
    # The C library's hypot, as C and numpy have it; that of Python's math differs in the last bit.
    return abs(complex(x, y))
