"""Room and ways in C against a second opinion in numpy."""

import heapq
import itertools
import math
import random
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from host_sim.world.geometry import Bar, Plant, SimParams
from host_sim.world.reach import Reach, clearance_mm, tour_mm
from host_sim.world.worlds import world_of
from tests.world.golden_layouts import CELL_MM, clearances_mm, flooded, free_cells, length, middles

PARAMS = SimParams()
Floats = NDArray[np.float64]


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


def test_reached_cells_equal_those_of_numpy_in_20_crowded_layouts():
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


def test_start_in_a_blocked_cell_reaches_nothing():
    reach = Reach((Bar((900.0, 1000.0), (1100.0, 1000.0)),), (1000.0, 1000.0), PARAMS)

    assert reach.distance_mm((1000.0, 1000.0)) == math.inf


def test_clearance_equals_that_of_numpy_to_the_last_bit():
    for seed in range(300):
        draws = random.Random(seed)
        bars, plants = crowd(draws)
        points = [(draws.uniform(-100.0, 4100.0), draws.uniform(-100.0, 3100.0)) for _ in range(20)]

        one_by_one = [clearance_mm(point, bars, PARAMS, plants) for point in points]

        assert one_by_one == clearances_mm(np.array(points), bars, PARAMS, plants).tolist(), seed


CORNERS = 48
"""Of the polygon that a rounded end is in the second opinion, around the circle."""


def corners_of(bars: tuple[Bar, ...], room_mm: float) -> Floats:
    """Corners of polygons just around the ends of bars."""
    angles = 2 * math.pi * np.arange(CORNERS) / CORNERS
    ring = np.stack([np.cos(angles), np.sin(angles)], -1) * room_mm / math.cos(math.pi / CORNERS)
    return np.concatenate([end + ring for bar in bars for end in bar])


def visible(points: Floats, bars: tuple[Bar, ...], room_mm: float, params: SimParams) -> NDArray[np.bool_]:
    """Which points a straight way joins."""
    inside = (
        (points >= params.body_radius_mm) & (points <= np.array([params.width_mm, params.height_mm]) - 100.0)
    ).all(-1)
    free = np.logical_and.outer(inside, inside)
    ways = points[None] - points[:, None]
    for bar in bars:
        clear = apart(points, np.array(bar.a), np.subtract(bar.b, bar.a)) > room_mm - 1e-6
        free &= np.logical_and.outer(clear, clear)
        for end in bar:
            free &= apart(np.array(end), points[:, None], ways) > room_mm - 1e-6
        sides = cross(np.subtract(bar.b, bar.a), points - bar.a)
        across, beyond = (cross(ways, end - points[:, None]) for end in bar)
        free &= (np.multiply.outer(sides, sides) > 0) | (across * beyond > 0)
    return free


def apart(at: Floats, a: Floats, way: Floats) -> Floats:
    """How far points are from ways."""
    part = ((at - a) * way).sum(-1) / np.maximum((way * way).sum(-1), 1e-9)
    return np.asarray(length(*np.moveaxis(at - a - np.clip(part, 0, 1)[..., None] * way, -1, 0)))


def cross(one: Floats, other: Floats) -> Floats:
    return np.asarray(np.sign(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]))


def shortest(ways: Floats, start: int) -> list[float]:
    best, heap = [math.inf] * len(ways), [(0.0, start)]
    while heap:
        way, at = heapq.heappop(heap)
        if way < best[at]:
            best[at] = way
            for to in np.flatnonzero(way + ways[at] < best).tolist():
                heapq.heappush(heap, (way + float(ways[at, to]), to))
    return best


def test_shortest_tour_equals_that_around_polygons_within_1_percent():
    world = world_of("small")
    room_mm = world.params.body_radius_mm + world.params.bar_thickness_mm / 2
    around = 0
    for seed in range(1, 7):
        layout = world.generate(seed, 1)
        points = np.array([layout.start[:2], *layout.food, *corners_of(layout.bars, room_mm)])
        ways = np.where(
            visible(points, layout.bars, room_mm, world.params), length(*(points[:, None] - points).T), math.inf
        )
        between = [shortest(ways, place) for place in range(4)]
        best = min(between[0][a] + between[a][b] + between[b][c] for a, b, c in itertools.permutations((1, 2, 3)))

        tour = tour_mm(layout, world.params)

        assert best * 0.99 < tour < best + 0.1, seed
        around += not np.isfinite(ways[:4, :4]).all()
    assert around > 2, "hardly anything was in the way"


def test_tour_of_too_many_places_is_infinite():
    layout = world_of("small").generate(1, 1)

    assert math.isfinite(tour_mm(replace(layout, food=layout.food[:1]), PARAMS))
    assert tour_mm(replace(layout, food=tuple((200.0 + i, 300.0) for i in range(9))), PARAMS) == math.inf
