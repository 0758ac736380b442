"""Points, poses and bars.

Axes: x to the right, y down as on a screen, both in mm from the arena's top left corner. Heading 0 looks along +x;
a positive turn is to the right, clockwise as seen. With y down that is the ordinary rotation.
"""

import math
from typing import NamedTuple

Point = tuple[float, float]
"""x and y in mm."""


class Pose(NamedTuple):
    """Where a body is and looks: x and y in mm, heading in rad, -pi..pi."""

    x_mm: float
    y_mm: float
    heading_rad: float


class Bar(NamedTuple):
    """A straight obstacle with round ends: the two ends of its middle line, in mm."""

    a: Point
    b: Point


def ahead_of(pose: Pose, distance_mm: float, bearing_rad: float = 0.0) -> Point:
    """The point so far from a pose, at a bearing counted to the right from where it looks."""
    angle = pose.heading_rad + bearing_rad
    return pose.x_mm + distance_mm * math.cos(angle), pose.y_mm + distance_mm * math.sin(angle)
