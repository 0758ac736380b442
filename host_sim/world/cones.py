"""The five proximity cones around the front of a body: where they point, and their outline."""

import math

from host_sim.world.geometry import Point
from host_sim.world.params import SimParams

CONE_BEARINGS_DEG = {1: 90.0, 2: 45.0, 4: 0.0, 8: -45.0, 16: -90.0}
"""Bearing of each cone's axis, clockwise from the heading, by its bit of feel: -112.5..112.5 without a gap."""

CONE_WIDTH_DEG = 45.0
"""From edge to edge."""

_FRONT = 4
_ARC_STEPS = 4


def cone_reach_mm(bit: int, params: SimParams) -> float:
    """The length of a cone from the centre of the body.

    >>> [cone_reach_mm(bit, SimParams()) for bit in CONE_BEARINGS_DEG]
    [160.0, 160.0, 160.5, 160.0, 160.0]
    """
    return params.body_radius_mm + params.sensor_reach_mm + (params.front_extra_mm if bit == _FRONT else 0.0)


def cone_outline(bearing_deg: float, reach_mm: float) -> list[Point]:
    """The corners of a cone of 45 degrees whose tip is the body's centre, in the frame of a body that faces +x.

    Args:
        bearing_deg: Bearing of the cone's axis, clockwise from the heading.
        reach_mm: Its length from the centre of the body.

    Returns:
        Six corners of a convex polygon, x and y in mm; its outer edge is within 0.4 mm of the arc.
    """
    step = math.radians(CONE_WIDTH_DEG) / _ARC_STEPS
    first = math.radians(bearing_deg - CONE_WIDTH_DEG / 2)
    # The corners are as far outside the arc as the middles of the edges are inside it.
    corner_mm = 2 * reach_mm / (1 + math.cos(step / 2))
    angles = [first + step * i for i in range(_ARC_STEPS + 1)]
    return [(0.0, 0.0), *((corner_mm * math.cos(a), corner_mm * math.sin(a)) for a in angles)]
