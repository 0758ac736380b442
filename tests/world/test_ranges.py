"""How far away the robot measures things to be: exactly, against what can be worked out by hand or point by point."""

import math
import random

import pytest

from host_sim.protocol.generated import NOTHING_NEAR, RANGE_NONE, Ranges
from host_sim.world.arena import Arena
from host_sim.world.body_kinds import kind_from
from host_sim.world.edits import Edit
from host_sim.world.geometry import Bar, Capsule, Point, Pose, SimParams, ahead_of
from host_sim.world.layouts import Layout, generate
from host_sim.world.native_world import CONE_BEARINGS_DEG, NativeWorld, cone_outline, cone_reach_mm, cones_in_c
from host_sim.world.world_library import world_library

PARAMS = SimParams()
START = Pose(2000.0, 1500.0, 0.7)
RADIUS_MM = PARAMS.body_radius_mm


def peg(bearing_deg: float, gap_mm: float, radius_mm: float = 20.0) -> Capsule:
    """A disc whose near face is so far from the body's rim."""
    middle = ahead_of(START, RADIUS_MM + gap_mm + radius_mm, math.radians(bearing_deg))
    return Capsule(middle, middle, radius_mm)


def measured(*things: Capsule, pose: Pose = START) -> Ranges:
    inside = NativeWorld(Layout((), (), pose), PARAMS)
    for there, (a, b, radius_mm) in enumerate(things, inside.library.WALLS):
        inside.library.capsule_set(inside.furniture.capsules + there, a, b, radius_mm)
    inside.furniture.capsule_count += len(things)
    inside.lay_out()
    return Ranges._make(None if range_mm == RANGE_NONE else range_mm for range_mm in inside.measure(0, 0))


@pytest.mark.parametrize(("place", "bearing_deg"), list(enumerate(CONE_BEARINGS_DEG.values())))
@pytest.mark.parametrize(("gap_mm", "range_mm"), [(0.0, 0), (0.4, 0), (0.6, 1), (30.4, 30), (59.9, 60)])
def test_thing_in_one_cone_is_measured_in_that_cone_only(place, bearing_deg, gap_mm, range_mm):
    expected = [None] * 5
    expected[place] = range_mm

    assert list(measured(peg(bearing_deg, gap_mm, 5.0))) == expected


@pytest.mark.parametrize(
    ("bearing_deg", "gap_mm", "seen"), [(45, 59.99, True), (45, 60.01, False), (0, 60.49, True), (0, 60.51, False)]
)
def test_front_cone_reaches_half_a_millimetre_farther(bearing_deg, gap_mm, seen):
    assert (measured(peg(bearing_deg, gap_mm)) != NOTHING_NEAR) == seen


def outline_point(bar: Capsule, part: float) -> tuple[float, float]:
    """A point of a capsule's outline, part 0..1 of the way round in angle and along the sides."""
    (ax, ay), (bx, by), radius_mm = bar
    way = math.atan2(by - ay, bx - ax)
    quarter, rest = divmod(4 * part, 1.0)
    if quarter in (0, 2):  # a side
        side = way + (math.pi / 2 if quarter == 0 else -math.pi / 2)
        return (
            ax + rest * (bx - ax) + radius_mm * math.cos(side),
            ay + rest * (by - ay) + radius_mm * math.sin(side),
        )
    (x, y), angle = ((bx, by), way - math.pi / 2) if quarter == 1 else ((ax, ay), way + math.pi / 2)
    return x + radius_mm * math.cos(angle + rest * math.pi), y + radius_mm * math.sin(angle + rest * math.pi)


def point_by_point(bar: Capsule, points: int) -> list[float]:
    """The least distance in each cone, of many points on a bar's outline."""
    found = [math.inf] * 5
    for i in range(points):
        x, y = outline_point(bar, i / points)
        dx, dy = x - START.x_mm, y - START.y_mm
        bearing_deg = math.degrees(math.remainder(math.atan2(dy, dx) - START.heading_rad, math.tau))
        for place, axis_deg in enumerate(CONE_BEARINGS_DEG.values()):
            if abs(bearing_deg - axis_deg) <= 22.5:
                found[place] = min(found[place], math.hypot(dx, dy) - RADIUS_MM)
    return found


def test_range_of_a_bar_equals_the_least_distance_of_its_points():
    dice, compared = random.Random(1), 0
    for _ in range(150):
        gap_mm, bearing = dice.uniform(1.0, 55.0), dice.uniform(-math.pi, math.pi)
        x, y = ahead_of(START, RADIUS_MM + gap_mm + 20.0, bearing)
        # Any bar beside the body: along its rim, or away from it.
        end = ahead_of(Pose(x, y, START.heading_rad), dice.uniform(0.1, 400.0), bearing + dice.uniform(-1.5, 1.5))
        bar = Capsule((x, y), end, 20.0)
        for range_mm, exact_mm in zip(measured(bar), point_by_point(bar, 2000), strict=True):
            if range_mm is None:
                assert exact_mm > PARAMS.sensor_reach_mm - 0.5
            else:
                assert range_mm == pytest.approx(exact_mm, abs=0.9)
                compared += 1
    assert compared > 100


