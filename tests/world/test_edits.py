"""A person moves the potted plant: what bodies notice of it. native/test_native_edits.c beside this has the rules.

Kinds of memories, and how those of one become those of another.

Crates: what robots push moves, as heavy and as rough as it is; all else holds.
"""

import math

import pytest

from host_sim.protocol.generated import CELL_COUNT, REST, Drive, MemoryKind, Side
from host_sim.world.arena import Arena
from host_sim.world.crates import Crates
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import Bar, Plant, Pose, SimParams
from host_sim.world.layouts import CrateKind, Layout
from host_sim.world.memory_kinds import kinds_of, sides_of, translated, with_sides
from host_sim.world.names import PHYSICS
from host_sim.world.worlds import world_of

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


def test_bar_moved_ahead_of_the_robot_is_felt_until_it_is_removed(arena):
    assert feel(arena) == 0
    edit(arena, Edit("move_bar", 0, **AHEAD._asdict()))
    assert feel(arena) & FRONT
    assert arena.obstacles.bars == {0: AHEAD}
    edit(arena, Edit("add_bar", **FAR._asdict()), Edit("remove_bar", 0))
    assert feel(arena) == 0
    assert arena.obstacles.bars == {1: FAR}


def test_bar_hides_the_food_behind_it(arena):
    assert arena.body.sense(0).look
    edit(arena, Edit("add_bar", **AHEAD._asdict()))
    assert not arena.body.sense(0).look


def test_moved_food_is_seen_where_it_lies_unless_it_is_eaten(arena):
    edit(arena, Edit("move_food", 0, at=(2120.0, 1500.0)))
    assert arena.body.sense(0).beacon_mm == 120
    assert arena.body.eat()
    edit(arena, Edit("move_food", 0, at=(2300.0, 1500.0)))
    assert not arena.body.sense(0).look
    assert arena.food.eaten == [True, False]


def test_food_pieces_at_one_place_are_eaten_one_by_one(arena):
    edit(arena, Edit("move_food", 0, at=(2120.0, 1500.0)), Edit("move_food", 1, at=(2120.0, 1500.0)))
    for left in (1, 0):
        arena.body.sense(0)
        assert arena.body.eat()
        assert len(arena.food.uneaten) == left


def test_lifted_robot_senses_nothing_and_its_wheels_turn_without_moving_it(arena):
    edit(arena, Edit("move_bar", 0, **AHEAD._asdict()), Edit("lift"))
    pose, odometer = arena.body.pose, arena.body.odometer
    arena.body.move(200, 200)
    senses = arena.body.sense(0)
    assert (senses.feel, senses.look, senses.bump) == (0, False, False)
    assert arena.body.pose == pose
    assert arena.body.odometer > odometer


def test_robot_put_down_is_where_it_was_put(arena):
    edit(arena, Edit("lift"), Edit("put", at=(600.0, 1500.0), heading=1000))
    assert arena.body.pose == (600.0, 1500.0, 1.0)
    arena.body.move(200, 200)
    assert arena.body.pose.x_mm == pytest.approx(600 + 4 * math.cos(1.0))


def test_robot_put_down_before_a_wall_feels_it(arena):
    edit(arena, Edit("lift"), Edit("put", at=(3880.0, 1500.0), heading=0))
    assert feel(arena) & FRONT


def test_plant_can_be_moved_grown_and_removed(arena):
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
def test_impossible_edit_changes_nothing_and_gives_a_reason(arena, impossible, why):
    before = arena.layout, arena.body.pose, arena.body.sense(0)
    with pytest.raises(EditError, match=why):
        edit(arena, impossible)
    assert (arena.layout, arena.body.pose, arena.body.sense(0)) == before


EMPTY = (0,) * CELL_COUNT
SIDES = (0, 1, 2, 0, 0, 0, 2, 1)


