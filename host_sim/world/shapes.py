"""Collision types and filters: which shapes collide in a pymunk space."""

import pymunk

OBSTACLE = 1
"""Collision type of obstacles and walls."""

DISC = 2
"""Collision type of the robots' discs."""

CONES = 100
"""First collision type of the cones; each cone has its own."""

_OBSTACLES, _DISCS, _CONES = 1, 2, 4

OBSTACLE_FILTER = pymunk.ShapeFilter(categories=_OBSTACLES)


def disc_filter(group: int) -> pymunk.ShapeFilter:
    """The filter of a body's disc: it collides with everything but its own cones."""
    return pymunk.ShapeFilter(group=group, categories=_DISCS)


def cone_filter(group: int) -> pymunk.ShapeFilter:
    """The filter of a body's cones: they detect obstacles and the discs of other bodies."""
    return pymunk.ShapeFilter(group=group, categories=_CONES, mask=_OBSTACLES | _DISCS)


def sight_filter(group: int) -> pymunk.ShapeFilter:
    """The filter of a body's line of sight: obstacles and other bodies hide what is behind them."""
    return pymunk.ShapeFilter(group=group, mask=_OBSTACLES | _DISCS)
