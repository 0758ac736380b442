"""Environments: the same for the same seed, fair to the robot, and turned the right way round."""

import itertools
import math

import numpy as np
import pytest

from host_sim.world.body import rolled
from host_sim.world.geometry import Bar, Pose, ahead_of
from host_sim.world.layouts import Layout, NoRoomError, generate
from host_sim.world.params import SimParams
from tests.world.clearances import clearances_mm
from tests.world.walk import can_reach

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


def test_the_same_seed_and_number_give_the_same_environment() -> None:
    assert generate(7, 2, PARAMS) == generate(7, 2, PARAMS)


def test_the_environment_of_a_seed_stays_the_same_for_ever() -> None:
    start = generate(1, 1, PARAMS).start

    assert start == pytest.approx((314.651908, 385.035638, -2.400630), abs=1e-6)


@pytest.mark.parametrize(("seed", "number"), [(2, 1), (1, 2), (-1, 1), (11, 1), (1, 11)])
def test_another_seed_or_number_gives_another_environment(seed: int, number: int) -> None:
    assert generate(seed, number, PARAMS) != generate(1, 1, PARAMS)


def test_clearance_is_the_distance_to_the_nearest_surface() -> None:
    layout = Layout((Bar((1000.0, 1000.0), (2000.0, 1000.0)),), (), Pose(0.0, 0.0, 0.0))

    beside, beyond_the_end, by_the_wall, inside, outside = room_mm(
        layout, (1500.0, 1100.0), (2130.0, 1000.0), (4.0, 500.0), (1500.0, 1005.0), (-3.0, 500.0)
    )

    assert (beside, beyond_the_end, by_the_wall) == pytest.approx((80.0, 110.0, 4.0))
    assert (inside, outside) == pytest.approx((-15.0, -3.0))


@pytest.mark.parametrize("seed", range(200))
def test_every_environment_is_fair(seed: int) -> None:
    layout = generate(seed, 1, PARAMS)

    for food, (low, high) in zip(layout.food, PARAMS.food_bands_mm, strict=True):
        assert low <= food[0] <= high
    assert len(layout.bars) == PARAMS.bar_count
    assert min(room_mm(layout, layout.start[:2])) >= PARAMS.body_radius_mm + PARAMS.sensor_reach_mm


@pytest.mark.parametrize("seed", range(200))
def test_every_obstacle_is_as_long_as_it_may_be_and_inside_the_walls(seed: int) -> None:
    half = PARAMS.bar_thickness_mm / 2
    for a, b in generate(seed, 1, PARAMS).bars:
        assert PARAMS.bar_length_mm[0] - 1e-9 <= math.dist(a, b) + 2 * half <= PARAMS.bar_length_mm[1] + 1e-9
        for x, y in (a, b):
            assert half - 1e-9 <= x <= PARAMS.width_mm - half + 1e-9
            assert half - 1e-9 <= y <= PARAMS.height_mm - half + 1e-9


@pytest.mark.parametrize("seed", range(0, 200, 5))
def test_the_body_can_get_from_the_start_to_all_food(seed: int) -> None:
    layout = generate(seed, 1, PARAMS)

    assert all(can_reach(layout, food, PARAMS) for food in layout.food)


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


def test_more_robots_leave_the_layout_and_the_starts_of_fewer_as_they_are() -> None:
    layouts = [generate(7, 2, PARAMS, robots) for robots in (1, 2, 5)]

    assert len({(layout.bars, layout.food, layout.start) for layout in layouts}) == 1
    assert layouts[2].starts[:2] == layouts[1].starts
    assert [len(layout.starts) for layout in layouts] == [1, 2, 5]


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
