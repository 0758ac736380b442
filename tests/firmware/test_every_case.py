"""Each behaviour decides as its oracle does in every case there is.

The oracle is asked once for each case that it can tell apart: its memory holds only the cells that it reads, and any
other index is a KeyError. The brain is asked with every whole memory. Where a case has a random outcome, the brain is
given a generator state that yields it.
"""

import itertools
from collections.abc import Sequence

import numpy as np
import pytest

from host_sim.protocol.generated import MEMORY_KINDS, PROFILES, MemoryKind
from tests.firmware.many_brains import ACTION, CELL_VALUES, MEMORIES, Brains, C
from tests.firmware.oracle_robots import Reading, ScriptedRobot, SensingRobot, oracle_of, oracle_says
from tests.firmware.oracles.listing import Action, Listing

PATTERNS = range(8)
REPEAT_COUNTS = range(256)
TELLING_COUNTS = (0, 8, 9, 10, 254, 255)
BY_PATTERN = [profile for profile in PROFILES if MEMORY_KINDS[profile] != MemoryKind.ALL_SENSORS]
LISTING_FORWARD = [profile for profile in BY_PATTERN if oracle_of(profile).go_forward is Listing.go_forward]
"""Profiles that look for food as the listing does."""
REMEMBERING = [
    profile
    for profile in BY_PATTERN
    if oracle_of(profile)(SensingRobot(), {1: CELL_VALUES[MEMORY_KINDS[profile]][1]}).recall(C.FEEL_FRONT_RIGHT)
]
"""Profiles that make use of their memory."""


