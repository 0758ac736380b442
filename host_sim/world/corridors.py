"""A world of corridors: walls across the whole arena, each with one door."""

import random

from host_sim.world.geometry import Bar
from host_sim.world.layouts import Layout, between, draw_food, draw_start
from host_sim.world.params import SimParams

_CORRIDOR_MM = 800.0
_DOOR_MM = (450.0, 650.0)


def draw_corridors(draws: random.Random, params: SimParams) -> Layout:
    """Draws parallel walls, up and down or across, with a door anywhere in each."""
    upright = int(draws.random() * 2) == 1
    across_mm, along_mm = params.width_mm, params.height_mm
    if not upright:
        across_mm, along_mm = along_mm, across_mm
    count = round(across_mm / _CORRIDOR_MM)
    bars: list[Bar] = []
    for wall in range(1, count):
        bars += _wall(draws, across_mm * wall / count, along_mm, upright)
    return Layout(tuple(bars), draw_food(draws, params), draw_start(draws, params))


def _wall(draws: random.Random, at_mm: float, length_mm: float, upright: bool) -> list[Bar]:
    """A wall in one part on each side of its door."""
    door_mm = between(draws, *_DOOR_MM)
    first_mm = between(draws, door_mm / 2, length_mm - 1.5 * door_mm)
    parts = [(0.0, first_mm), (first_mm + door_mm, length_mm)]
    return [Bar((at_mm, a), (at_mm, b)) if upright else Bar((a, at_mm), (b, at_mm)) for a, b in parts]
