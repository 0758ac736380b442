"""What changes do to an arena."""

import math

import pytest

from host_sim.world.arena import Arena
from host_sim.world.change_effects import edits_of
from host_sim.world.changes import Change
from host_sim.world.edits import AddPlant, ChangeBody, EditError, GrowPlant
from host_sim.world.geometry import Bar, Plant, Pose
from host_sim.world.layouts import Layout, generate
from host_sim.world.params import SimParams
from host_sim.world.reach import Reach

PARAMS = SimParams()


def happen(arena: Arena, text: str, seed: int = 1) -> list:
    edits = edits_of(Change.parse(text), arena, PARAMS, seed)
    for edit in edits:
        arena.edit(edit)
    return edits


@pytest.mark.parametrize("seed", range(12))
def test_a_plant_is_put_where_it_leaves_a_way_to_all_food(seed):
    layout = generate(seed, 1, PARAMS, robots=2)
    arena = Arena(layout, PARAMS)

    happen(arena, "plant@1s", seed)
    happen(arena, "plant@1s", seed)

    plants = tuple(arena.obstacles.plants.values())
    reach = Reach(layout.bars, layout.start[:2], PARAMS, plants)
    assert len(set(plants)) == 2
    assert all(food in reach for food in layout.food)
    for plant in plants:
        near = (*layout.food, *(start[:2] for start in layout.starts))
        assert min(math.dist(plant.at, place) for place in near) >= plant.radius_mm + 160


def test_the_place_of_a_plant_follows_from_the_seed():
    places = {happen(Arena(generate(1, 1, PARAMS), PARAMS), "plant@1s", seed)[0].plant.at for seed in (1, 1, 2)}

    assert len(places) == 2


def test_a_plant_can_be_put_at_a_place():
    edits = happen(Arena(generate(1, 1, PARAMS), PARAMS), "plant:2000,1500@1s")

    assert edits == [AddPlant(Plant((2000.0, 1500.0), 80.0))]


def test_where_every_plant_would_be_in_the_way_there_is_no_room():
    narrow = SimParams(width_mm=600.0, height_mm=600.0)
    arena = Arena(Layout((), ((400.0, 300.0),), Pose(200.0, 300.0, 0.0)), narrow)

    with pytest.raises(EditError, match="no room for a plant"):
        edits_of(Change.parse("plant@1s"), arena, narrow, 1)


def test_a_plant_beside_a_robot_that_touches_a_wall_leaves_it_a_way():
    arena = Arena(Layout((), ((3000.0, 1500.0),), Pose(100.0, 1500.0, 0.0)), PARAMS)

    assert happen(arena, "plant@1s")


def test_all_plants_grow():
    arena = Arena(generate(1, 1, PARAMS), PARAMS)
    happen(arena, "plant@1s")
    happen(arena, "plant@1s")

    grown = happen(arena, "grow@2s")
    more = happen(arena, "grow:7@2s")

    assert [type(edit) for edit in grown] == [GrowPlant] * 2
    assert [edit.radius_mm for edit in (*grown, *more)] == [120.0] * 2 + [127.0] * 2


def test_where_there_is_no_plant_none_grows():
    with pytest.raises(EditError, match="no plant"):
        happen(Arena(generate(1, 1, PARAMS), PARAMS), "grow@2s")


def test_what_happens_to_bodies_happens_to_all_or_to_the_one_named():
    arena = Arena(generate(1, 1, PARAMS, robots=3), PARAMS)

    assert happen(arena, "mirror@1s", seed=7) == [ChangeBody("mirror", robot, 7) for robot in range(3)]
    assert happen(arena, "mirror@1s/2", seed=7) == [ChangeBody("mirror", 1, 7)]
    assert [body.faults.mirrored for body in arena.bodies] == [True, False, True]


def test_a_plant_is_an_obstacle_like_any_other():
    arena = Arena(Layout((Bar((9.0, 9.0), (99.0, 99.0)),), ((2500.0, 1500.0),), Pose(2000.0, 1500.0, 0.0)), PARAMS)
    assert arena.body.sense(0).look

    arena.edit(AddPlant(Plant((2230.0, 1500.0), 80.0)))

    assert arena.body.sense(0).feel == 4
    assert not arena.body.sense(0).look
    assert arena.ranges(0).front == 50
    for _ in range(40):
        arena.body.move(200, 200)
    assert arena.body.pose.x_mm == pytest.approx(2050, abs=0.1)
    assert arena.body.sense(0).bump
