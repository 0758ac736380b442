"""How far away the things are that the proximity cones see, exactly: for robots that ask for distances.

Seen from outside, a capsule is near in one direction and farther away the more one looks past it to either side. So
the nearest of it within a cone is in that direction, or else on one of the cone's two edges.
"""

import math
from collections.abc import Iterable

from host_sim.robot_io import Ranges
from host_sim.world.cones import CONE_BEARINGS_DEG, CONE_WIDTH_DEG, cone_reach_mm
from host_sim.world.geometry import Capsule, Point, Pose
from host_sim.world.params import SimParams

_HALF = math.radians(CONE_WIDTH_DEG / 2)


def ranges_of(pose: Pose, things: Iterable[Capsule], params: SimParams) -> Ranges:
    """What a body at a pose measures.

    >>> wall = Capsule((2000.0, -500.0), (2000.0, 3500.0), 100.0)
    >>> ranges_of(Pose(1770.0, 1500.0, 0.0), [wall], SimParams())
    Ranges(right=None, front_right=41, front=30, front_left=41, left=None)

    Args:
        pose: Where the body is.
        things: All that it may see.
        params: The dimensions of the world.
    """
    reaches = [cone_reach_mm(bit, params) for bit in CONE_BEARINGS_DEG]
    close = [thing for thing in things if _nearest(pose, thing)[0] <= max(reaches)]
    ranges: list[int | None] = []
    for bearing_deg, reach_mm in zip(CONE_BEARINGS_DEG.values(), reaches, strict=True):
        found_mm = min((_in_cone(pose, thing, math.radians(bearing_deg)) for thing in close), default=math.inf)
        ranges.append(max(0, round(found_mm - params.body_radius_mm)) if found_mm <= reach_mm else None)
    return Ranges._make(ranges)


def _in_cone(pose: Pose, thing: Capsule, bearing: float) -> float:
    """Distance from the pose to the nearest of a thing within a cone, mm; infinite if nothing of it is there."""
    nearest_mm, direction = _nearest(pose, thing)
    axis = pose.heading_rad + bearing
    if abs(math.remainder(direction - axis, math.tau)) <= _HALF:
        return nearest_mm
    return min(_along(pose, thing, axis - _HALF), _along(pose, thing, axis + _HALF))


def _nearest(pose: Pose, thing: Capsule) -> tuple[float, float]:
    """Distance from the pose to the nearest of a thing, mm, and the direction to it, rad."""
    (ax, ay), (bx, by), radius_mm = thing
    along_x, along_y, to_x, to_y = bx - ax, by - ay, pose.x_mm - ax, pose.y_mm - ay
    square = along_x * along_x + along_y * along_y
    part = max(0.0, min(1.0, (to_x * along_x + to_y * along_y) / square)) if square else 0.0
    x, y = part * along_x - to_x, part * along_y - to_y
    return math.hypot(x, y) - radius_mm, math.atan2(y, x)


def _along(pose: Pose, thing: Capsule, direction: float) -> float:
    """Distance from the pose to a thing in one direction, mm; infinite if it is not there."""
    ray = math.cos(direction), math.sin(direction)
    a = thing.a[0] - pose.x_mm, thing.a[1] - pose.y_mm
    b = thing.b[0] - pose.x_mm, thing.b[1] - pose.y_mm
    radius_mm = thing.radius_mm
    return min(_to_circle(ray, a, radius_mm), _to_circle(ray, b, radius_mm), _to_side(ray, a, b, radius_mm))


def _to_circle(ray: Point, middle: Point, radius_mm: float) -> float:
    """Distance along a ray from the origin to a circle around a point."""
    ahead_mm = middle[0] * ray[0] + middle[1] * ray[1]
    aside_mm = middle[1] * ray[0] - middle[0] * ray[1]
    if ahead_mm < 0.0 or abs(aside_mm) > radius_mm:
        return math.inf
    return ahead_mm - math.sqrt(radius_mm * radius_mm - aside_mm * aside_mm)


def _to_side(ray: Point, a: Point, b: Point, radius_mm: float) -> float:
    """Distance along a ray from the origin to the nearer side of a capsule, without its round ends."""
    length_mm = math.hypot(b[0] - a[0], b[1] - a[1])
    if not length_mm:
        return math.inf
    way = (b[0] - a[0]) / length_mm, (b[1] - a[1]) / length_mm
    line_mm = a[0] * -way[1] + a[1] * way[0]  # from the origin to the line, square to it, left of the way positive
    toward = ray[0] * -way[1] + ray[1] * way[0]
    side_mm = line_mm - math.copysign(radius_mm, line_mm)
    if line_mm * side_mm <= 0.0 or toward * side_mm <= 0.0:
        return math.inf
    distance_mm = side_mm / toward
    from_a_mm = (distance_mm * ray[0] - a[0]) * way[0] + (distance_mm * ray[1] - a[1]) * way[1]
    return distance_mm if 0.0 <= from_a_mm <= length_mm else math.inf