def table(cases: list[tuple[Action, int]], shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Actions and repeat counts of the oracle as arrays of a shape."""
    actions = np.zeros(len(cases), ACTION)
    actions["reason"] = [getattr(C, "REASON_" + action.why) for action, _ in cases]
    actions["turn_deg"] = [action.turn_deg for action, _ in cases]
    actions["forward_mm"] = [action.forward_mm for action, _ in cases]
    actions["until_food"] = [action.until_food for action, _ in cases]
    return actions.reshape(shape), np.array([count for _, count in cases], np.uint8).reshape(shape)


def cell_cases(profile: str) -> tuple[np.ndarray, Sequence[int]]:
    """All memories of a profile's kind, and what a cell may hold."""
    kind = MEMORY_KINDS[profile]
    return MEMORIES[kind], CELL_VALUES[kind]


def at(values: Sequence[int], cells: np.ndarray) -> np.ndarray:
    """For each cell's content, its place among the values."""
    return np.searchsorted(np.array(values), cells)


@pytest.mark.parametrize("pattern", PATTERNS)
@pytest.mark.parametrize("profile", LISTING_FORWARD)
def test_first_actions_match_the_oracle_for_all_memories(profile, pattern):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    for draw in range(2):
        # Given every memory with every repeat count
        asked = Brains(profile, memories[:, None], np.array(REPEAT_COUNTS))
        reading = Reading(pattern << 1)
        # When the pattern is read
        actions = asked.decide(reading, (2,), (draw,))
        # Then the action is the oracle's for the pattern's cell, and no cell has changed
        cases = [oracle_says(oracle, [reading], {pattern: c}, n, (draw,)) for c in values for n in REPEAT_COUNTS]
        expected, counts = table(cases, (len(values), 256))
        cell = at(values, memories[:, pattern])
        assert (actions == expected[cell]).all()
        assert (asked.now["repeat_count"] == counts[cell]).all()
        assert (asked.now["memory"] == memories[:, None]).all()


# After a step the repeat count is 0 whatever it was: the first actions, above, have shown that.
@pytest.mark.parametrize("draws", list(itertools.product(range(2), range(10))))
@pytest.mark.parametrize("profile", LISTING_FORWARD)
def test_look_arounds_match_the_oracle_for_all_memories(profile, draws):
    oracle, (memories, _) = oracle_of(profile), cell_cases(profile)
    for pattern in PATTERNS:
        readings = [Reading(0), Reading(pattern << 1)]
        asked = Brains(profile, memories, 7)
        asked.decide(readings[0])
        actions = asked.decide(readings[1], (2, 10), draws)
        expected, counts = table([oracle_says(oracle, readings, {}, 7, draws)], (1,))
        assert (actions == expected).all()
        assert (asked.now["repeat_count"] == counts).all()
        assert (asked.now["memory"] == memories).all()


@pytest.mark.parametrize("beacon_mm", [0, 1, 149, 150, 151, 8191])
@pytest.mark.parametrize("profile", BY_PATTERN)
def test_actions_at_sight_of_food_after_a_step_match_the_oracle(profile, beacon_mm):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    for pattern, draw in itertools.product(PATTERNS, range(2)):
        readings = [Reading(0, True, 8191), Reading(pattern << 1, True, beacon_mm)]
        asked = Brains(profile, memories, 7)
        asked.decide(readings[0])
        actions = asked.decide(readings[1], (2,), (draw,))
        cases = [oracle_says(oracle, readings, {pattern: c}, 7, (draw,)) for c in values]
        expected, counts = table(cases, (len(values),))
        cell = at(values, memories[:, pattern])
        assert (actions == expected[cell]).all()
        assert (asked.now["repeat_count"] == counts[cell]).all()


@pytest.mark.parametrize("pattern", PATTERNS[1:])
@pytest.mark.parametrize("profile", REMEMBERING)
def test_boredom_matches_the_oracle_for_all_memories(profile, pattern):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    memories = memories[memories[:, pattern] != 0]
    bored = Brains(profile, memories, 9)
    bored.decide(Reading(pattern << 1))
    before = bored.now.copy()
    for draw, later in [*((draw, draw % 8) for draw in range(60)), *((0, later) for later in PATTERNS)]:
        readings = [Reading(pattern << 1), Reading(later << 1)]
        bored.now = before.copy()
        actions = bored.decide(readings[1], (60,), (draw,))
        cells = [{pattern: value} for value in values]
        expected, counts = table([oracle_says(oracle, readings, mem, 9, (draw,)) for mem in cells[1:]], (-1,))
        cell, left = at(values, memories[:, pattern]), memories.copy()
        left[:, pattern] = np.array([mem[pattern] for mem in cells], np.uint8)[cell]
        assert (actions == expected[cell - 1]).all()
        assert (bored.now["repeat_count"] == counts[cell - 1]).all()
        assert (bored.now["memory"] == left).all()


@pytest.mark.parametrize("profile", ["forgetful", "adaptive", "searcher"])
def test_sets_of_used_cells_are_judged_as_by_the_oracle(profile):
    oracle, (memories, _) = oracle_of(profile), cell_cases(profile)
    readings = [Reading(2), Reading(4)]
    for used, count in itertools.product(range(0, 256, 2), (8, 9)):
        # Given robots that have used some cells, one or two turns before boredom, with each memory that knows a turn
        memories = memories[memories[:, 1] != 0]
        robots = Brains(profile, memories, count)
        robots.now["used"] = used
        robots.decide(readings[0])
        # When that turn has ended, the next one begins or the robot turns about
        robots.decide(readings[1], (60,), (0,))
        # Then the cells are as the oracle has them, for a sample of the memories
        for i in range(used // 2 % 7, len(memories), 97):
            mem = dict(enumerate(memories[i].tolist()))
            listing = oracle(ScriptedRobot((0,)), mem, count)
            listing.used = used
            search = listing.search()
            for listing.robot.reading in readings:
                next(search)
            assert robots.now["memory"][i].tolist() == list(mem.values())
            assert robots.now["used"][i] == listing.used


def judged(
    oracle: type[Listing], values: Sequence[int], old: int, new: int, draws: tuple[int, int]
) -> tuple[np.ndarray, np.ndarray, np.ndarray, int]:
    """The oracle's action after a trial, its repeat count, and what the new and the old pattern's cells then hold.

    The first three are indexed by the new pattern's cell before the trial, and the first two by the repeat count.
    """
    cases, lessons, seen = [], set(), []
    for cell in values:
        for count in TELLING_COUNTS:
            mem = {new: cell, old: 0}
            cases.append(oracle_says(oracle, [Reading(old << 1), Reading(new << 1)], mem, count, draws))
            lessons.add(mem[old])
        seen.append(mem[new])
    (lesson,) = lessons
    return *table(cases, (len(values), len(TELLING_COUNTS))), np.array(seen, np.uint8), lesson


@pytest.mark.parametrize("old", PATTERNS[1:])
@pytest.mark.parametrize("profile", LISTING_FORWARD)
def test_trials_are_judged_as_by_the_oracle_for_all_memories(profile, old):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    # Given every memory that does not know the old pattern, after a trial to either side
    memories = memories[memories[:, old] == 0]
    for side in range(2):
        tried = Brains(profile, memories[:, None], np.array(TELLING_COUNTS))
        tried.decide(Reading(old << 1), (2,), (side,))
        before = tried.now.copy()
        for new, draw in itertools.product(PATTERNS, range(2)):
            # When a new pattern is read
            tried.now = before.copy()
            actions = tried.decide(Reading(new << 1), (2,), (draw,))
            # Then the same lesson is learned, and the same reading decides the next action
            expected, counts, seen, lesson = judged(oracle, values, old, new, (side, draw))
            cell, known = at(values, memories[:, new]), memories.copy()
            known[:, new], known[:, old] = seen[cell], lesson
            assert (actions == expected[cell]).all()
            assert (tried.now["repeat_count"] == counts[cell]).all()
            assert (tried.now["memory"] == known[:, None]).all()


@pytest.mark.parametrize("feel", range(32))
def test_five_decides_as_its_oracle_in_all_readings(feel):
    oracle = oracle_of("five")
    # Given a memory that knows each side for a reading, or none
    memories = [bytearray(MEMORIES[MemoryKind.ALL_SENSORS][feel].tobytes()) for _ in range(3)]
    for side, memory in enumerate(memories):
        if feel >> 1 & 7:
            oracle(SensingRobot(), memory).learn(feel, side)
    for memory, later, count, draw in itertools.product(memories, range(32), (8, 9), range(2)):
        asked, mem = Brains("five", np.array([list(memory)], np.uint8), count), bytearray(memory)
        readings = [Reading(feel), Reading(later)]
        case = oracle_says(oracle, readings, mem, count, (draw,) * 3)
        choices = {"LOOK_AROUND": (2, 10), "BOREDOM": (60,)}.get(case[0].why, (2,))
        # When that is read, and then another reading
        asked.decide(readings[0], (2,), (draw,))
        action = asked.decide(readings[1], choices, (draw,) * len(choices))
        # Then the second action is the oracle's, and the memory too
        expected, counts = table([case], (1,))
        assert (action == expected).all()
        assert (asked.now["repeat_count"] == counts).all()
        assert asked.now["memory"][0].tobytes() == mem
