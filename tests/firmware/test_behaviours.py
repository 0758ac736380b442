"""Each behaviour decides as its oracle does: at random, and in every case there is.

The oracle of the profile NAME is `Oracle` in `oracles/NAME.py`.
Where a case has a random outcome, the brain is given a generator state that yields it.
"""

import importlib
import itertools
import random
from collections import Counter
from collections.abc import Sequence
from functools import cache, partial
from typing import NamedTuple

import numpy as np
import pytest

from host_sim.protocol.generated import MEMORY_KINDS, PROFILES, MemoryKind
from tests.firmware.memories import CELL_VALUES, MEMORIES, random_memory
from tests.firmware.octet_c import library_path, load
from tests.firmware.oracles.listing import Action, Listing

FFI, C = load()
FFI.cdef("void brain_next_each(struct action *, struct brain *, struct config *, struct senses *, size_t);")

DECISIONS = 1_000_000
"""By which another behaviour's oracle must have been found to differ."""
READINGS_MAX = 100
"""For one decision."""
PATTERNS = range(8)
REPEAT_COUNTS = range(256)
TELLING_COUNTS = (0, 8, 9, 10, 254, 255)


Memory = dict[int, int] | bytearray


class Reading(NamedTuple):
    """What the robot senses as it decides."""

    feel: int
    look: bool = False
    beacon_mm: int = 0
    range_mm: tuple[int, ...] = (255,) * 5


def default_config():
    config = FFI.new("struct config *")
    C.config_reset(config)
    return config


def oracle_of(profile: str) -> type[Listing]:
    return importlib.import_module(f"tests.firmware.oracles.{profile}").Oracle


@pytest.fixture(params=PROFILES)
def profile(request: pytest.FixtureRequest) -> str:
    return request.param


class SensingRobot:
    """A robot for the listing that senses what it is told to, and draws from a generator of its own."""

    readings = 0

    def __init__(self) -> None:
        self.reading = Reading(0)
        self.dice = FFI.new("struct random *")

    def feel(self) -> int:
        self.readings += 1
        assert self.readings < READINGS_MAX, "the oracle reads and decides nothing: the memory means nothing to it"
        return self.reading.feel

    def look(self) -> bool:
        return self.reading.look

    def beacon_mm(self) -> int:
        return self.reading.beacon_mm

    def ranges_mm(self) -> tuple[int, ...]:
        return self.reading.range_mm

    def random(self, n: int) -> int:
        return C.random_below(self.dice, n)


class ScriptedRobot(SensingRobot):
    """The same with draws that are given."""

    def __init__(self, draws: tuple[int, ...]) -> None:
        self.draws = iter(draws)

    def random(self, n: int) -> int:
        draw = next(self.draws)
        assert draw < n
        return draw


def repeat_count_during(action: Action, listing: Listing) -> int:
    """The brain's: it counts a remembered turn as it begins, the listing when it has ended; and it stays at 255."""
    return min(listing.repeat_count + (action.why == "REMEMBERED"), 255)


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


# Every case there is, for a memory with a cell for each pattern. The oracle is asked once for each case that it can
# tell apart: its memory holds only the cells that it reads, and any other index is a KeyError. The brain is asked
# with every whole memory.

BY_PATTERN = [profile for profile in PROFILES if MEMORY_KINDS[profile] != MemoryKind.ALL_SENSORS]
LISTING_FORWARD = [profile for profile in BY_PATTERN if oracle_of(profile).go_forward is Listing.go_forward]
"""Profiles that look for food as the listing does."""
REMEMBERING = [
    profile
    for profile in BY_PATTERN
    if oracle_of(profile)(SensingRobot(), {1: CELL_VALUES[MEMORY_KINDS[profile]][1]}).recall(C.FEEL_FRONT_RIGHT)
]
"""Profiles that make use of their memory."""


def oracle_says(
    oracle: type[Listing], readings: list[Reading], mem: Memory, repeat_count: int, draws: tuple[int, ...]
) -> tuple[Action, int]:
    """The last action of some readings in a row, and the brain's repeat count during it."""
    robot = ScriptedRobot(draws)
    listing = oracle(robot, mem, repeat_count)
    search = listing.search()
    for robot.reading in readings:
        action = next(search)
    return action, repeat_count_during(action, listing)


@cache
def generator_state(choices: tuple[int, ...], wanted: tuple[int, ...]) -> tuple[int, int]:
    """A state of the generator from which random(choices[0]), random(choices[1]).. are as wanted."""
    dice = FFI.new("struct random *")
    drawn, seeds = None, itertools.count()
    while drawn != wanted:
        C.random_seed(dice, next(seeds))
        state = tuple(dice.state)
        drawn = tuple(C.random_below(dice, n) for n in choices)
    return state


KINDS = {"uint8_t": "u1", "_Bool": "?", "int16_t": "i2", "uint16_t": "u2", "enum reason": "u4"}
KINDS |= {"struct memory": "8u1", "struct random": "2u4"}


