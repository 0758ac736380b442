"""Clearance around a place in a layout, where the centre of a body can get to, and path lengths."""

from collections.abc import Iterable

from host_sim.world.geometry import Bar, Plant, Point, SimParams
from host_sim.world.layouts import Layout, Obstacles, ReachRoom
from host_sim.world.world_library import world_library

_TANGENTS_MAX = 6000  # the random worlds have 200 to 1500


class Reach:
    """The places that the centre of a body can get to from a start, on a grid.

    >>> reach = Reach((), (2000.0, 1500.0), SimParams())
    >>> (10.0, 10.0) in reach, (3800.0, 2800.0) in reach
    (False, True)
    """

    def __init__(
        self, bars: tuple[Bar, ...], start: Point, params: SimParams, plants: tuple[Plant, ...] = ()
    ) -> None:
        """Finds the places among bars and plants."""
        _, self._library = world_library()
        obstacles = Obstacles(bars, plants, params)
        self._room = ReachRoom(self._library.reach_size(params.width_mm, params.height_mm))
        self._library.reach_find(self._room.in_c, obstacles.in_c, params.body_radius_mm, start)

    def __contains__(self, point: Point) -> bool:
        """Whether it can get to the cell of a point inside the arena."""
        return bool(self._library.reach_has(self._room.in_c, point))

    def distance_mm(self, point: Point) -> float:
        """The distance from a point to the nearest middle of a cell that it can get to; infinite if there is none."""
        return float(self._library.reach_distance_mm(self._room.in_c, point))


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


def tour_mm(layout: Layout, params: SimParams) -> float:
    """The length of the shortest tour: from the start through the middles of all pieces of food, for a body's centre.

    Food is eaten from a distance, so that a robot's path may be shorter: by `eat_reach_mm` on the way to each piece
    and on the way from all but the last.

    >>> from host_sim.world.geometry import Pose
    >>> tour_mm(Layout((), ((2000.0, 200.0), (3000.0, 200.0)), Pose(1000.0, 200.0, 0.0)), SimParams())
    2000.0

    Returns:
        mm; infinite if there is no path, or for more than eight pieces, which have too many orders to try.
    """
    ffi, library = world_library()
    obstacles = Obstacles(layout.bars, (), params)
    places = [layout.start[:2], *layout.food]
    tangents = ffi.new("struct tour_tangent[]", _TANGENTS_MAX)
    tour = ffi.new("struct tour *", {"tangents": tangents, "tangents_max": _TANGENTS_MAX})
    return float(library.tour_mm(tour, obstacles.in_c, params.body_radius_mm, places, len(places)))
