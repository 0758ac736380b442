"""What the robot feels and sees, with one small obstacle at a time; cones are those that are drawn."""

import math

import pytest

from host_sim.world.arena import Arena
from host_sim.world.geometry import Bar, Point, Pose, SimParams, ahead_of
from host_sim.world.layouts import Layout
from host_sim.world.plain_space import CONE_BEARINGS_DEG, cone_outline, cone_reach_mm, cones_in_c
from host_sim.world.world_library import world_library

PARAMS = SimParams()
START = Pose(2000.0, 1500.0, 0.7)
"""How far a cone's outline is outside its arc in the middle of the cone."""
REACH_MM = PARAMS.body_radius_mm + PARAMS.sensor_reach_mm


def peg(bearing_deg: float, gap_mm: float) -> Bar:
    """A short obstacle square to the bearing, its middle's near face so far from the body's edge."""
    middle = PARAMS.body_radius_mm + gap_mm + PARAMS.bar_thickness_mm / 2
    x, y = ahead_of(START, middle, math.radians(bearing_deg))
    return Bar((x, y), (x + 0.01, y))


def needle_feel(bearing_deg: float) -> int:
    """What is felt of an obstacle of 0.01 mm, 50 mm off the body."""
    point = ahead_of(START, PARAMS.body_radius_mm + 50.0, math.radians(bearing_deg))
    needle = Bar(point, (point[0] + 0.01, point[1]))
    layout = Layout((needle,), (), START)
    return Arena(layout, SimParams(bar_thickness_mm=0.01)).body.sense(0).feel


def feel(*bars: Bar) -> int:
    return Arena(Layout(bars, (), START), PARAMS).body.sense(0).feel


def beacon_mm(*foods: Point, bars: tuple[Bar, ...] = ()) -> int:
    senses = Arena(Layout(bars, foods, START), PARAMS).body.sense(0)
    assert senses.look == (senses.beacon_mm > 0)
    return senses.beacon_mm


def food_at(ahead_mm: float, right_mm: float) -> Point:
    x, y = ahead_of(START, ahead_mm)
    return ahead_of(Pose(x, y, START.heading_rad), right_mm, math.pi / 2)


def bar_across(ahead_mm: float, from_mm: float, to_mm: float) -> Bar:
    """A bar across the robot's way, from so far to so far to its right."""
    return Bar(food_at(ahead_mm, from_mm), food_at(ahead_mm, to_mm))


@pytest.mark.parametrize(("bits", "bearing_deg"), [(1 | 2, 67.5), (2 | 4, 22.5), (4 | 8, -22.5), (8 | 16, -67.5)])
def test_an_obstacle_between_two_cones_sets_both_bits(bits: int, bearing_deg: float) -> None:
    assert feel(peg(bearing_deg, 30.0)) == bits


def test_cones_leave_no_gap_for_a_needle_from_minus_112_to_plus_112_degrees() -> None:
    bearings = [quarter / 4 for quarter in range(-449, 450)]

    missed = [bearing for bearing in bearings if not needle_feel(bearing)]

    assert not missed


@pytest.mark.parametrize("bearing_deg", [-112.6, 112.6])
def test_a_needle_just_outside_the_cones_is_not_felt(bearing_deg: float) -> None:
    assert not needle_feel(bearing_deg)


@pytest.mark.parametrize("bearing_deg", [*range(-110, 111, 7), -112.4, 22.5, 112.4])
def test_cones_reach_60_mm_give_or_take_one(bearing_deg: float) -> None:
    assert feel(peg(bearing_deg, 59.0))
    assert not feel(peg(bearing_deg, 61.0))


def test_a_cone_is_cut_to_its_reach() -> None:
    outline = cone_outline(CONE_BEARINGS_DEG[1], REACH_MM)

    assert outline[0] == (0.0, 0.0)
    assert [math.hypot(x, y) for x, y in outline[1:]] == pytest.approx([REACH_MM] * 5, abs=0.4)


def test_one_of_two_obstacles_in_a_cone_may_leave_without_clearing_the_bit() -> None:
    near, far = peg(0, 20.0), peg(0, 50.0)
    arena = Arena(Layout((near, far), (), START), PARAMS)

    for _ in range(5):
        arena.body.move(-200.0, -200.0)
    with_one = arena.body.sense(5).feel
    for _ in range(10):
        arena.body.move(-200.0, -200.0)

    assert (with_one, arena.body.sense(15).feel) == (4, 0)


def test_food_behind_a_bar_is_not_seen() -> None:
    assert beacon_mm(food_at(700.0, 0.0), bars=(bar_across(400.0, -200.0, 200.0),)) == 0


def test_food_beyond_hidden_food_is_seen_past_the_bar() -> None:
    # The bar ends between the two lines of sight.
    bars = (bar_across(400.0, 21.0, 200.0),)

    assert beacon_mm(food_at(500.0, 45.0), food_at(900.0, -45.0), bars=bars) == round(math.hypot(900.0, 45.0))


def test_the_cones_are_those_that_are_drawn():
    cones = cones_in_c(*world_library(), PARAMS)

    for n, (bit, bearing_deg) in enumerate(CONE_BEARINGS_DEG.items()):
        corners = [(corner.x, corner.y) for corner in cones.of[n].corners]
        assert corners == cone_outline(bearing_deg, cone_reach_mm(bit, PARAMS))
