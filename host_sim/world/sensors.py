"""The robot's senses in a pymunk space: five proximity cones, and the beam that sees food."""

import math
from collections.abc import Iterable
from typing import NamedTuple

import pymunk

from host_sim.world.geometry import Point, Pose
from host_sim.world.params import SimParams

OBSTACLE = 1
"""Collision type and filter category of obstacles and walls."""

ROBOT = 2
"""Collision type of the robot's disc, and filter category of its disc and cones: queries see cones too."""

CONE_BEARINGS_DEG = {1: 90.0, 2: 45.0, 4: 0.0, 8: -45.0, 16: -90.0}
"""The middle of each cone, to the right of the heading, by its bit of feel."""

_CONE_WIDTH_DEG = 45.0
_ARC_STEPS = 4
_CONE_TYPE = 100
_SEE_OBSTACLES = pymunk.ShapeFilter(mask=OBSTACLE)


class Perimeter:
    """Five cones around the front of a body, without a gap from -112.5 to +112.5 degrees.

    Chipmunk reports when a cone begins and ceases to overlap an obstacle, so that reading costs nothing.

    Attributes:
        feel: One bit for each cone with an obstacle in it, as of the space's last step: right 1, front-right 2,
            front 4, front-left 8, left 16.
    """

    def __init__(self, space: pymunk.Space, body: pymunk.Body, params: SimParams) -> None:
        """Fixes the cones to a body that is in the space."""
        self.feel = 0
        self._overlaps = dict.fromkeys(CONE_BEARINGS_DEG, 0)
        reach_mm = params.body_radius_mm + params.sensor_reach_mm
        for bit, bearing_deg in CONE_BEARINGS_DEG.items():
            cone = pymunk.Poly(body, cone_outline(bearing_deg, reach_mm))
            cone.sensor = True
            cone.collision_type = _CONE_TYPE + bit
            cone.filter = pymunk.ShapeFilter(categories=ROBOT)
            space.add(cone)
            space.on_collision(cone.collision_type, OBSTACLE, begin=self._begin, separate=self._separate, data=bit)

    def _begin(self, _arbiter: pymunk.Arbiter, _space: pymunk.Space, bit: int) -> None:
        self._overlaps[bit] += 1
        self.feel |= bit

    def _separate(self, _arbiter: pymunk.Arbiter, _space: pymunk.Space, bit: int) -> None:
        self._overlaps[bit] -= 1
        if not self._overlaps[bit]:
            self.feel &= ~bit


def cone_outline(bearing_deg: float, reach_mm: float) -> list[Point]:
    """The corners of a cone of 45 degrees with its tip in the body's middle, as seen by a body that looks along +x.

    Args:
        bearing_deg: Where the cone's middle points, to the right of the heading.
        reach_mm: Its length from the middle of the body.

    Returns:
        Six corners of a convex polygon; its outer edge is within 0.4 mm of the arc.
    """
    step = math.radians(_CONE_WIDTH_DEG) / _ARC_STEPS
    first = math.radians(bearing_deg - _CONE_WIDTH_DEG / 2)
    # Corners as much outside the arc as the middles of the edges are inside.
    corner_mm = 2 * reach_mm / (1 + math.cos(step / 2))
    angles = [first + step * i for i in range(_ARC_STEPS + 1)]
    return [(0.0, 0.0), *((corner_mm * math.cos(a), corner_mm * math.sin(a)) for a in angles)]


class Sighting(NamedTuple):
    """Food that is seen: its middle, and its distance from the body's middle in whole mm, at least 1."""

    food: Point
    distance_mm: int


def look(space: pymunk.Space, pose: Pose, foods: Iterable[Point], beam_width_mm: float) -> Sighting | None:
    """The nearest food in the corridor straight ahead that no obstacle hides.

    Args:
        space: Holds the obstacles.
        pose: The robot's.
        foods: The middles of the pieces of food that are left.
        beam_width_mm: Width of the corridor.

    Returns:
        The food and its distance, or None if no food is seen.
    """
    x, y, heading = pose
    ahead_x, ahead_y, half = math.cos(heading), math.sin(heading), beam_width_mm / 2
    nearest = None
    for food in foods:
        dx, dy = food[0] - x, food[1] - y
        if dx * ahead_x + dy * ahead_y <= 0.0 or abs(dy * ahead_x - dx * ahead_y) > half:
            continue
        distance_mm = max(1, round(math.hypot(dx, dy)))
        if (nearest is None or distance_mm < nearest.distance_mm) and not _is_hidden(space, (x, y), food):
            nearest = Sighting(food, distance_mm)
    return nearest


def _is_hidden(space: pymunk.Space, eye: Point, food: Point) -> bool:
    return space.segment_query_first(eye, food, 0.0, _SEE_OBSTACLES) is not None