@pytest.mark.parametrize(
    ("memory", "kinds"),
    [
        (EMPTY, list(MemoryKind)),
        ((0, 1, 2, 0, 0, 0, 0, 0), [MemoryKind.SIDES]),
        ((0, 5, 0, 0, 14, 0, 0, 0), [MemoryKind.CONFIDENCE]),
        ((0, 3, 0, 0, 0, 0, 0, 0), []),
        ((1, 0, 0, 0, 0, 0, 0, 0), []),
        ((15, 3, 0, 0, 0, 0, 0, 0), []),
        ((0,) * 7, []),
    ],
)
def test_memory_is_of_the_kinds_that_its_bytes_allow(memory, kinds):
    assert kinds_of(memory) == kinds


@pytest.mark.parametrize("kind", MemoryKind)
def test_memory_translated_to_another_kind_keeps_its_turns(kind):
    memory = translated(SIDES, kind)

    assert kind in kinds_of(memory)
    assert sides_of(memory) == SIDES
    assert translated(memory, kind) == memory


@pytest.mark.parametrize("kind", MemoryKind)
def test_erased_turn_leaves_an_empty_cell(kind):
    memory = with_sides(translated(SIDES, kind), kind, [(1, 0)])

    assert sides_of(memory) == (0, 0, *SIDES[2:])


def test_evenly_disagreeing_readings_of_a_pattern_are_no_turn():
    memories = (with_sides(EMPTY, MemoryKind.ALL_SENSORS, [(1, side)]) for side in (1, 2))
    left, right = (int.from_bytes(bytes(memory), "little") for memory in memories)
    half = (1 << 12) - 1  # pattern 1 is at readings 2, 3, 18 and 19, two bits each

    mixed = tuple((left & half | right & ~half).to_bytes(CELL_COUNT, "little"))

    assert kinds_of(mixed) == [MemoryKind.ALL_SENSORS]
    assert sides_of(mixed)[1] == 0


@pytest.mark.parametrize("kind", MemoryKind)
def test_written_turn_is_the_one_that_is_shown(kind):
    for pattern in range(1, 8):
        for side in Side:
            written = with_sides(EMPTY, kind, [(pattern, side)])
            assert kind in kinds_of(written)
            assert sides_of(written) == tuple(side if cell == pattern else 0 for cell in range(8))


WORLD = world_of("crates")
KIND = CrateKind(kg_per_m2=15.0, friction=0.3)
CRATE_AHEAD = Bar((1000.0, 900.0), (1000.0, 1100.0))
START = Pose(700.0, 1000.0, 0.0)
SPEED_MM_S, TICKS = 200, 150


def drive(left_mm_s: int, right_mm_s: int) -> Drive:
    return REST._replace(left_mm_s=left_mm_s, right_mm_s=right_mm_s)


FORWARD = drive(SPEED_MM_S, SPEED_MM_S)


def arena_with(*bars: Bar, start: Pose = START) -> Arena:
    """A robot that looks to the right, at crates."""
    return Arena(Layout(bars, ((3000.0, 2500.0),), start), WORLD.params)


def run(arena: Arena, crates: Crates, wanted: Drive = FORWARD, ticks: int = TICKS) -> list[Edit]:
    """Lets the robot drive; the pushes."""
    pushes = []
    for _ in range(ticks):
        arena.body.move(wanted.left_mm_s, wanted.right_mm_s)
        for push in crates.push([wanted]):
            arena.edit(push)
            pushes.append(push)
    return pushes


def way_mm(kind: CrateKind, bar: Bar = CRATE_AHEAD) -> float:
    """How far a robot pushes a crate."""
    arena = arena_with(bar)
    run(arena, Crates(arena, kind))
    return arena.obstacles.bars[0].a[0] - bar.a[0]


def test_robot_pushes_a_crate_ahead_of_it():
    arena = arena_with(CRATE_AHEAD)
    pushes = run(arena, Crates(arena, KIND))

    (a, b) = arena.obstacles.bars[0]
    assert a[0] > 1300.0
    assert (a[0], a[1], b[1]) == (b[0], 900.0, 1100.0)
    assert {push.do for push in pushes} == {"push_bar"}
    assert all(number == int(number) for push in pushes for number in (*push.a, *push.b))
    assert arena.body.pose.x_mm + 100.0 + 40.0 == pytest.approx(a[0], abs=5.0)