def layout(struct: str) -> np.dtype:
    """The C struct as numpy sees it."""
    fields = FFI.typeof(struct).fields
    return np.dtype(
        {
            "names": [name for name, _ in fields],
            "formats": [KINDS[field.type.cname] for _, field in fields],
            "offsets": [field.offset for _, field in fields],
            "itemsize": FFI.sizeof(struct),
        }
    )


BRAIN, ACTION = layout("struct brain"), layout("struct action")


class Brains:
    """Many brains of one profile, all asked at once."""

    def __init__(self, ask, profile: str, memories: np.ndarray, repeat_counts: np.ndarray | int) -> None:
        self._ask, self._config = ask, default_config()
        self.now = np.zeros(np.broadcast_shapes(memories.shape[:-1], np.shape(repeat_counts)), BRAIN)
        self.now["profile"] = PROFILES[profile]
        self.now["memory"], self.now["repeat_count"] = memories, repeat_counts

    def decide(self, reading: Reading, choices: tuple[int, ...] = (2,), draws: tuple[int, ...] = (0,)) -> np.ndarray:
        """What each does next, as an array of ACTION, where its random numbers will be these."""
        self.now["random"] = generator_state(choices, draws)
        actions = np.zeros(self.now.shape, ACTION)
        senses = FFI.new("struct senses *", reading._asdict())
        self._ask(
            FFI.from_buffer("struct action[]", actions.reshape(-1)),
            FFI.from_buffer("struct brain[]", self.now.reshape(-1), require_writable=True),
            self._config,
            senses,
            self.now.size,
        )
        return actions


@pytest.fixture(scope="module")
def brains():
    """Makes `Brains`."""
    ask = FFI.dlopen(str(library_path())).brain_next_each
    return partial(Brains, ask)


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
def test_every_first_action_is_that_of_the_oracle(brains, profile, pattern):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    for draw in range(2):
        # Given every memory with every repeat count
        asked = brains(profile, memories[:, None], np.array(REPEAT_COUNTS))
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
def test_every_look_around_is_that_of_the_oracle(brains, profile, draws):
    oracle, (memories, _) = oracle_of(profile), cell_cases(profile)
    for pattern in PATTERNS:
        readings = [Reading(0), Reading(pattern << 1)]
        asked = brains(profile, memories, 7)
        asked.decide(readings[0])
        actions = asked.decide(readings[1], (2, 10), draws)
        expected, counts = table([oracle_says(oracle, readings, {}, 7, draws)], (1,))
        assert (actions == expected).all()
        assert (asked.now["repeat_count"] == counts).all()
        assert (asked.now["memory"] == memories).all()


@pytest.mark.parametrize("beacon_mm", [0, 1, 149, 150, 151, 8191])
@pytest.mark.parametrize("profile", BY_PATTERN)
def test_every_sight_of_food_after_a_step_is_as_by_the_oracle(brains, profile, beacon_mm):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    for pattern, draw in itertools.product(PATTERNS, range(2)):
        readings = [Reading(0, True, 8191), Reading(pattern << 1, True, beacon_mm)]
        asked = brains(profile, memories, 7)
        asked.decide(readings[0])
        actions = asked.decide(readings[1], (2,), (draw,))
        cases = [oracle_says(oracle, readings, {pattern: c}, 7, (draw,)) for c in values]
        expected, counts = table(cases, (len(values),))
        cell = at(values, memories[:, pattern])
        assert (actions == expected[cell]).all()
        assert (asked.now["repeat_count"] == counts[cell]).all()


@pytest.mark.parametrize("pattern", PATTERNS[1:])
@pytest.mark.parametrize("profile", REMEMBERING)
def test_every_boredom_is_that_of_the_oracle(brains, profile, pattern):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    memories = memories[memories[:, pattern] != 0]
    bored = brains(profile, memories, 9)
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
def test_every_set_of_used_cells_is_judged_as_by_the_oracle(brains, profile):
    oracle, (memories, _) = oracle_of(profile), cell_cases(profile)
    readings = [Reading(2), Reading(4)]
    for used, count in itertools.product(range(0, 256, 2), (8, 9)):
        # Given robots that have used some cells, one or two turns before boredom, with each memory that knows a turn
        memories = memories[memories[:, 1] != 0]
        robots = brains(profile, memories, count)
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
def test_every_trial_is_judged_as_by_the_oracle(brains, profile, old):
    oracle, (memories, values) = oracle_of(profile), cell_cases(profile)
    # Given every memory that does not know the old pattern, after a trial to either side
    memories = memories[memories[:, old] == 0]
    for side in range(2):
        tried = brains(profile, memories[:, None], np.array(TELLING_COUNTS))
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
def test_five_decides_in_every_reading_as_its_oracle(brains, feel):
    oracle = oracle_of("five")
    # Given a memory that knows each side for a reading, or none
    memories = [bytearray(MEMORIES[MemoryKind.ALL_SENSORS][feel].tobytes()) for _ in range(3)]
    for side, memory in enumerate(memories):
        if feel >> 1 & 7:
            oracle(SensingRobot(), memory).learn(feel, side)
    for memory, later, count, draw in itertools.product(memories, range(32), (8, 9), range(2)):
        asked, mem = brains("five", np.array([list(memory)], np.uint8), count), bytearray(memory)
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
