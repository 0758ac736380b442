"""Room and ways in C against a second opinion in numpy."""

import math
import random

import numpy as np

from host_sim.world.geometry import Bar, Plant
from host_sim.world.params import SimParams
from host_sim.world.reach import Reach, clearance_mm
from tests.world.clearances import CELL_MM, clearances_mm, flooded, free_cells, length, middles

PARAMS = SimParams()


def random_bar(draws: random.Random) -> Bar:
    """A bar anywhere, often along the middles of cells or exactly at the limit from them."""
    x, y = draws.uniform(0.0, 4000.0), draws.uniform(0.0, 3000.0)
    if draws.random() < 0.5:
        x, y = 12.5 + 25.0 * (x // 25.0), 12.5 + 25.0 * (y // 25.0)
    angle, length = draws.choice([0.0, math.pi / 2, draws.uniform(0.0, 3.0)]), draws.uniform(10.0, 1500.0)
    return Bar((x, y), (x + length * math.cos(angle), y + length * math.sin(angle)))


def crowd(draws: random.Random) -> tuple[tuple[Bar, ...], tuple[Plant, ...]]:
    bars = tuple(random_bar(draws) for _ in range(draws.randint(0, 20)))
    return bars, tuple(Plant((draws.uniform(0.0, 4000.0), 1000.0), 80.0) for _ in range(draws.randint(0, 3)))


def test_the_same_cells_are_reached_in_20_crowded_layouts():
    unlike = 0
    for seed in range(20):
        draws = random.Random(seed)
        bars, plants = crowd(draws)
        start = draws.uniform(0.0, PARAMS.width_mm), draws.uniform(0.0, PARAMS.height_mm)
        reach = Reach(bars, start, PARAMS, plants)

        free = free_cells(bars, PARAMS, plants)
        expected = flooded(free, int(start[1] // CELL_MM), int(start[0] // CELL_MM))

        assert [[tuple(at) in reach for at in row] for row in middles(PARAMS).tolist()] == expected.tolist(), seed
        unlike += bool(0 < expected.sum() < free.sum())
        apart = length(*(middles(PARAMS)[expected] - start).T)
        assert reach.distance_mm(start) == apart.min(initial=math.inf)
    assert unlike > 2, "hardly a layout had a free cell that cannot be reached"


def test_a_start_in_a_blocked_cell_reaches_nothing():
    reach = Reach((Bar((900.0, 1000.0), (1100.0, 1000.0)),), (1000.0, 1000.0), PARAMS)

    assert reach.distance_mm((1000.0, 1000.0)) == math.inf


def test_the_room_around_a_place_is_the_same_to_the_last_bit():
    for seed in range(300):
        draws = random.Random(seed)
        bars, plants = crowd(draws)
        points = [(draws.uniform(-100.0, 4100.0), draws.uniform(-100.0, 3100.0)) for _ in range(20)]

        one_by_one = [clearance_mm(point, bars, PARAMS, plants) for point in points]

        assert one_by_one == clearances_mm(np.array(points), bars, PARAMS, plants).tolist(), seed
