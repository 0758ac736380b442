"""Each behaviour decides as its oracle does, in random situations, and not as another's."""

import itertools
import random
from collections import Counter

import pytest

from host_sim.protocol.generated import MEMORY_KINDS, PROFILES
from tests.firmware.many_brains import default_config
from tests.firmware.memory.memories import MEMORIES, random_memory
from tests.firmware.octet_c import load
from tests.firmware.oracle_robots import Reading, SensingRobot, oracle_of, repeat_count_during
from tests.firmware.oracles.listing import Listing

FFI, C = load()

DECISIONS = 1_000_000
"""By which another behaviour's oracle must have been found to differ."""


@pytest.fixture(params=PROFILES)
def profile(request: pytest.FixtureRequest) -> str:
    return request.param


def random_reading(dice: random.Random) -> Reading:
    beacon_mm = dice.choice([0, 1, 149, 150, 151, 8191, dice.randrange(300)])
    range_mm = tuple(dice.choices([*range(62), 255], k=5))
    return Reading(dice.randrange(32), dice.random() < 0.5, beacon_mm, range_mm)


def random_state(oracle: type[Listing], dice: random.Random) -> dict[str, int]:
    """What a behaviour may have in mind beside its memory when a decision begins."""
    ranges = {
        "used": range(0, 256, 2),
        "unlearned": range(0, 256, 2),
        "since_mm": range(0, 1013, 4),
        "misses": range(3),
        "chasing": range(2),
        "ate": range(2),
    }
    return {name: dice.choice(ranges[name]) for name in oracle.STATE}


def decide_side_by_side(profile: str, oracle: type[Listing], decisions: int) -> Counter[str]:
    """Lets the C and an oracle decide by the same readings and draws; returns how often each action was seen."""
    dice, seen = random.Random(1), Counter()
    brain, config, senses = FFI.new("struct brain *"), default_config(), FFI.new("struct senses *")
    cells, robot = FFI.buffer(brain.memory.cell), SensingRobot()
    names = {getattr(C, name): name for name in dir(C) if name.startswith("REASON_")}
    for i in range(decisions):
        if i % 40 == 0:
            # Given a brain and the oracle with the same memory, repeat count and generator
            assert C.brain_start(brain, PROFILES[profile], i)
            cells[:] = random_memory(MEMORY_KINDS[profile], dice)
            brain.repeat_count = dice.choice([0, 8, dice.randrange(256)])
            brain.frozen = dice.random() < 0.1
            robot.dice.state = brain.random.state
            listing = oracle(robot, bytearray(cells), brain.repeat_count, brain.frozen)
            for name, value in random_state(oracle, dice).items():
                setattr(brain, name, value)
                setattr(listing, name, value)
            search = listing.search()
        # When both sense the same
        robot.reading, robot.readings = random_reading(dice), 0
        senses.feel, senses.look, senses.beacon_mm, senses.range_mm = robot.reading
        senses.odometer_left = senses.tick = i & 255  # of no concern to the brain
        expected, action = next(search), C.brain_next(brain, config, senses)
        # Then both do the same, and know the same
        done = (names[action.reason], action.turn_deg, action.forward_mm, action.until_food)
        assert done == ("REASON_" + expected[0], *expected[1:])
        assert cells[:] == listing.mem
        assert brain.repeat_count == repeat_count_during(expected, listing)
        for name in oracle.STATE:
            assert getattr(brain, name) == getattr(listing, name), name
        seen[expected.why] += 1
    return seen


def test_random_decisions_are_those_of_the_oracle(profile, request):
    decisions = request.config.getoption("decisions")
    seen = decide_side_by_side(profile, oracle_of(profile), decisions)
    # And they held enough of everything that it does
    assert {"WANDER", "TOWARD_FOOD", "LOOK_AROUND", "TRIAL", "EAT"} <= set(seen)
    assert min(seen.values()) > decisions / 1000, seen


@pytest.mark.parametrize(("profile", "other"), list(itertools.permutations(PROFILES, 2)))
def test_the_oracle_of_another_behaviour_is_found_to_differ(profile, other):
    with pytest.raises(AssertionError):
        decide_side_by_side(profile, oracle_of(other), DECISIONS)


def test_a_run_begins_with_the_memory_that_the_oracle_says(profile):
    brain = FFI.new("struct brain *")
    for before in MEMORIES[MEMORY_KINDS[profile]]:
        FFI.buffer(brain.memory.cell)[:] = bytes(before)
        brain.changed = False
        assert C.brain_start(brain, PROFILES[profile], 1)
        assert FFI.buffer(brain.memory.cell)[:] == oracle_of(profile).begin(bytes(before))
        assert brain.changed or FFI.buffer(brain.memory.cell)[:] == bytes(before)
