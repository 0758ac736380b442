"""Environments and worlds by name: drawn in C from Python's random numbers, fair, and turned the right way round."""

import itertools
import math
import random

import numpy as np
import pytest

from host_sim.base.errors import UsageError
from host_sim.world.body import rolled
from host_sim.world.geometry import Pose, SimParams, ahead_of
from host_sim.world.layouts import Layout, NoRoomError, generate
from host_sim.world.names import WORLD_NAMES
from host_sim.world.world_library import world_library
from host_sim.world.worlds import world_of
from tests.world.clearances import can_reach, clearances_mm, is_fair
from tests.world.golden_layouts import DIGESTS, WANTED, digest, numbers, world

PARAMS = SimParams()


def room_mm(layout: Layout, *points: tuple[float, float]) -> list[float]:
    return [float(room) for room in clearances_mm(np.array(points), layout.bars, PARAMS)]


def test_a_faster_left_wheel_turns_right_and_right_turns_are_positive() -> None:
    assert rolled(Pose(0.0, 0.0, 0.0), left_mm=2.0, right_mm=1.0, track_mm=100.0).heading_rad == pytest.approx(0.01)


def test_heading_0_looks_along_x_and_90_degrees_to_the_right_of_it_is_down_the_screen() -> None:
    pose = Pose(10.0, 20.0, 0.0)

    assert ahead_of(pose, 5.0) == pytest.approx((15.0, 20.0))
    assert ahead_of(pose, 5.0, math.pi / 2) == pytest.approx((10.0, 25.0))


def test_a_bearing_counts_from_the_heading() -> None:
    assert ahead_of(Pose(0.0, 0.0, math.pi / 2), 5.0, math.pi / 2) == pytest.approx((-5.0, 0.0))


@pytest.mark.parametrize(("seed", "number"), [(2, 1), (1, 2), (-1, 1), (11, 1), (1, 11)])
def test_another_seed_or_number_gives_another_environment(seed: int, number: int) -> None:
    assert generate(seed, number, PARAMS) != generate(1, 1, PARAMS)


def test_food_behind_obstacles_is_drawn_again() -> None:
    # Bars almost as long as the arena is high: most draws cut it in two.
    params = SimParams(bar_count=3, bar_length_mm=(2700.0, 2900.0))
    for seed in range(10):
        layout = generate(seed, 1, params)

        assert all(can_reach(layout, food, params) for food in layout.food)


def test_starts_look_every_way() -> None:
    headings = [generate(seed, 1, PARAMS).start.heading_rad for seed in range(100)]

    quarters = {math.floor(heading / (math.pi / 2)) for heading in headings}
    assert quarters == {-2, -1, 0, 1}


def test_a_world_without_room_is_refused_with_its_seed_and_number() -> None:
    with pytest.raises(ValueError, match="seed 5, number 3"):
        generate(5, 3, SimParams(width_mm=300.0, height_mm=300.0, bar_count=0))


@pytest.mark.parametrize("params", [SimParams(bar_count=65), SimParams(food_bands_mm=((0.0, 4000.0),) * 21)])
def test_more_than_can_be_drawn_is_refused(params: SimParams) -> None:
    with pytest.raises(ValueError, match="at most 64 obstacles and 20 pieces of food"):
        generate(1, 1, params)


def test_no_robot_starts_within_reach_of_another_or_of_an_obstacle() -> None:
    layout = generate(3, 1, PARAMS, robots=20)
    reach_mm = PARAMS.body_radius_mm + PARAMS.sensor_reach_mm

    apart = [math.dist(a[:2], b[:2]) for a, b in itertools.combinations(layout.starts, 2)]
    assert min(apart) >= reach_mm + PARAMS.body_radius_mm
    assert min(room_mm(layout, *(start[:2] for start in layout.starts))) >= reach_mm


def test_more_robots_than_there_is_room_for_say_how_many_fit() -> None:
    small = SimParams(width_mm=1500.0, height_mm=1500.0, bar_count=0, food_bands_mm=((0.0, 1500.0),))

    with pytest.raises(NoRoomError, match=r"there is room for \d+ robots in environment 1") as raised:
        generate(1, 1, small, robots=60)

    assert len(generate(1, 1, small, robots=raised.value.fitting).starts) == raised.value.fitting


def drawn(text: str, count: int) -> list[float]:
    ffi, library = world_library()
    draws = ffi.new("struct draws *")
    library.draws_seed(draws, text.encode())
    return [library.draws_next(draws) for _ in range(count)]


def drawn_by_python(text: str, count: int) -> list[float]:
    draws = random.Random(text)
    return [draws.random() for _ in range(count)]


def test_the_first_numbers_of_many_seeds_are_those_of_python():
    for seed in (*range(2000), -1, 2**32 - 1, 2**63 - 1, -(2**63)):
        text = f"octet {seed} {seed % 7}"

        assert drawn(text, 3) == drawn_by_python(text, 3), text


def test_the_numbers_of_a_text_of_any_length_are_those_of_python():
    for length in range(101):
        text = "".join(chr(33 + (7 * i) % 90) for i in range(length))

        assert drawn(text, 3) == drawn_by_python(text, 3), text


@pytest.mark.parametrize("text", ["octet 1 1", "octet 7 3 starts", ""])
def test_a_long_sequence_is_that_of_python(text):
    assert drawn(text, 10_000) == drawn_by_python(text, 10_000)


@pytest.mark.parametrize("name", DIGESTS)
def test_the_layouts_of_a_world_stay_the_same_for_ever(name):
    assert digest(numbers(world(name).generate(*which)) for which in WANTED) == DIGESTS[name]


SEEDS = range(15)


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_every_environment_of_every_world_is_fair(name):
    world = world_of(name)

    assert all(is_fair(world.generate(seed, 1), world.params) for seed in SEEDS)


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_a_seed_and_a_number_name_one_environment(name):
    world = world_of(name)

    assert world.generate(3, 2) == world.generate(3, 2)
    assert len({world.generate(seed, number) for seed in (1, 2) for number in (1, 2)}) == 4


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_several_robots_find_room_in_every_world(name):
    assert len(world_of(name).generate(5, 1, robots=3).starts) == 3


def test_the_random_world_is_that_of_generate():
    assert world_of("random").generate(7, 2, 3) == generate(7, 2, SimParams(), 3)


def test_all_bars_are_inside_the_arena():
    for name in WORLD_NAMES:
        world = world_of(name)
        for x, y in (end for seed in SEEDS for bar in world.generate(seed, 1).bars for end in bar):
            assert 0 <= x <= world.params.width_mm
            assert 0 <= y <= world.params.height_mm


@pytest.mark.parametrize(
    ("text", "meant"),
    [("corridor", "did you mean corridors?"), ("moon", "choose from random, corridors"), ("", "choose from")],
)
def test_a_world_that_there_is_not_is_refused_with_what_was_meant(text, meant):
    with pytest.raises(UsageError, match=meant.replace("?", r"\?")):
        world_of(text)
