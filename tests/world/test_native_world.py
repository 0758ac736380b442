"""The arena in C against the readable one: senses, poses and food, bit for bit."""

import random

import pytest

from host_sim.protocol.generated import TICK_SPAN
from host_sim.world.arena import Arena
from host_sim.world.body import Body
from host_sim.world.cones import CONE_BEARINGS_DEG, cone_outline, cone_reach_mm
from host_sim.world.edits import AddBar, Edit, EditError, Lift, MoveBar, MoveFood, Put, RemoveBar, make_edit
from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams
from tests.world.native_c import CArena, load

PARAMS = SimParams()
TICKS = 2500
TOUCH_MM = 0.01


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
            AddBar(bar),
            MoveBar(draws.randrange(8), bar),
            RemoveBar(draws.randrange(8)),
            MoveFood(draws.randrange(3), point(draws)),
            Lift(robot),
            Put(Pose(*point(draws), draws.uniform(-3.0, 3.0)), robot),
        ]
    )


def refusal(arena: Arena, edit: Edit) -> str:
    """Makes a change, or says why not."""
    try:
        make_edit(arena, edit, PARAMS)
    except EditError as error:
        return str(error)
    return ""


def state(body: Body) -> tuple[float, ...]:
    """A body's state. In a corner two overlaps may be equally deep: whichever was found first has set the normal."""
    depth_at, normal_at = 5, slice(6, 8)
    parts = list(body.state)
    if parts[depth_at] <= TOUCH_MM:
        parts[normal_at] = ()
    return tuple(parts)


class Two:
    """One arena in Python and an equal one in C."""

    def __init__(self, seed: int, robots: int) -> None:
        layout = generate(seed, 1, PARAMS, robots)
        self.python = Arena(layout, PARAMS)
        self.c = CArena(Arena(layout, PARAMS), PARAMS)
        self.draws = random.Random(seed)

    def tick(self, tick: int) -> None:
        bodies = self.python.bodies
        told = tick % TICK_SPAN
        senses = [body.sense(told) for body in bodies]
        assert [self.c.sense(i, told) for i in range(len(bodies))] == senses
        for i, body in enumerate(bodies):
            wheels = drive(self.draws)
            if self.draws.random() < 0.5:
                assert self.c.eat(i) == body.eat()
            body.move(*wheels)
            self.c.move(i, *wheels)

    def edit(self) -> None:
        """Makes the same change in all, if it can be made."""
        self.give_back()
        edit = random_edit(self.draws, len(self.python.bodies))
        expected = refusal(self.python, edit)
        assert refusal(self.c.arena, edit) == expected
        self.c.native.borrow()

    def give_back(self) -> None:
        self.c.native.give_back()
        self.compare()

    def compare(self) -> None:
        """The whole state, while the arenas are given back."""
        assert [state(body) for body in self.c.arena.bodies] == [state(body) for body in self.python.bodies]
        assert self.c.arena.food.eaten == self.python.food.eaten


@pytest.mark.parametrize(("seed", "robots"), [(1, 1), (2, 1), (3, 2), (4, 5)])
def test_bumping_bodies_sense_and_move_alike(seed, robots):
    two = Two(seed, robots)

    for tick in range(TICKS // robots):
        two.tick(tick)

    two.give_back()
    assert any(body.collisions > 3 for body in two.python.bodies), "hardly anything was touched"


@pytest.mark.parametrize(("seed", "robots"), [(5, 1), (6, 3)])
def test_they_do_so_whatever_a_person_changes_between_the_ticks(seed, robots):
    two = Two(seed, robots)

    for tick in range(TICKS // robots):
        if tick % 7 == 0:
            two.edit()
        two.tick(tick)

    two.give_back()


def test_after_they_are_given_back_arenas_go_on_in_python():
    two = Two(7, 1)
    for tick in range(300):
        two.tick(tick)
    two.give_back()

    for tick in range(300):
        wheels = drive(two.draws)
        for arena in (two.python, two.c.arena):
            arena.body.sense(tick)
            arena.body.move(*wheels)
        two.compare()


def test_the_cones_of_plain_geometry_are_those_of_the_readable_arena():
    c = CArena(Arena(generate(1, 1, PARAMS), PARAMS), PARAMS)
    cones = c.ffi.cast("struct plain_world *", c.native.world.space).cones

    for n, (bit, bearing_deg) in enumerate(CONE_BEARINGS_DEG.items()):
        corners = [(corner.x, corner.y) for corner in cones.of[n].corners]
        assert corners == cone_outline(bearing_deg, cone_reach_mm(bit, PARAMS))


def test_the_walls_of_plain_geometry_are_those_of_the_readable_arena():
    ffi, library = load()
    walls = ffi.new("struct capsule[]", library.WALLS)
    library.capsule_set_walls(walls, PARAMS.width_mm, PARAMS.height_mm)

    readable = Arena(generate(1, 1, PARAMS), PARAMS).obstacles.walls
    assert [((wall.a.x, wall.a.y), (wall.b.x, wall.b.y), wall.radius_mm) for wall in walls] == readable
