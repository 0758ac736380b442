"""Worlds by name: each is fair, drawn from the seed, and as it is said to be."""

import pytest

from host_sim.base.errors import UsageError
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams
from host_sim.world.world_names import WORLD_NAMES
from host_sim.world.worlds import world_of
from tests.world.walk import is_fair

SEEDS = range(15)


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_every_environment_of_every_world_is_fair(name):
    world = world_of(name)

    assert all(is_fair(world.generate(seed, 1), world.params) for seed in SEEDS)


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_a_seed_and_a_number_name_one_environment(name):
    world = world_of(name)

    assert world.generate(3, 2) == world.generate(3, 2)
    assert len({world.generate(seed, number) for seed in (1, 2) for number in (1, 2)}) == 4


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_several_robots_find_room_in_every_world(name):
    assert len(world_of(name).generate(5, 1, robots=3).starts) == 3


def test_the_random_world_is_that_of_generate():
    assert world_of("random").generate(7, 2, 3) == generate(7, 2, SimParams(), 3)


def test_all_bars_are_inside_the_arena():
    for name in WORLD_NAMES:
        world = world_of(name)
        for x, y in (end for seed in SEEDS for bar in world.generate(seed, 1).bars for end in bar):
            assert 0 <= x <= world.params.width_mm
            assert 0 <= y <= world.params.height_mm


@pytest.mark.parametrize(
    ("text", "meant"),
    [("corridor", "did you mean corridors?"), ("moon", "choose from random, corridors"), ("", "choose from")],
)
def test_a_world_that_there_is_not_is_refused_with_what_was_meant(text, meant):
    with pytest.raises(UsageError, match=meant.replace("?", r"\?")):
        world_of(text)
