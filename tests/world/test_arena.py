"""The body: it rolls as its wheels do, stops at walls, and eats what it sees near by.

Libraries of C code that cannot be used: the run ends with a line that says why.
"""

import math
import random

import pytest

from host_sim.base.errors import OctetError
from host_sim.protocol.generated import Senses
from host_sim.sim import native_loop
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world import world_library
from host_sim.world.arena import Arena
from host_sim.world.geometry import Bar, Point, Pose, SimParams, ahead_of
from host_sim.world.layouts import Layout, generate
from host_sim.world.reach import clearance_mm

PARAMS = SimParams()
MIDDLE = Pose(2000.0, 1500.0, 0.7)
RADIUS = PARAMS.body_radius_mm


def arena_with(start: Pose = MIDDLE, bars: tuple[Bar, ...] = (), foods: tuple[Point, ...] = ()) -> Arena:
    return Arena(Layout(bars, foods, start), PARAMS)


def eat(arena: Arena) -> bool:
    """Eats what is seen."""
    arena.body.sense(0)
    return arena.body.eat()


def drive(arena: Arena, left_mm_s: float, right_mm_s: float, ticks: int) -> None:
    for _ in range(ticks):
        arena.body.move(left_mm_s, right_mm_s)


def ideal(start: Pose, left_mm: float, right_mm: float) -> Pose:
    """The end of the arc, from its radius and the middle that it turns about."""
    turn = (left_mm - right_mm) / PARAMS.wheel_track_mm
    radius = (left_mm + right_mm) / 2 / turn
    x = start.x_mm + radius * (math.sin(start.heading_rad + turn) - math.sin(start.heading_rad))
    y = start.y_mm - radius * (math.cos(start.heading_rad + turn) - math.cos(start.heading_rad))
    return Pose(x, y, math.remainder(start.heading_rad + turn, math.tau))


def assert_near(pose: Pose, wanted: Pose) -> None:
    assert pose == pytest.approx(wanted, abs=1e-6)


def roam(seed: int, ticks: int) -> list[Senses]:
    """Random drives of random length in a random environment, into whatever is there."""
    arena, draws, senses = Arena(generate(seed, 1, PARAMS), PARAMS), random.Random(seed), []
    left = right = 0.0
    for tick in range(ticks):
        if draws.random() < 0.05:
            left, right = draws.uniform(-300, 500), draws.uniform(-300, 500)
        senses.append(arena.body.sense(tick))
        arena.body.eat()
        arena.body.move(left, right)
    return senses


def test_opposite_wheels_turn_in_place() -> None:
    arena = arena_with()

    drive(arena, 251.0, -251.0, 10_000)

    assert arena.body.pose[:2] == MIDDLE[:2]


@pytest.mark.parametrize(("left", "right"), [(200.0, 100.0), (-50.0, 300.0), (500.0, -499.0), (-100.0, -120.0)])
def test_tick_moves_the_body_along_the_arc_of_its_wheels(left: float, right: float) -> None:
    arena = arena_with()

    arena.body.move(left, right)

    assert_near(arena.body.pose, ideal(MIDDLE, left * PARAMS.tick_s, right * PARAMS.tick_s))


def test_path_of_1000_ticks_ends_where_one_long_arc_ends() -> None:
    arena = arena_with()

    drive(arena, 500.0, 400.0, 1000)

    assert_near(arena.body.pose, ideal(MIDDLE, 10_000.0, 8000.0))


def test_odometers_continue_from_the_previous_arena() -> None:
    layout = Layout((), (), MIDDLE)
    before = Arena(layout, PARAMS)
    before.inside.bodies[0].left_mm, before.inside.bodies[0].right_mm = 12.5, -0.3
    arena = Arena(layout, PARAMS, before.bodies)

    senses = arena.body.sense(0)

    assert (senses.odometer_left, senses.odometer_right) == (125, 4093)
    assert arena.body.odometer == (12.5, -0.3)


@pytest.mark.parametrize(
    ("heading_deg", "axis", "stop_mm"),
    [(0, 0, PARAMS.width_mm - RADIUS), (90, 1, PARAMS.height_mm - RADIUS), (180, 0, RADIUS), (-90, 1, RADIUS)],
)
def test_walls_stop_the_robot(heading_deg: float, axis: int, stop_mm: float) -> None:
    arena = arena_with(Pose(2000.0, 1500.0, math.radians(heading_deg)))

    drive(arena, 500.0, 500.0, 1000)

    assert arena.body.pose[axis] == pytest.approx(stop_mm, abs=0.02)
    assert arena.body.sense(0).bump


def test_wall_that_is_hit_and_leant_on_is_one_collision() -> None:
    arena = arena_with(Pose(3800.0, 1500.0, 0.0))

    drive(arena, 200.0, 200.0, 100)

    assert (arena.body.collisions, (arena.body.touches > 0)) == (1, True)


def test_odometers_count_the_slip_of_wheels_that_push_a_wall() -> None:
    arena = arena_with(Pose(3900.0, 1500.0, 0.0))

    drive(arena, 200.0, 200.0, 100)

    assert arena.body.odometer == pytest.approx((400.0, 400.0))
    assert arena.body.pose.x_mm == pytest.approx(3900.0, abs=0.02)


