"""How much room there is around a place."""

from collections.abc import Iterable

from host_sim.world.geometry import Bar, Plant, Point
from host_sim.world.native_drawing import Obstacles
from host_sim.world.params import SimParams
from host_sim.world.world_library import world_library


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
    _, library = world_library()
    return float(library.clearance_mm(Obstacles(tuple(bars), tuple(plants), params).in_c, point))
