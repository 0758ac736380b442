"""A person moves the potted plant: what bodies notice of it. native/test_native_edits.c beside this has the rules."""

import math

import pytest

from host_sim.world.arena import Arena
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import Bar, Plant, Pose, SimParams
from host_sim.world.layouts import Layout
from host_sim.world.names import PHYSICS

PARAMS = SimParams()
FAR = Bar((500.0, 500.0), (900.0, 500.0))
AHEAD = Bar((2140.0, 1300.0), (2140.0, 1700.0))
FRONT = 4


@pytest.fixture(params=PHYSICS)
def arena(request) -> Arena:
    """The robot in the middle, looking to the right; one bar far away, food ahead."""
    start = Pose(2000.0, 1500.0, 0.0)
    layout = Layout((FAR,), ((2500.0, 1500.0), (600.0, 2500.0)), start)
    return Arena(layout, PARAMS, physics=request.param)


def feel(arena: Arena) -> int:
    return arena.body.sense(0).feel


def edit(arena: Arena, *edits: Edit) -> None:
    for one in edits:
        arena.edit(one)


def test_a_bar_put_before_the_robot_is_felt_at_once_and_no_more_when_it_is_taken_away(arena):
    assert feel(arena) == 0
    edit(arena, Edit("move_bar", 0, **AHEAD._asdict()))
    assert feel(arena) & FRONT
    assert arena.obstacles.bars == {0: AHEAD}
    edit(arena, Edit("add_bar", **FAR._asdict()), Edit("remove_bar", 0))
    assert feel(arena) == 0
    assert arena.obstacles.bars == {1: FAR}


def test_a_bar_hides_the_food_behind_it(arena):
    assert arena.body.sense(0).look
    edit(arena, Edit("add_bar", **AHEAD._asdict()))
    assert not arena.body.sense(0).look


def test_moved_food_is_seen_where_it_lies_and_an_eaten_piece_no_more(arena):
    edit(arena, Edit("move_food", 0, at=(2120.0, 1500.0)))
    assert arena.body.sense(0).beacon_mm == 120
    assert arena.body.eat()
    edit(arena, Edit("move_food", 0, at=(2300.0, 1500.0)))
    assert not arena.body.sense(0).look
    assert arena.food.eaten == [True, False]


def test_two_pieces_of_food_at_one_place_are_eaten_one_by_one(arena):
    edit(arena, Edit("move_food", 0, at=(2120.0, 1500.0)), Edit("move_food", 1, at=(2120.0, 1500.0)))
    for left in (1, 0):
        arena.body.sense(0)
        assert arena.body.eat()
        assert len(arena.food.uneaten) == left


def test_a_lifted_robot_senses_nothing_and_goes_nowhere_but_its_wheels_turn(arena):
    edit(arena, Edit("move_bar", 0, **AHEAD._asdict()), Edit("lift"))
    pose, odometer = arena.body.pose, arena.body.odometer
    arena.body.move(200, 200)
    senses = arena.body.sense(0)
    assert (senses.feel, senses.look, senses.bump) == (0, False, False)
    assert arena.body.pose == pose
    assert arena.body.odometer > odometer


def test_a_robot_put_down_is_where_it_was_put(arena):
    edit(arena, Edit("lift"), Edit("put", at=(600.0, 1500.0), heading=1000))
    assert arena.body.pose == (600.0, 1500.0, 1.0)
    arena.body.move(200, 200)
    assert arena.body.pose.x_mm == pytest.approx(600 + 4 * math.cos(1.0))


def test_a_robot_put_down_before_a_wall_feels_it(arena):
    edit(arena, Edit("lift"), Edit("put", at=(3880.0, 1500.0), heading=0))
    assert feel(arena) & FRONT


def test_a_plant_can_be_moved_grow_and_be_taken_away(arena):
    edit(arena, Edit("plant", at=(2250.0, 2000.0), radius=80.0), Edit("move_plant", 0, at=(2250.0, 1500.0)))
    assert feel(arena) == 0
    edit(arena, Edit("grow_plant", 0, radius=100.0))
    assert feel(arena) == FRONT
    assert arena.obstacles.plants == {0: Plant((2250.0, 1500.0), 100.0)}
    edit(arena, Edit("remove_plant", 0))
    assert feel(arena) == 0


@pytest.mark.parametrize(
    ("impossible", "why"),
    [
        (Edit("move_bar", 0, a=(1900.0, 1500.0), b=(2100.0, 1500.0)), "the robot stands there"),
        (Edit("grow_plant", 0, radius=80.0), "there is no such number"),
        (Edit("body", what="mirror:left"), "write mirror"),
        (Edit("body", what="mirror", robot=1), "there is no such robot"),
        (Edit("body", what="x" * 1000), "there is no such fault"),
    ],
)
def test_what_cannot_be_changes_nothing_and_says_why(arena, impossible, why):
    before = arena.layout, arena.body.pose, arena.body.sense(0)
    with pytest.raises(EditError, match=why):
        edit(arena, impossible)
    assert (arena.layout, arena.body.pose, arena.body.sense(0)) == before
