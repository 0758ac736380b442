"""Changes as a person writes them, what they do to an arena, and what can be wrong with a body."""

import math

import pytest

from host_sim.base.errors import UsageError
from host_sim.protocol.words import BODY_FAULTS
from host_sim.world.arena import Arena
from host_sim.world.body_kinds import check_fault
from host_sim.world.change_effects import edits_of
from host_sim.world.changes import Change, read_changes
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import Bar, Pose, SimParams
from host_sim.world.layouts import Layout, generate
from host_sim.world.reach import Reach


@pytest.mark.parametrize(
    ("text", "change"),
    [
        ("plant@120s", Change("plant", None, 120.0)),
        ("plant:2000,1500@0.5s", Change("plant:2000,1500", None, 0.5)),
        ("grow@env2+20s", Change("grow", 2, 20.0)),
        ("grow:15@env2", Change("grow:15", 2, 0.0)),
        ("swap-motors@env6", Change("swap-motors", 6)),
        ("swap-motors@env6/2", Change("swap-motors", 6, 0.0, 2)),
        ("stuck-on:front-left@7s", Change("stuck-on:front-left", None, 7.0)),
        ("noise:10/1000@env1+3.25s/31", Change("noise:10/1000", 1, 3.25, 31)),
        ("plant@999999.125s", Change("plant", None, 999_999.125)),
        ("weak-motor:left:60%@1s", Change("weak-motor:left:60%", None, 1.0)),
    ],
)
def test_change_is_read_and_written(text, change):
    assert Change.parse(text) == change
    assert str(change) == text


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("plnat@120s", "did you mean plant?"),
        ("swap@env6", "choose from plant, grow, swap-motors"),
        ("swap-motor@env6", "did you mean swap-motors?"),
        ("plant@120", "write NAME@120s, NAME@env6 or NAME@env6+20s"),
        ("plant@", "write NAME@120s"),
        ("@5s", "write NAME@120s"),
        ("plant@environment6", "write NAME@120s"),
        ("plant@-5s", "write NAME@120s"),
        ("plant @5s", "write NAME@120s"),
        ("plant:5@5s", "write plant, or plant:X,Y for a place in mm"),
        ("grow:big@5s", "write grow, or grow:MM for so many mm"),
        ("stuck-on:nose@5s", "write stuck-on:SENSOR"),
        ("plant@5s/2", "only a change of a body can be for one robot"),
        ("mirror@env0", "environments and robots are counted from 1"),
        ("mirror@5s/0", "environments and robots are counted from 1"),
    ],
)
def test_invalid_change_is_refused_with_a_suggestion(text, meant):
    with pytest.raises(UsageError) as raised:
        Change.parse(text)

    assert str(raised.value).startswith(f"{text!r} is not a change: {meant}")


SCHEDULE = """\
# A day in the life of a robot.
plant@120s

  swap-motors@env6   # somebody was at the plugs
"""


@pytest.mark.parametrize("form", ["{}", "@{}"])
def test_changes_file_has_a_change_in_each_line(tmp_path, form):
    path = tmp_path / "changes.txt"
    path.write_text(SCHEDULE)

    assert read_changes(form.format(path)) == ["plant@120s", "swap-motors@env6"]


def test_word_with_an_at_sign_is_a_change():
    assert read_changes("plant@120.0s") == ["plant@120s"]


def test_mistake_in_a_changes_file_is_reported_with_its_line(tmp_path):
    path = tmp_path / "changes.txt"
    path.write_text(SCHEDULE + "grwo@5s\n")

    with pytest.raises(UsageError) as raised:
        read_changes(str(path))

    assert str(raised.value) == f"{path}:5: 'grwo@5s' is not a change: did you mean grow?"


def test_word_that_is_neither_change_nor_file_is_refused():
    with pytest.raises(UsageError, match=r"'plant' is neither a change nor a file .*: write NAME@120s"):
        read_changes("plant")


def test_changes_file_that_is_not_text_is_refused(tmp_path):
    (tmp_path / "changes").write_bytes(b"\xff\xfe")

    with pytest.raises(UsageError, match="is not text"):
        read_changes(str(tmp_path / "changes"))


PARAMS = SimParams()


def happen(arena: Arena, text: str, seed: int = 1) -> list:
    edits = edits_of(Change.parse(text), arena, PARAMS, seed)
    for edit in edits:
        arena.edit(edit)
    return edits


@pytest.mark.parametrize("seed", range(12))
def test_plant_is_put_where_it_leaves_a_way_to_all_food(seed):
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


