"""Points, poses and bars, and the dimensions of a world: arena, body and sensors."""

import math
from dataclasses import dataclass
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


@dataclass(frozen=True)
class SimParams:
    """The dimensions of arena, body and sensors. The defaults are the article's screen at 5 mm per pixel.

    Attributes:
        width_mm: Inside width of the walled arena.
        height_mm: Inside height of the walled arena.
        body_radius_mm: Radius of the robot, a disc that turns about its centre.
        wheel_track_mm: Distance between the two driven wheels.
        sensor_reach_mm: How far the proximity cones reach beyond the body.
        front_extra_mm: How much farther the front one reaches. With five equal cones exactly 45 degrees apart, a
            trial turn of 45 degrees carries a wall from the front cone exactly into its neighbour, and the robot
            could never learn what to do about a wall straight ahead. No real ring of sensors is that exact.
        beam_width_mm: Width of the corridor straight ahead in which food is seen.
        eat_reach_mm: Food nearer than this to the centre of the body can be eaten.
        bar_count: Number of obstacles.
        bar_thickness_mm: Thickness of an obstacle, and the diameter of its round ends.
        bar_length_mm: Minimum and maximum length of an obstacle, round ends included.
        food_bands_mm: Minimum and maximum x of each piece of food.
        tick_s: Length of a control tick.
        max_wheel_speed_mm_s: Limit of the wheel speeds, forward and backward.
    """

    width_mm: float = 4000.0
    height_mm: float = 3000.0
    body_radius_mm: float = 100.0
    wheel_track_mm: float = 160.0
    sensor_reach_mm: float = 60.0
    front_extra_mm: float = 0.5
    beam_width_mm: float = 100.0
    eat_reach_mm: float = 150.0
    bar_count: int = 6
    bar_thickness_mm: float = 40.0
    bar_length_mm: tuple[float, float] = (300.0, 1000.0)
    food_bands_mm: tuple[tuple[float, float], ...] = ((0.0, 1000.0), (1150.0, 2750.0), (2750.0, 4000.0))
    tick_s: float = 0.020
    max_wheel_speed_mm_s: float = 500.0