def test_measured_range_agrees_with_the_sensor():
    """Chipmunk's cones have corners where these are round: they differ by up to 0.4 mm."""
    layout, dice, agreed = generate(3, 1, PARAMS), random.Random(2), 0
    arena = Arena(layout, PARAMS)
    for _ in range(100):
        x, y = dice.choice(layout.bars).a
        beside = ahead_of(Pose(x, y, 0.0), dice.uniform(125.0, 185.0), dice.uniform(-math.pi, math.pi))
        body, heading_rad = arena.inside.bodies[0], dice.uniform(-math.pi, math.pi)
        body.x_mm, body.y_mm, body.heading_rad = *beside, heading_rad
        arena.inside.lay_out()
        feel = arena.body.sense(0).feel
        for bit, range_mm in zip(CONE_BEARINGS_DEG, arena.ranges(0), strict=True):
            if range_mm is not None and range_mm < 59:
                assert feel & bit
                agreed += 1
    assert agreed > 50


def told_of_a_wall(
    gap_mm: float, fault: str = "", tick: int = 0, bearing_deg: float = 0.0, **traits: float
) -> Ranges:
    """What a robot with such a body is told with a wall so far away in that direction."""
    pose = Pose(PARAMS.width_mm - RADIUS_MM - gap_mm, 1500.0, math.radians(-bearing_deg))
    arena = Arena(Layout((), (), pose), PARAMS, kind=kind_from(traits))
    arena.begin(1)
    if fault:
        arena.body.add_fault(fault)
    feel = arena.body.sense(tick).feel
    ranges = arena.ranges(0, tick)
    assert feel == sum(1 << bit for bit, range_mm in enumerate(ranges) if range_mm is not None)
    return ranges


def test_real_sensor_measures_as_far_as_its_own_reach():
    assert told_of_a_wall(30, front_mm=40).front == 30
    assert told_of_a_wall(50, front_mm=40).front is None
    assert told_of_a_wall(75, front_mm=80).front == 75


def test_thing_nearer_than_the_fold_distance_seems_farther_away():
    assert told_of_a_wall(20, front_mm=80, fold_mm=30).front == 50


def test_real_sensor_measures_distances_with_its_noise():
    told = {told_of_a_wall(30, tick=tick, noise_mm=5).front for tick in range(40)}

    assert len(told) > 5
    assert told <= set(range(25, 36))


@pytest.mark.parametrize("traits", [{}, {"hysteresis_mm": 1}], ids=["ideal", "real"])
def test_mirrored_sensor_ring_feels_and_measures_on_the_other_side(traits):
    sound, mirrored = (told_of_a_wall(30, fault, bearing_deg=45, **traits) for fault in ("", "mirror"))

    assert sound.front_left is not None or sound.front_right is not None
    assert tuple(mirrored) == sound[::-1] != sound


def test_distances_are_delayed_like_the_other_senses():
    near = Pose(PARAMS.width_mm - RADIUS_MM - 30.0, 1500.0, 0.0)
    arena = Arena(Layout((), (), Pose(2000.0, 1500.0, 0.0)), PARAMS, kind=kind_from({"senses_ticks": 1}))
    arena.begin(1)
    arena.body.sense(0)
    for edit in (Edit("lift"), Edit("put", at=near[:2], heading=1000 * near.heading_rad)):
        arena.edit(edit)

    told = [(arena.body.sense(tick).feel != 0, arena.ranges(0, tick).front) for tick in (1, 2)]

    assert told == [(False, None), (True, 30)]


"""How far a cone's outline is outside its arc in the middle of the cone."""
REACH_MM = PARAMS.body_radius_mm + PARAMS.sensor_reach_mm


def sensed_peg(bearing_deg: float, gap_mm: float) -> Bar:
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
def test_obstacle_between_two_cones_sets_both_bits(bits: int, bearing_deg: float) -> None:
    assert feel(sensed_peg(bearing_deg, 30.0)) == bits


def test_cones_leave_no_gap_for_a_needle_from_minus_112_to_plus_112_degrees() -> None:
    bearings = [quarter / 4 for quarter in range(-449, 450)]

    missed = [bearing for bearing in bearings if not needle_feel(bearing)]

    assert not missed


@pytest.mark.parametrize("bearing_deg", [-112.6, 112.6])
def test_needle_just_outside_the_cones_is_not_felt(bearing_deg: float) -> None:
    assert not needle_feel(bearing_deg)


@pytest.mark.parametrize("bearing_deg", [*range(-110, 111, 7), -112.4, 22.5, 112.4])
def test_cones_reach_60_mm_within_1_mm(bearing_deg: float) -> None:
    assert feel(sensed_peg(bearing_deg, 59.0))
    assert not feel(sensed_peg(bearing_deg, 61.0))


def test_outline_of_a_cone_ends_at_its_reach() -> None:
    outline = cone_outline(CONE_BEARINGS_DEG[1], REACH_MM)

    assert outline[0] == (0.0, 0.0)
    assert [math.hypot(x, y) for x, y in outline[1:]] == pytest.approx([REACH_MM] * 5, abs=0.4)


def test_bit_stays_set_until_both_obstacles_have_left_the_cone() -> None:
    near, far = sensed_peg(0, 20.0), sensed_peg(0, 50.0)
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


def test_cones_in_c_equal_those_that_are_drawn():
    cones = cones_in_c(*world_library(), PARAMS)

    for n, (bit, bearing_deg) in enumerate(CONE_BEARINGS_DEG.items()):
        corners = [(corner.x, corner.y) for corner in cones.of[n].corners]
        assert corners == cone_outline(bearing_deg, cone_reach_mm(bit, PARAMS))
