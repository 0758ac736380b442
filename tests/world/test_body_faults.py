"""What can be wrong with a body, as a person says it, and what its robot is told then."""

import pytest

from host_sim.protocol.words import BODY_FAULTS
from host_sim.world.arena import Arena
from host_sim.world.body_faults import check_fault
from host_sim.world.layouts import generate
from host_sim.world.params import SimParams


@pytest.fixture
def arena() -> Arena:
    """Nothing is felt, and no food seen."""
    return Arena(generate(1, 1, SimParams()), SimParams())


def test_an_odometer_that_becomes_stuck_stands_still_where_it_is(arena):
    arena.body.move(200, 200)
    arena.body.add_fault("odometer:left:0%")
    arena.body.move(200, 200)

    senses = arena.body.sense(0)

    assert (senses.odometer_left, senses.odometer_right) == (40, 80)


def test_a_stuck_sensor_is_told_and_measures_nothing_but_that(arena):
    arena.body.add_fault("stuck-on:front")

    assert arena.body.sense(0).feel == 4
    assert arena.ranges(0) == (None, None, 0, None, None)


def test_faults_go_on_in_the_next_arena_until_they_are_repaired(arena):
    arena.body.add_fault("stuck-on:front")
    following = Arena(generate(1, 2, SimParams()), SimParams(), arena.bodies)
    assert following.body.sense(0).feel == 4

    following.begin(1)

    assert following.body.sense(0).feel == 0
    assert arena.body.sense(0).feel == 4


def wrong_bits(arena: Arena, ticks: range) -> list[int]:
    return [arena.body.sense(tick).feel for tick in ticks]


def test_noise_makes_each_sensor_wrong_as_often_as_it_says(arena):
    arena.body.add_fault("noise:10/1000", seed=1)

    bits = wrong_bits(arena, range(40_000))

    for sensor in range(5):
        assert sum(wrong >> sensor & 1 for wrong in bits) == pytest.approx(400, abs=80)


def test_noise_of_a_tick_is_the_same_whenever_it_is_asked_for(arena):
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
def test_what_cannot_happen_is_refused_with_what_was_meant(what, meant):
    with pytest.raises(ValueError) as raised:  # noqa: PT011 - the text is compared below
        check_fault(what)

    assert str(raised.value) == meant