def test_untouched_crates_do_not_move():
    arena = arena_with(CRATE_AHEAD)

    assert run(arena, Crates(arena, KIND), ticks=30) == []
    assert arena.obstacles.bars == {0: CRATE_AHEAD}


def test_heavy_and_rough_crates_are_slow():
    assert way_mm(KIND) > way_mm(CrateKind(60.0, 0.3)) > 0.0
    assert way_mm(KIND) > way_mm(CrateKind(15.0, 1.0)) > 0.0
    assert way_mm(CrateKind(200.0, 2.0)) < 20.0


def test_friction_stops_a_crate_and_smooth_crates_glide_farther():
    def glide_mm(friction: float) -> float:
        arena = arena_with(CRATE_AHEAD)
        crates = Crates(arena, CrateKind(15.0, friction))
        run(arena, crates)
        before = arena.obstacles.bars[0].a[0]
        run(arena, crates, REST)
        assert run(arena, crates, REST, ticks=10) == []
        return arena.obstacles.bars[0].a[0] - before

    assert 100.0 > glide_mm(0.1) > glide_mm(0.5) > 0.0


def test_off_centre_push_turns_a_crate():
    arena = arena_with(Bar((1000.0, 950.0), (1000.0, 1250.0)))
    run(arena, Crates(arena, KIND), ticks=100)

    (ax, ay), (bx, by) = arena.obstacles.bars[0]
    assert ax > bx
    assert math.hypot(bx - ax, by - ay) == pytest.approx(300.0, abs=2.0)


def test_walls_and_plants_stop_a_crate():
    wall = arena_with(Bar((3900.0, 900.0), (3900.0, 1100.0)), start=Pose(3600.0, 1000.0, 0.0))
    run(wall, Crates(wall, KIND), ticks=300)
    plant = arena_with(CRATE_AHEAD)
    plant.edit(Edit("plant", at=(1300.0, 1000.0), radius=80.0))
    run(plant, Crates(plant, KIND), ticks=300)

    assert wall.obstacles.bars[0].a[0] <= 3965.0
    assert plant.obstacles.bars[0].a[0] <= 1185.0


def test_pushed_crate_pushes_another_crate():
    behind = Bar((1200.0, 900.0), (1200.0, 1100.0))
    arena = arena_with(CRATE_AHEAD, behind)
    run(arena, Crates(arena, KIND))

    first, second = (arena.obstacles.bars[bar_id].a[0] for bar_id in (0, 1))
    assert second > 1230.0
    assert second - first > 75.0


def test_lifted_robot_pushes_no_crate():
    arena = arena_with(CRATE_AHEAD, start=Pose(860.0, 1000.0, 0.0))
    arena.edit(Edit("lift"))

    assert run(arena, Crates(arena, KIND)) == []


def test_edits_by_hand_reach_the_crates():
    arena = arena_with(CRATE_AHEAD)
    crates = Crates(arena, KIND)
    run(arena, crates, ticks=10)
    arena.edit(Edit("move_bar", 0, a=(1500.0, 900.0), b=(1500.0, 1100.0)))
    arena.edit(Edit("add_bar", a=(2500.0, 500.0), b=(2500.0, 700.0)))

    assert run(arena, crates, ticks=100) == []
    arena.edit(Edit("remove_bar", 0))
    assert run(arena, crates, ticks=300) == []
    assert arena.obstacles.bars == {1: Bar((2500.0, 500.0), (2500.0, 700.0))}


def test_equal_runs_make_equal_pushes():
    def pushes() -> list[Edit]:
        arena = arena_with(*(Bar((x, 900.0), (x, 1100.0)) for x in (1000.0, 1150.0, 1300.0, 1450.0)))
        return run(arena, Crates(arena, KIND), drive(200, 190), ticks=300)

    first = pushes()
    assert first == pushes()
    assert len(first) > 50
