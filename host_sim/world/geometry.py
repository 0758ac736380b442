"""Points, poses and bars.

Axes: x to the right, y down as on a screen, both in mm from the arena's top left corner. Heading 0 looks along +x;
a positive turn is to the right, clockwise as seen from above. With y down that is the ordinary rotation.
"""

import math
from typing import NamedTuple

Point = tuple[float, float]
"""x and y in mm."""


class Pose(NamedTuple):
    """A body's position and heading: x and y in mm, heading in rad, -pi..pi."""

    x_mm: float
    y_mm: float
    heading_rad: float


class Bar(NamedTuple):
    """A straight obstacle with round ends: the two ends of its centre line, in mm."""

    a: Point
    b: Point


class Plant(NamedTuple):
    """A round obstacle that can grow: its centre and its radius, in mm."""

    at: Point
    radius_mm: float


class Capsule(NamedTuple):
    """All points within the radius of a line: a bar, a wall or, if its ends are equal, a disc."""

    a: Point
    b: Point
    radius_mm: float


def ahead_of(pose: Pose, distance_mm: float, bearing_rad: float = 0.0) -> Point:
    """The point at a distance and bearing from a pose.

    Args:
        pose: Where to start.
        distance_mm: Distance from there.
        bearing_rad: Clockwise from the pose's heading.
    """
    angle = pose.heading_rad + bearing_rad
    return pose.x_mm + distance_mm * math.cos(angle), pose.y_mm + distance_mm * math.sin(angle)
