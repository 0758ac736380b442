"""A person moves the potted plant."""

import math

import pytest

from host_sim.world.arena import Arena
from host_sim.world.edits import (
    PLANTS_MAX,
    AddBar,
    AddPlant,
    ChangeBody,
    Edit,
    EditError,
    GrowPlant,
    Lift,
    MoveBar,
    MoveFood,
    MovePlant,
    Put,
    RemoveBar,
    RemovePlant,
    make_edit,
)
from host_sim.world.geometry import Bar, Plant, Pose
from host_sim.world.layouts import Layout
from host_sim.world.params import SimParams
from host_sim.world.written_world import BARS_MAX

PARAMS = SimParams()
FAR = Bar((500.0, 500.0), (900.0, 500.0))
AHEAD = Bar((2140.0, 1300.0), (2140.0, 1700.0))
FRONT = 4


@pytest.fixture
def arena() -> Arena:
    """The robot in the middle, looking to the right; one bar far away, food ahead."""
    start = Pose(2000.0, 1500.0, 0.0)
    return Arena(Layout((FAR,), ((2500.0, 1500.0), (600.0, 2500.0)), start), PARAMS)


def feel(arena: Arena) -> int:
    return arena.body.sense(0).feel


def edit(arena: Arena, *edits: Edit) -> None:
    for one in edits:
        make_edit(arena, one, PARAMS)


def eat(arena: Arena) -> bool:
    """Eats what is seen."""
    arena.body.sense(0)
    return arena.body.eat()


def test_a_bar_put_before_the_robot_is_felt_at_once(arena):
    assert feel(arena) == 0
    edit(arena, MoveBar(0, AHEAD))
    assert feel(arena) & FRONT
    assert arena.obstacles.bars[0] == AHEAD


def test_a_bar_taken_away_is_felt_no_more(arena):
    edit(arena, AddBar(AHEAD), RemoveBar(1))
    assert feel(arena) == 0
    assert list(arena.obstacles.bars) == [0]


def test_an_id_is_never_used_again(arena):
    edit(arena, AddBar(AHEAD), RemoveBar(1), AddBar(AHEAD))
    assert list(arena.obstacles.bars) == [0, 2]


def test_a_bar_hides_the_food_behind_it(arena):
    assert arena.body.sense(0).look
    edit(arena, AddBar(AHEAD))
    assert not arena.body.sense(0).look


def test_moved_food_is_seen_where_it_lies(arena):
    edit(arena, MoveFood(0, (2300.0, 1500.0)))
    assert arena.body.sense(0).beacon_mm == 300


def test_eaten_food_stays_eaten_wherever_it_is_moved(arena):
    edit(arena, MoveFood(0, (2120.0, 1500.0)))
    assert eat(arena)
    edit(arena, MoveFood(0, (2300.0, 1500.0)))
    assert not arena.body.sense(0).look
    assert arena.food.eaten == [True, False]


def test_two_pieces_of_food_at_one_place_are_eaten_one_by_one(arena):
    edit(arena, MoveFood(0, (2120.0, 1500.0)), MoveFood(1, (2120.0, 1500.0)))
    assert eat(arena)
    assert len(arena.food.uneaten) == 1
    assert eat(arena)
    assert len(arena.food.uneaten) == 0


def test_a_lifted_robot_senses_nothing_and_goes_nowhere_but_its_wheels_turn(arena):
    edit(arena, MoveBar(0, AHEAD), Lift())
    pose, odometer = arena.body.pose, arena.body.odometer
    arena.body.move(200, 200)
    senses = arena.body.sense(0)
    assert (senses.feel, senses.look, senses.bump) == (0, False, False)
    assert arena.body.pose == pose
    assert arena.body.odometer > odometer


def test_a_robot_put_down_is_where_it_was_put(arena):
    edit(arena, Lift(), Put(Pose(600.0, 1500.0, 1.0)))
    assert arena.body.pose == (600.0, 1500.0, 1.0)
    arena.body.move(200, 200)
    assert arena.body.pose.x_mm == pytest.approx(600 + 4 * math.cos(1.0))