def test_robot_that_meets_a_wall_at_an_angle_slides_along_it() -> None:
    arena = arena_with(Pose(3850.0, 1500.0, math.radians(60)))

    drive(arena, 200.0, 200.0, 100)

    assert arena.body.pose.x_mm == pytest.approx(3900.0, abs=0.02)
    assert arena.body.pose.y_mm == pytest.approx(1500.0 + 400.0 * math.sin(math.radians(60)), abs=0.5)


def test_robot_against_a_wall_can_still_turn() -> None:
    arena = arena_with(Pose(3900.0, 1500.0, 0.0))

    drive(arena, 100.0, -100.0, 10)

    assert_near(arena.body.pose, Pose(3900.0, 1500.0, 0.25))


def test_arena_corner_stops_the_robot_at_both_walls() -> None:
    arena = arena_with(Pose(3503.0, 2500.0, math.radians(45)))

    drive(arena, 500.0, 500.0, 200)

    assert arena.body.pose[:2] == pytest.approx((PARAMS.width_mm - RADIUS, PARAMS.height_mm - RADIUS), abs=0.02)


@pytest.mark.parametrize("opening_deg", [30, 90, 150])
def test_corner_of_two_bars_stops_the_robot(opening_deg: float) -> None:
    # Two bars that meet ahead of the robot like the sides of a funnel.
    start, tip = Pose(1500.0, 1500.0, 0.0), (2200.0, 1500.0)
    sides = [Pose(*tip, math.pi + side * math.radians(opening_deg) / 2) for side in (-1, 1)]
    bars = tuple(Bar(tip, ahead_of(side, 600.0)) for side in sides)
    arena = arena_with(start, bars)

    drive(arena, 430.0, 420.0, 500)

    room = clearance_mm(arena.body.pose[:2], bars, PARAMS)
    assert room == pytest.approx(RADIUS, abs=0.1)
    assert arena.body.pose.x_mm < tip[0]


@pytest.mark.parametrize("seed", range(20))
def test_body_never_enters_an_obstacle(seed: int) -> None:
    layout, draws = generate(seed, 1, PARAMS), random.Random(seed)
    arena, touched = Arena(layout, PARAMS), False
    for _ in range(40):
        left, right = draws.uniform(-100, 500), draws.uniform(-100, 500)
        for _ in range(40):
            arena.body.move(left, right)
            touched = touched or (arena.body.touches > 0)
            assert clearance_mm(arena.body.pose[:2], layout.bars, PARAMS) > RADIUS - 0.02
    assert touched == (arena.body.collisions > 0)


def test_senses_are_correct_before_the_first_move() -> None:
    x, y = ahead_of(MIDDLE, 160.0)
    arena = arena_with(bars=(Bar((x, y), (x + 0.01, y)),), foods=(ahead_of(MIDDLE, -300.0),))

    assert arena.body.sense(3) == Senses(3, 4, False, False, 0, 0, 0)


def test_food_is_eaten_once_and_only_the_piece_that_is_seen() -> None:
    behind, near, aside = ahead_of(MIDDLE, -120.0), ahead_of(MIDDLE, 149.0), ahead_of(MIDDLE, 149.0, 1.0)
    arena = arena_with(foods=(behind, near, aside))

    assert (eat(arena), eat(arena)) == (True, False)

    assert (arena.food.eaten, len(arena.food.uneaten)) == ([False, True, False], 2)
    assert not arena.body.sense(0).look


@pytest.mark.parametrize("seed", range(5))
def test_equal_drives_give_equal_senses_bit_for_bit(seed: int) -> None:
    first = roam(seed, 5000)

    assert roam(seed, 5000) == first
    assert len({senses.feel for senses in first}) > 5
    assert any(senses.bump for senses in first)


WORLD = world_library, world_library.world_library
LOOP = native_loop, native_loop.loaded


@pytest.fixture(params=[WORLD, LOOP], ids=["world", "loop"])
def module(request):
    """A module whose library is loaded anew, in this test and in the next one."""
    module, load = request.param
    load.cache_clear()
    yield module
    load.cache_clear()


def remove_library(module, monkeypatch, folder) -> None:
    monkeypatch.setattr(module, "LIBRARY", folder / module.LIBRARY.name)


def break_library(module, monkeypatch, folder) -> None:
    (folder / module.LIBRARY.name).write_text("no library")
    monkeypatch.setattr(module, "LIBRARY", folder / module.LIBRARY.name)


def change_header(module, monkeypatch, folder) -> None:
    other = folder / module.HEADERS[-1].name
    other.write_text(module.HEADERS[-1].read_text() + "/* newer */\n")
    monkeypatch.setattr(module, "HEADERS", (*module.HEADERS[:-1], other))


BROKEN = {
    remove_library: "is missing",
    break_library: "cannot be loaded",
    change_header: "was built from other sources",
}


@pytest.mark.parametrize(("damage", "reason"), BROKEN.items(), ids=lambda part: getattr(part, "__name__", ""))
def test_unusable_library_ends_the_run_with_one_line_that_says_why(module, tmp_path, monkeypatch, damage, reason):
    damage(module, monkeypatch, tmp_path)

    with pytest.raises(OctetError) as raised, make(RunConfig(environments=1, limit_s=1.0)) as simulation:
        list(simulation.run())

    assert str(raised.value).startswith(f"{module.LIBRARY.name} {reason}")
    assert str(raised.value).endswith("; build it with tools/setup")
    assert "\n" not in str(raised.value)
