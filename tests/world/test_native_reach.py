"""Layouts that are checked in C against those that are checked in Python."""

import math
import random

import numpy as np

from host_sim.world import native_reach, reach
from host_sim.world.clearance import clearance_mm
from host_sim.world.geometry import Bar, Plant
from host_sim.world.grid import clearances_mm, flooded, free_cells
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams
from host_sim.world.reach import Reach, grid_of

PARAMS = SimParams()
SEEDS = range(300)


def random_bar(draws: random.Random) -> Bar:
    """A bar anywhere, often along the middles of cells or exactly at the limit from them."""
    x, y = draws.uniform(0.0, 4000.0), draws.uniform(0.0, 3000.0)
    if draws.random() < 0.5:
        x, y = 12.5 + 25.0 * (x // 25.0), 12.5 + 25.0 * (y // 25.0)
    angle, length = draws.choice([0.0, math.pi / 2, draws.uniform(0.0, 3.0)]), draws.uniform(10.0, 1500.0)
    return Bar((x, y), (x + length * math.cos(angle), y + length * math.sin(angle)))


def test_the_same_cells_are_reached_in_300_crowded_layouts():
    grid, unlike = grid_of(PARAMS), 0
    for seed in SEEDS:
        draws = random.Random(seed)
        bars = tuple(random_bar(draws) for _ in range(draws.randint(0, 20)))
        start = draws.randrange(grid.rows + 2) * (grid.columns + 2) + draws.randint(1, grid.columns)
        if not (1 <= start // (grid.columns + 2) <= grid.rows):
            continue

        in_c = native_reach.native_reach(bars, start, grid, PARAMS)
        in_python = flooded(free_cells(bars, grid, PARAMS), start)

        assert in_c == in_python.tobytes(), seed
        unlike += 0 < in_python.sum() < free_cells(bars, grid, PARAMS).sum()
    assert unlike > 20, "hardly a layout had a free cell that cannot be reached"


def test_in_python_the_same_layouts_are_drawn(monkeypatch):
    in_c = [generate(seed, 1, PARAMS, robots) for seed in SEEDS[:20] for robots in (1, 4)]
    monkeypatch.setattr(reach, "_in_c", lambda *_: None)

    assert [generate(seed, 1, PARAMS, robots) for seed in SEEDS[:20] for robots in (1, 4)] == in_c


def test_a_start_in_a_blocked_cell_reaches_nothing():
    bars = (Bar((900.0, 1000.0), (1100.0, 1000.0)),)

    assert not any(Reach(bars, (1000.0, 1000.0), PARAMS).cells)


def test_the_room_around_a_place_is_the_same_with_numpy_and_without_to_the_last_bit():
    for seed in SEEDS:
        draws = random.Random(seed)
        bars = tuple(random_bar(draws) for _ in range(draws.randint(0, 20)))
        plants = tuple(Plant((draws.uniform(0.0, 4000.0), 1000.0), 80.0) for _ in range(draws.randint(0, 3)))
        points = [(draws.uniform(-100.0, 4100.0), draws.uniform(-100.0, 3100.0)) for _ in range(20)]

        one_by_one = [clearance_mm(point, bars, PARAMS, plants) for point in points]

        assert one_by_one == clearances_mm(np.array(points), bars, PARAMS, plants).tolist(), seed
