"""Crates: what robots push moves, as heavy and as rough as it is; all else holds."""

import math

import pytest

from host_sim.protocol.generated import REST, Drive
from host_sim.world.arena import Arena
from host_sim.world.crates import Crates
from host_sim.world.edits import Edit
from host_sim.world.geometry import Bar, Pose
from host_sim.world.layouts import CrateKind, Layout
from host_sim.world.worlds import world_of

WORLD = world_of("crates")
KIND = CrateKind(kg_per_m2=15.0, friction=0.3)
AHEAD = Bar((1000.0, 900.0), (1000.0, 1100.0))
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


def way_mm(kind: CrateKind, bar: Bar = AHEAD) -> float:
    """How far a robot pushes a crate."""
    arena = arena_with(bar)
    run(arena, Crates(arena, kind))
    return arena.obstacles.bars[0].a[0] - bar.a[0]


def test_a_robot_pushes_a_crate_before_it():
    arena = arena_with(AHEAD)
    pushes = run(arena, Crates(arena, KIND))

    (a, b) = arena.obstacles.bars[0]
    assert a[0] > 1300.0
    assert (a[0], a[1], b[1]) == (b[0], 900.0, 1100.0)
    assert {push.do for push in pushes} == {"push_bar"}
    assert all(number == int(number) for push in pushes for number in (*push.a, *push.b))
    assert arena.body.pose.x_mm + 100.0 + 40.0 == pytest.approx(a[0], abs=5.0)


def test_nothing_moves_that_nobody_touches():
    arena = arena_with(AHEAD)

    assert run(arena, Crates(arena, KIND), ticks=30) == []
    assert arena.obstacles.bars == {0: AHEAD}


def test_heavy_and_rough_crates_are_slow():
    assert way_mm(KIND) > way_mm(CrateKind(60.0, 0.3)) > 0.0
    assert way_mm(KIND) > way_mm(CrateKind(15.0, 1.0)) > 0.0
    assert way_mm(CrateKind(200.0, 2.0)) < 20.0


def test_friction_stops_a_crate_and_smooth_ones_glide_on():
    def glide_mm(friction: float) -> float:
        arena = arena_with(AHEAD)
        crates = Crates(arena, CrateKind(15.0, friction))
        run(arena, crates)
        before = arena.obstacles.bars[0].a[0]
        run(arena, crates, REST)
        assert run(arena, crates, REST, ticks=10) == []
        return arena.obstacles.bars[0].a[0] - before

    assert 100.0 > glide_mm(0.1) > glide_mm(0.5) > 0.0


def test_a_push_off_the_middle_turns_a_crate():
    arena = arena_with(Bar((1000.0, 950.0), (1000.0, 1250.0)))
    run(arena, Crates(arena, KIND), ticks=100)

    (ax, ay), (bx, by) = arena.obstacles.bars[0]
    assert ax > bx
    assert math.hypot(bx - ax, by - ay) == pytest.approx(300.0, abs=2.0)


def test_a_wall_and_a_plant_hold_a_crate():
    wall = arena_with(Bar((3900.0, 900.0), (3900.0, 1100.0)), start=Pose(3600.0, 1000.0, 0.0))
    run(wall, Crates(wall, KIND), ticks=300)
    plant = arena_with(AHEAD)
    plant.edit(Edit("plant", at=(1300.0, 1000.0), radius=80.0))
    run(plant, Crates(plant, KIND), ticks=300)

    assert wall.obstacles.bars[0].a[0] <= 3965.0
    assert plant.obstacles.bars[0].a[0] <= 1185.0


def test_a_crate_pushes_another():
    behind = Bar((1200.0, 900.0), (1200.0, 1100.0))
    arena = arena_with(AHEAD, behind)
    run(arena, Crates(arena, KIND))

    first, second = (arena.obstacles.bars[bar_id].a[0] for bar_id in (0, 1))
    assert second > 1230.0
    assert second - first > 75.0


def test_a_robot_in_the_air_pushes_nothing():
    arena = arena_with(AHEAD, start=Pose(860.0, 1000.0, 0.0))
    arena.edit(Edit("lift"))

    assert run(arena, Crates(arena, KIND)) == []


def test_what_a_person_changes_is_taken_over():
    arena = arena_with(AHEAD)
    crates = Crates(arena, KIND)
    run(arena, crates, ticks=10)
    arena.edit(Edit("move_bar", 0, a=(1500.0, 900.0), b=(1500.0, 1100.0)))
    arena.edit(Edit("add_bar", a=(2500.0, 500.0), b=(2500.0, 700.0)))

    assert run(arena, crates, ticks=100) == []
    arena.edit(Edit("remove_bar", 0))
    assert run(arena, crates, ticks=300) == []
    assert arena.obstacles.bars == {1: Bar((2500.0, 500.0), (2500.0, 700.0))}


def test_equal_runs_push_equally():
    def pushes() -> list[Edit]:
        arena = arena_with(*(Bar((x, 900.0), (x, 1100.0)) for x in (1000.0, 1150.0, 1300.0, 1450.0)))
        return run(arena, Crates(arena, KIND), drive(200, 190), ticks=300)

    first = pushes()
    assert first == pushes()
    assert len(first) > 50