def test_a_robot_put_down_before_a_wall_feels_it(arena):
    edit(arena, Lift(), Put(Pose(3880.0, 1500.0, 0.0)))
    assert feel(arena) & FRONT


@pytest.mark.parametrize(
    "impossible",
    [
        MoveBar(0, Bar((1900.0, 1500.0), (2100.0, 1500.0))),
        AddBar(Bar((2105.0, 1400.0), (2105.0, 1600.0))),
        AddBar(Bar((10.0, 10.0), (10.0, 20.0))),
        AddBar(Bar((10.0, 10.0), (4001.0, 10.0))),
        MoveBar(1, FAR),
        RemoveBar(7),
        MoveFood(2, (10.0, 10.0)),
        MoveFood(0, (10.0, 3001.0)),
        Put(Pose(600.0, 1500.0, 0.0)),
        AddPlant(Plant((2150.0, 1500.0), 80.0)),
        AddPlant(Plant((600.0, 1500.0), 10.0)),
        AddPlant(Plant((600.0, 1500.0), 501.0)),
        AddPlant(Plant((4100.0, 1500.0), 80.0)),
        GrowPlant(0, 80.0),
        MovePlant(0, (600.0, 1500.0)),
        RemovePlant(0),
        ChangeBody("explode"),
        ChangeBody("mirror", 1),
    ],
)
def test_what_cannot_be_changes_nothing(arena, impossible):
    before = arena.layout, arena.body.pose, arena.body.sense(0)
    with pytest.raises(EditError):
        edit(arena, impossible)
    assert (arena.layout, arena.body.pose, arena.body.sense(0)) == before


def test_a_lifted_robot_is_not_lifted_twice(arena):
    edit(arena, Lift())
    with pytest.raises(EditError, match="already"):
        edit(arena, Lift())


@pytest.mark.parametrize("place", [(700.0, 500.0), (50.0, 1500.0)])
def test_there_is_no_room_for_the_robot_in_a_bar_or_a_wall(arena, place):
    edit(arena, Lift())
    with pytest.raises(EditError, match="no room"):
        edit(arena, Put(Pose(*place, 0.0)))
    assert arena.body.lifted


def test_a_plant_can_grow_and_be_taken_away(arena):
    edit(arena, AddPlant(Plant((2250.0, 1500.0), 80.0)))
    assert feel(arena) == 0
    edit(arena, GrowPlant(0, 100.0))
    assert feel(arena) == FRONT
    edit(arena, RemovePlant(0))
    assert feel(arena) == 0


def test_a_plant_can_be_moved_but_not_onto_the_robot(arena):
    edit(arena, AddPlant(Plant((600.0, 1500.0), 80.0)))
    edit(arena, MovePlant(0, (2235.0, 1500.0)))
    assert feel(arena) == FRONT
    with pytest.raises(EditError, match="the robot stands there"):
        edit(arena, MovePlant(0, (2150.0, 1500.0)))
    assert arena.obstacles.plants[0].at == (2235.0, 1500.0)


def test_a_plant_does_not_grow_into_the_robot(arena):
    edit(arena, AddPlant(Plant((2230.0, 1500.0), 80.0)))
    with pytest.raises(EditError, match="the robot stands there"):
        edit(arena, GrowPlant(0, 131.0))
    edit(arena, GrowPlant(0, 129.0))


def test_there_is_no_room_for_the_robot_in_a_plant(arena):
    edit(arena, Lift(), AddPlant(Plant((600.0, 1500.0), 80.0)))
    with pytest.raises(EditError, match="no room"):
        edit(arena, Put(Pose(600.0, 1679.0, 0.0)))
    edit(arena, Put(Pose(600.0, 1681.0, 0.0)))


def test_there_are_not_more_plants_than_fit(arena):
    edit(arena, *[AddPlant(Plant((600.0, 1500.0), 80.0))] * PLANTS_MAX)
    with pytest.raises(EditError, match="already"):
        edit(arena, AddPlant(Plant((600.0, 1500.0), 80.0)))


def test_the_arena_does_not_fill_up_for_ever(arena):
    edit(arena, *[AddBar(FAR)] * (BARS_MAX - 1))
    with pytest.raises(EditError, match="already"):
        edit(arena, AddBar(FAR))
