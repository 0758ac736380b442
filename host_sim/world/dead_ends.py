"""A world of dead ends: pockets that are open on one side only."""

import math
import random

from host_sim.world.geometry import Bar, Point, Pose, ahead_of
from host_sim.world.layouts import Layout, between, draw_food, draw_start
from host_sim.world.params import SimParams

_POCKETS = 4
_WIDTH_MM = (380.0, 600.0)
_DEPTH_MM = (400.0, 800.0)


def draw_dead_ends(draws: random.Random, params: SimParams) -> Layout:
    """Draws pockets of three bars, anywhere and open to any side."""
    bars: list[Bar] = []
    while len(bars) < 3 * _POCKETS:
        pocket = _pocket(draws, params)
        if all(_is_inside(end, params) for bar in pocket for end in bar):
            bars += pocket
    return Layout(tuple(bars), draw_food(draws, params), draw_start(draws, params))


def _pocket(draws: random.Random, params: SimParams) -> list[Bar]:
    """The back of a pocket and its two sides."""
    middle = draw_start(draws, params)
    width_mm, depth_mm = between(draws, *_WIDTH_MM), between(draws, *_DEPTH_MM)
    backs = [ahead_of(middle, width_mm / 2, bearing) for bearing in (-math.pi / 2, math.pi / 2)]
    fronts = [ahead_of(Pose(*back, middle.heading_rad), depth_mm) for back in backs]
    return [Bar(backs[0], backs[1]), *(Bar(back, front) for back, front in zip(backs, fronts, strict=True))]


def _is_inside(point: Point, params: SimParams) -> bool:
    edge_mm = params.bar_thickness_mm / 2
    return edge_mm <= point[0] <= params.width_mm - edge_mm and edge_mm <= point[1] <= params.height_mm - edge_mm
