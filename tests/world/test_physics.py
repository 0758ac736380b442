"""pymunk, the reference, and plain geometry give the same bytes; what is raised within pymunk's is not lost.

Several robots in one arena: they sense each other, stop at each other, and share the food.
"""

import gc
import math
import random
import weakref
from collections.abc import Iterator
from dataclasses import replace

import pytest

from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import SPACES_MAX
from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import Bar, Point, Pose, SimParams
from host_sim.world.layouts import Layout, generate
from host_sim.world.names import FAST, PHYSICS, PYMUNK
from tests.runs.log_hashes import Recorded, digest_of_log, runs

PARAMS = SimParams()
TICKS = 2500
SEEDS = (", seed 3", ", seed 4")
OTHERS = ("behaviour", "fault", "{", "node", "over a socket pair", "until")


def compared() -> Iterator[Recorded]:
    """Runs in every world, with several robots, with every change, and with edits."""
    for recorded in runs():
        if not recorded.name.startswith(OTHERS) and (
            recorded.name.startswith("change") or recorded.name.endswith(SEEDS)
        ):
            yield recorded


@pytest.mark.parametrize("recorded", [*compared()], ids=lambda recorded: recorded.name)
def test_fast_physics_and_pymunk_give_the_same_bytes(recorded):
    configs = [replace(recorded.config, physics=physics) for physics in (FAST, PYMUNK)]
    fast, reference = (digest_of_log(recorded._replace(config=config)) for config in configs)

    assert fast == reference


def drive(draws: random.Random) -> tuple[int, int]:
    """Mostly straight on, so that the body runs into things, and faster than the wheels can."""
    if draws.random() < 0.8:
        speed = draws.randint(100, 600)
        return speed, speed - draws.randint(0, 40)
    return draws.randint(-600, 600), draws.randint(-600, 600)


def point(draws: random.Random) -> Point:
    return float(draws.randint(0, 4000)), float(draws.randint(0, 3000))


def random_edit(draws: random.Random, robots: int) -> Edit:
    """A change of any kind; many of them cannot be made."""
    a = point(draws)
    bar = Bar(a, (min(4000.0, a[0] + draws.randint(50, 400)), a[1]))
    robot = draws.randrange(robots)
    return draws.choice(
        [
            Edit("add_bar", **bar._asdict()),
            Edit("move_bar", draws.randrange(8), **bar._asdict()),
            Edit("remove_bar", draws.randrange(8)),
            Edit("move_food", draws.randrange(3), at=point(draws)),
            Edit("lift", robot=robot),
            Edit("put", at=point(draws), heading=1000 * draws.uniform(-3.0, 3.0), robot=robot),
        ]
    )


def refusal(arena: Arena, edit: Edit) -> str:
    """Makes a change, or says why not."""
    try:
        arena.edit(edit)
    except EditError as error:
        return str(error)
    return ""


def state(arena: Arena) -> list[tuple[object, ...]]:
    """The bodies' whole state. Of two overlaps that are equally deep, either may have set the normal."""
    return [
        (*body.pose, *body.odometer, there.seen, there.touches, there.collisions, there.depth_mm, *there.overlaps)
        for body, there in zip(arena.bodies, arena.inside.bodies, strict=True)
    ]


@pytest.mark.parametrize(
    ("seed", "robots", "edited"), [(1, 1, 0), (2, 1, 0), (3, 2, 0), (4, 5, 0), (5, 1, 1), (6, 3, 1)]
)
def test_bodies_collide_the_same_way_in_both_physics(seed, robots, edited):
    layout, draws = generate(seed, 1, PARAMS, robots), random.Random(seed)
    arenas = [Arena(layout, PARAMS, physics=physics) for physics in PHYSICS]

    for tick in range(TICKS // robots):
        if edited and tick % 7 == 0:
            edit = random_edit(draws, robots)
            assert len({refusal(arena, edit) for arena in arenas}) == 1
        for index in range(robots):
            wheels = drive(draws)
            assert len({arena.bodies[index].sense(tick) for arena in arenas}) == 1
            assert len({arena.bodies[index].eat() for arena in arenas}) == 1
            for arena in arenas:
                arena.bodies[index].move(*wheels)
        assert state(arenas[0]) == state(arenas[1])

    assert edited or any(body.collisions > 3 for body in arenas[0].bodies), "hardly anything was touched"


@pytest.mark.parametrize("native", [True, False])
def test_ctrl_c_within_a_step_of_pymunk_ends_the_run(native, monkeypatch):
    config = RunConfig(environments=1, limit_s=5.0, physics=PYMUNK)
    with make(config) as simulation:
        simulation.native = native
        simulation.enter(1)
        calls = iter([KeyboardInterrupt])
        step = type(simulation.arena.inside.space._space).step

        def interrupted(self, seconds: float) -> None:
            for failure in calls:
                raise failure
            step(self, seconds)

        monkeypatch.setattr("pymunk.Space.step", interrupted)
        with pytest.raises(KeyboardInterrupt):
            simulation.step(10)


def test_pymunk_spaces_of_finished_environments_are_freed():
    spaces = weakref.WeakSet()
    gc.disable()
    try:
        with make(RunConfig(environments=3 * SPACES_MAX, limit_s=0.1, physics=PYMUNK)) as simulation:
            for _ in simulation.run():
                spaces.add(simulation.arena.inside.space._space)
                assert len(spaces) <= SPACES_MAX + 2
    finally:
        gc.enable()


@pytest.mark.parametrize(
    ("bus", "physics"), [("none", FAST), ("fd", FAST), ("socketcan:vcan0", PYMUNK), ("slcan:/dev/ttyUSB0", PYMUNK)]
)
def test_default_physics_on_a_can_bus_is_pymunk(bus, physics):
    assert RunConfig(bus=bus).chosen_physics == physics
    assert RunConfig(bus=bus, physics=FAST).chosen_physics == FAST


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
def test_robot_is_felt_by_another_in_its_direction(heading_deg: float, bit: int) -> None:
    arena = arena_with(at(0.0, heading_deg), at(250.0))

    assert feel(arena.bodies[0]) & (FRONT | LEFT | RIGHT) == bit


def test_robots_do_not_share_their_senses() -> None:
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


def test_standing_robot_is_not_pushed() -> None:
    arena = arena_with(at(0.0), at(400.0))

    for _ in range(200):
        arena.bodies[0].move(200.0, 200.0)

    assert arena.bodies[1].pose == at(400.0)


def test_robots_see_food_separately_and_hide_it_from_each_other() -> None:
    food = (MIDDLE[0] + 1000.0, MIDDLE[1])
    arena = arena_with(at(0.0), at(500.0), foods=(food,))

    assert [body.sense(0).beacon_mm for body in arena.bodies] == [0, 500]


def test_food_is_eaten_by_one_robot_only() -> None:
    food = MIDDLE
    arena = arena_with(at(-120.0), at(120.0, 180.0), foods=(food,))
    for body in arena.bodies:
        body.sense(0)

    assert [body.eat() for body in arena.bodies] == [True, False]


def test_robot_far_from_all_others_moves_and_feels_as_if_alone() -> None:
    layout = generate(5, 1, PARAMS)
    corner = Pose(PARAMS.width_mm - 150.0, PARAMS.height_mm - 150.0, 0.0)
    alone = Arena(layout, PARAMS)
    together = Arena(Layout(layout.bars, (), layout.start, (corner,)), PARAMS)

    for _ in range(300):
        alone.body.move(180.0, 200.0)
        together.body.move(180.0, 200.0)
        assert together.body.pose == alone.body.pose
        assert feel(together.body) == feel(alone.body)
