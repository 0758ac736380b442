"""Several robots in one arena: they sense each other, stop at each other, and share the food."""

import math

import pytest

from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.geometry import Bar, Point, Pose, SimParams
from host_sim.world.layouts import Layout, generate

PARAMS = SimParams()
FRONT, LEFT, RIGHT = 4, 16, 1
MIDDLE = 2000.0, 1500.0


def arena_with(*starts: Pose, bars: tuple[Bar, ...] = (), foods: tuple[Point, ...] = ()) -> Arena:
    return Arena(Layout(bars, foods, starts[0], starts[1:]), PARAMS)


def at(x_mm: float, heading_deg: float = 0.0) -> Pose:
    return Pose(MIDDLE[0] + x_mm, MIDDLE[1], math.radians(heading_deg))


def feel(body: Body) -> int:
    return body.sense(0).feel


def apart_mm(arena: Arena) -> float:
    return math.dist(arena.bodies[0].pose[:2], arena.bodies[1].pose[:2])


@pytest.mark.parametrize(("heading_deg", "bit"), [(0, FRONT), (90, LEFT), (-90, RIGHT), (180, 0)])
def test_a_robot_is_felt_where_it_is(heading_deg: float, bit: int) -> None:
    arena = arena_with(at(0.0, heading_deg), at(250.0))

    assert feel(arena.bodies[0]) & (FRONT | LEFT | RIGHT) == bit


def test_neither_steals_the_others_senses() -> None:
    peg = Bar((MIDDLE[0] + 130.0, MIDDLE[1]), (MIDDLE[0] + 130.01, MIDDLE[1]))
    far = Pose(500.0, 500.0, 0.0)

    one, other = arena_with(at(0.0), far, bars=(peg,)).bodies
    swapped = arena_with(far, at(0.0), bars=(peg,)).bodies

    assert (feel(one), feel(other)) == (FRONT, 0)
    assert [feel(body) for body in swapped] == [0, FRONT]


def test_robots_stop_at_each_other_and_both_feel_the_bump() -> None:
    arena = arena_with(at(0.0), at(400.0, 180.0))

    for _ in range(200):
        for body in arena.bodies:
            body.move(200.0, 200.0)

    assert apart_mm(arena) == pytest.approx(2 * PARAMS.body_radius_mm, abs=0.02)
    assert [body.sense(0).bump for body in arena.bodies] == [True, True]
    assert [body.collisions for body in arena.bodies] == [1, 1]


def test_a_robot_that_stands_is_not_pushed() -> None:
    arena = arena_with(at(0.0), at(400.0))

    for _ in range(200):
        arena.bodies[0].move(200.0, 200.0)

    assert arena.bodies[1].pose == at(400.0)


def test_each_looks_for_itself_and_another_robot_hides_food() -> None:
    food = (MIDDLE[0] + 1000.0, MIDDLE[1])
    arena = arena_with(at(0.0), at(500.0), foods=(food,))

    assert [body.sense(0).beacon_mm for body in arena.bodies] == [0, 500]


def test_food_is_eaten_by_one_of_them_only() -> None:
    food = MIDDLE
    arena = arena_with(at(-120.0), at(120.0, 180.0), foods=(food,))
    for body in arena.bodies:
        body.sense(0)

    assert [body.eat() for body in arena.bodies] == [True, False]


def test_a_robot_far_from_all_others_senses_what_it_would_alone() -> None:
    layout = generate(5, 1, PARAMS)
    corner = Pose(PARAMS.width_mm - 150.0, PARAMS.height_mm - 150.0, 0.0)
    alone = Arena(layout, PARAMS)
    together = Arena(Layout(layout.bars, (), layout.start, (corner,)), PARAMS)

    for _ in range(300):
        alone.body.move(180.0, 200.0)
        together.body.move(180.0, 200.0)
        assert together.body.pose == alone.body.pose
        assert feel(together.body) == feel(alone.body)