def test_place_of_a_plant_depends_only_on_the_seed():
    places = {happen(Arena(generate(1, 1, PARAMS), PARAMS), "plant@1s", seed)[0].at for seed in (1, 1, 2)}

    assert len(places) == 2


def test_plant_can_be_put_at_a_given_place():
    edits = happen(Arena(generate(1, 1, PARAMS), PARAMS), "plant:2000,1500@1s")

    assert edits == [Edit("plant", at=(2000.0, 1500.0), radius=80.0)]


def test_plant_is_refused_when_every_place_blocks_the_way():
    narrow = SimParams(width_mm=600.0, height_mm=600.0)
    arena = Arena(Layout((), ((400.0, 300.0),), Pose(200.0, 300.0, 0.0)), narrow)

    with pytest.raises(EditError, match="no room for a plant"):
        edits_of(Change.parse("plant@1s"), arena, narrow, 1)


def test_plant_can_be_put_while_the_robot_touches_a_wall():
    arena = Arena(Layout((), ((3000.0, 1500.0),), Pose(100.0, 1500.0, 0.0)), PARAMS)

    assert happen(arena, "plant@1s")


def test_grow_change_grows_all_plants():
    arena = Arena(generate(1, 1, PARAMS), PARAMS)
    happen(arena, "plant@1s")
    happen(arena, "plant@1s")

    grown = happen(arena, "grow@2s")
    more = happen(arena, "grow:7@2s")

    assert [edit.do for edit in grown] == ["grow_plant"] * 2
    assert [edit.radius for edit in (*grown, *more)] == [120.0] * 2 + [127.0] * 2


def test_growing_without_a_plant_is_refused():
    with pytest.raises(EditError, match="no plant"):
        happen(Arena(generate(1, 1, PARAMS), PARAMS), "grow@2s")


def test_body_change_affects_all_robots_or_the_one_named():
    arena = Arena(generate(1, 1, PARAMS, robots=3), PARAMS)

    assert happen(arena, "mirror@1s", seed=7) == [
        Edit("body", what="mirror", robot=robot, seed=7) for robot in range(3)
    ]
    assert happen(arena, "mirror@1s/2", seed=7) == [Edit("body", what="mirror", robot=1, seed=7)]
    assert [body.faults.mirrored for body in arena.bodies] == [True, False, True]


def test_plant_is_sensed_and_stops_the_robot_like_any_obstacle():
    arena = Arena(Layout((Bar((9.0, 9.0), (99.0, 99.0)),), ((2500.0, 1500.0),), Pose(2000.0, 1500.0, 0.0)), PARAMS)
    assert arena.body.sense(0).look

    arena.edit(Edit("plant", at=(2230.0, 1500.0), radius=80.0))

    assert arena.body.sense(0).feel == 4
    assert not arena.body.sense(0).look
    assert arena.ranges(0).front == 50
    for _ in range(40):
        arena.body.move(200, 200)
    assert arena.body.pose.x_mm == pytest.approx(2050, abs=0.1)
    assert arena.body.sense(0).bump


@pytest.fixture
def arena() -> Arena:
    """Nothing is felt, and no food seen."""
    return Arena(generate(1, 1, SimParams()), SimParams())


def test_faults_continue_in_the_next_arena_until_bodies_begin_anew(arena):
    arena.body.add_fault("stuck-on:front")
    following = Arena(generate(1, 2, SimParams()), SimParams(), arena.bodies)
    assert following.body.sense(0).feel == 4

    following.begin(1)

    assert following.body.sense(0).feel == 0
    assert arena.body.sense(0).feel == 4


def wrong_bits(arena: Arena, ticks: range) -> list[int]:
    return [arena.body.sense(tick).feel for tick in ticks]


def test_noise_makes_each_sensor_wrong_at_its_rate(arena):
    arena.body.add_fault("noise:10/1000", seed=1)

    bits = wrong_bits(arena, range(40_000))

    for sensor in range(5):
        assert sum(wrong >> sensor & 1 for wrong in bits) == pytest.approx(400, abs=80)


def test_noise_of_a_tick_does_not_depend_on_when_it_is_read(arena):
    arena.body.add_fault("noise:1/3", seed=1)

    assert wrong_bits(arena, range(50))[40:] == wrong_bits(arena, range(40, 50))


@pytest.mark.parametrize(
    ("what", "meant"),
    [
        ("mirrored", "did you mean mirror?"),
        ("explode", f"choose from {', '.join(BODY_FAULTS)}"),
        ("mirror:left", "write mirror"),
    ],
)
def test_unknown_change_is_refused_with_the_nearest_name(what, meant):
    with pytest.raises(ValueError) as raised:  # noqa: PT011 - the text is compared below
        check_fault(what)

    assert str(raised.value) == meant
