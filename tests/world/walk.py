"""A second opinion on the generator's proof that a body can get to all food."""

import numpy as np

from host_sim.world.layouts import Layout
from host_sim.world.params import SimParams
from tests.world.clearances import clearances_mm

PITCH_MM = 20.0


def can_reach(layout: Layout, goal: tuple[float, float], params: SimParams) -> bool:
    """Whether steps from place to place, where the body fits, lead from the start to a goal."""
    y, x = np.mgrid[0 : params.height_mm : PITCH_MM, 0 : params.width_mm : PITCH_MM]
    places = np.column_stack([x.ravel(), y.ravel()])
    free = (clearances_mm(places, layout.bars, params) >= params.body_radius_mm).reshape(x.shape)
    reached = np.zeros_like(free)
    reached[round(layout.start.y_mm / PITCH_MM), round(layout.start.x_mm / PITCH_MM)] = True
    while True:
        grown = reached.copy()
        grown[1:] |= reached[:-1]
        grown[:-1] |= reached[1:]
        grown[:, 1:] |= reached[:, :-1]
        grown[:, :-1] |= reached[:, 1:]
        grown &= free
        if (grown == reached).all():
            return bool(reached[round(goal[1] / PITCH_MM), round(goal[0] / PITCH_MM)])
        reached = grown


def is_fair(layout: Layout, params: SimParams) -> bool:
    """Whether nothing is within sensor reach of the start or the food, and the body can get to all the food."""
    places = np.array([layout.start[:2], *layout.food])
    room_mm = clearances_mm(places, layout.bars, params).min()
    is_clear = room_mm >= params.body_radius_mm + params.sensor_reach_mm
    return bool(is_clear) and all(can_reach(layout, food, params) for food in layout.food)
