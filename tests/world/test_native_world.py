"""The arena in C against the readable one: senses, poses and food, bit for bit."""

import random

import pytest

from host_sim.protocol.generated import TICK_SPAN
from host_sim.world.arena import Arena
from host_sim.world.edits import AddBar, Edit, EditError, Lift, MoveBar, MoveFood, Put, RemoveBar, make_edit
from host_sim.world.geometry import Bar, Point, Pose
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams
from tests.world.native_c import CArena

PARAMS = SimParams()
TICKS = 2500


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


class Pair:
    """One arena in Python and an equal one in C."""

    def __init__(self, seed: int, robots: int) -> None:
        layout = generate(seed, 1, PARAMS, robots)
        self.python, self.arena = Arena(layout, PARAMS), Arena(layout, PARAMS)
        self.c = CArena(self.arena, PARAMS)
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
        """Makes the same change in both, if it can be made."""
        self.c.native.give_back()
        self.compare()
        edit = random_edit(self.draws, len(self.python.bodies))
        assert refusal(self.arena, edit) == refusal(self.python, edit)
        self.c.native.borrow()

    def compare(self) -> None:
        """The whole state, while the arena is given back."""
        assert [body.state for body in self.arena.bodies] == [body.state for body in self.python.bodies]
        assert self.arena.food.eaten == self.python.food.eaten

    def close(self) -> None:
        self.c.native.give_back()
        self.compare()


@pytest.mark.parametrize(("seed", "robots"), [(1, 1), (2, 1), (3, 2), (4, 5)])
def test_bumping_bodies_sense_and_move_alike(seed, robots):
    pair = Pair(seed, robots)

    for tick in range(TICKS // robots):
        pair.tick(tick)

    pair.close()
    assert any(body.collisions > 3 for body in pair.python.bodies), "hardly anything was touched"


@pytest.mark.parametrize(("seed", "robots"), [(5, 1), (6, 3)])
def test_they_do_so_whatever_a_person_changes_between_the_ticks(seed, robots):
    pair = Pair(seed, robots)

    for tick in range(TICKS // robots):
        if tick % 7 == 0:
            pair.edit()
        pair.tick(tick)

    pair.close()


def test_after_it_is_given_back_an_arena_goes_on_in_python():
    pair = Pair(7, 1)
    for tick in range(300):
        pair.tick(tick)
    pair.close()

    for tick in range(300):
        wheels = drive(pair.draws)
        for arena in (pair.python, pair.arena):
            arena.body.sense(tick)
            arena.body.move(*wheels)
        pair.compare()
