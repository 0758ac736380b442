"""Each behaviour, what robots learn from each other, and caution are as their oracles have them, at random."""

import itertools
import random
import re
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from host_sim.protocol.generated import MEMORY_KINDS, PROFILES, TICK_SPAN, MemoryKind
from tests.firmware.many_brains import MEMORIES, default_config, random_memory
from tests.firmware.octet_c import GENERATED, load
from tests.firmware.oracle_robots import Reading, SensingRobot, oracle_of, repeat_count_during
from tests.firmware.oracles.caution import Action, Caution
from tests.firmware.oracles.listing import Listing
from tests.firmware.oracles.sharing import taught

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
        "lost": range(2),
        "tried_side": range(3),
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


def test_random_decisions_match_the_oracle(profile, request):
    decisions = request.config.getoption("decisions")
    seen = decide_side_by_side(profile, oracle_of(profile), decisions)
    # And they held enough of everything that it does
    assert {"WANDER", "TOWARD_FOOD", "LOOK_AROUND", "TRIAL", "EAT"} <= set(seen)
    assert min(seen.values()) > decisions / 1000, seen


@pytest.mark.parametrize(("profile", "other"), list(itertools.permutations(PROFILES, 2)))
def test_comparison_detects_the_oracle_of_another_behaviour(profile, other):
    with pytest.raises(AssertionError):
        decide_side_by_side(profile, oracle_of(other), DECISIONS)


def test_memory_at_the_start_of_a_run_matches_the_oracle(profile):
    brain = FFI.new("struct brain *")
    for before in MEMORIES[MEMORY_KINDS[profile]]:
        FFI.buffer(brain.memory.cell)[:] = bytes(before)
        brain.changed = False
        assert C.brain_start(brain, PROFILES[profile], 1)
        assert FFI.buffer(brain.memory.cell)[:] == oracle_of(profile).begin(bytes(before))
        assert brain.changed or FFI.buffer(brain.memory.cell)[:] == bytes(before)


FFI, C = load()
TICKS = 4000


@pytest.mark.parametrize("profile", ["article", "searcher"])
def test_caution_matches_its_oracle_in_random_ticks(profile):
    dice, oracle, seen = random.Random(1), Caution(), set()
    caution, brain, twin = FFI.new("struct caution *"), FFI.new("struct brain *"), FFI.new("struct brain *")
    config, senses = FFI.new("struct config *"), FFI.new("struct senses *")
    C.config_reset(config)
    for one in (brain, twin):
        C.brain_start(one, PROFILES[profile], 1)
    action = Action()

    def ask(feel: int) -> Action:
        senses.feel = feel
        chosen = C.brain_next(twin, config, senses)
        return Action(chosen.forward_mm, chosen.turn_deg)

    blind = False
    for _ in range(TICKS):
        feel, bump = dice.choice([0, 0, 0, 0, 0, 2, 8, 10]), dice.random() < 0.2
        blind = blind ^ (dice.random() < 0.01)
        senses.feel, senses.bump = feel, bump
        forward = action.forward_mm > 0
        stops = oracle.stops(bump, forward)
        assert C.caution_stops(caution, senses, forward) == stops
        if not stops and dice.random() < 0.5:
            continue
        C.caution_see(caution, feel, blind)
        told = C.caution_next(caution, brain, config, senses)
        felt = senses.feel
        assert (felt, Action(told.forward_mm, told.turn_deg)) == oracle.next(feel, bump, blind, ask)
        action = Action(told.forward_mm, told.turn_deg)
        seen.add(action if told.reason == C.REASON_AVOID else told.reason)
    assert seen >= {Action(-20, 0), Action(0, -24), Action(0, 24), C.REASON_TRIAL, C.REASON_REMEMBERED}


FFI, C = load()
CASES = 400
TICKS_A_SECOND = 50


def rolled(odometer: int, mm_s: int) -> int:
    """An odometer after a tick."""
    return (odometer + mm_s * C.ODOMETER_COUNTS_PER_MM // TICKS_A_SECOND) % C.ODOMETER_SPAN


class SharingRobot:
    """A robot whose way is always clear, so that it learns nothing by itself."""

    def __init__(self, profile: str) -> None:
        self._robot, self._in, self._out = (FFI.new(f"struct {name} *") for name in ("robot", "input", "output"))
        C.robot_init(self._robot, 1)
        self._command(C.OPCODE_START, PROFILES[profile], 1)
        self._command(C.OPCODE_SET, C.SHARE, 1)
        self.pass_second()

    @property
    def brain(self):
        return self._robot.brain

    def pass_second(self) -> None:
        """To the tick in which the second is full, on wheels that obey."""
        senses, drive, self._out.has_report = self._in.senses, self._out.drive, False
        while not self._out.has_report:
            C.robot_respond(self._robot, C.INPUT_SENSES, self._in, self._out)
            senses.tick = (senses.tick + 1) % TICK_SPAN
            senses.odometer_left = rolled(senses.odometer_left, drive.left_mm_s)
            senses.odometer_right = rolled(senses.odometer_right, drive.right_mm_s)

    def hear(self, half: int, cells: bytes) -> None:
        self._in.peer.upper, self._in.peer.cell = bool(half), cells
        C.robot_respond(self._robot, C.INPUT_PEER, self._in, self._out)

    def _command(self, opcode: int, which: int, value: int) -> None:
        self._in.command.opcode, self._in.command.which, self._in.command.value = opcode, which, value
        C.robot_respond(self._robot, C.INPUT_COMMAND, self._in, self._out)


@pytest.mark.parametrize("profile", PROFILES)
def test_cells_taken_from_other_robots_match_the_oracle(profile):
    dice, robot, taken = random.Random(1), SharingRobot(profile), 0
    cells = FFI.buffer(robot.brain.memory.cell)
    for _ in range(CASES):
        # Given a memory, and others that were heard in any order
        cells[:] = memory = random_memory(MEMORY_KINDS[profile], dice)
        robot.brain.unlearned = dice.randrange(0, 256, 2)
        kinds = dice.choices([MemoryKind.SIDES, MemoryKind.CONFIDENCE], k=dice.choice([0, 1, 2, 3, 7, 30]))
        others = [random_memory(kind, dice) for kind in kinds]
        halves = [(half, other[4 * half : 4 * half + 4]) for other in others for half in range(2)]
        for half, heard in dice.sample(halves, len(halves)):
            robot.hear(half, heard)
        # When the second is over
        robot.pass_second()
        # Then it knows what the oracle says
        expected = taught(profile, memory, robot.brain.unlearned, others)
        assert cells[:] == bytes(expected)
        taken += bytes(expected) != memory
    assert bool(taken) == (profile not in {"fixed", "never", "five"})


ROOT = Path(__file__).resolve().parents[2]
CORE = sorted(path for path in (ROOT / "firmware").rglob("*.c") if path.name != "main.c")
ALLOWED = {"memcpy", "memset"}
IMPURE = {
    "the heap": "#include <stdlib.h>\nvoid *f(void) { return malloc(8); }\n",
    "the clock": "#include <time.h>\ntime_t f(void) { return time(0); }\n",
    "the console": '#include <stdio.h>\nint f(void) { return puts("x"); }\n',
}


def linked(sources: list[Path], folder: Path) -> Path:
    """These sources and objects as one object."""
    program = folder / "linked.o"
    compiler = [
        "gcc",
        "-std=c99",
        "-O2",
        "-fno-stack-protector",
        "-I",
        ROOT,
        "-I",
        GENERATED,
        "-r",
        "-nostdlib",
        "-o",
        program,
    ]
    subprocess.run([*compiler, *sources], check=True)
    return program


def wanted_by(program: Path) -> set[str]:
    """What an object still wants from others."""
    listed = subprocess.run(["nm", "--undefined-only", program], check=True, capture_output=True, text=True).stdout
    return {line.split()[-1] for line in listed.splitlines()} - {"_GLOBAL_OFFSET_TABLE_"}


@pytest.fixture(scope="module")
def core(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return linked(CORE, tmp_path_factory.mktemp("core"))


def test_core_links_with_memcpy_and_memset_only(core):
    assert len(CORE) >= 12
    assert wanted_by(core) <= ALLOWED


@pytest.mark.parametrize("source", IMPURE.values(), ids=IMPURE.keys())
def test_link_check_detects_use_of_heap_clock_and_console(source, core, tmp_path):
    impure = tmp_path / "impure.c"
    impure.write_text(source)

    assert not wanted_by(linked([core, impure], tmp_path)) <= ALLOWED


@pytest.mark.parametrize("path", sorted((ROOT / "firmware").rglob("*.[ch]")), ids=lambda path: path.name)
def test_firmware_has_no_conditional_compilation_or_floating_point(path):
    text = path.read_text()
    guards = re.findall(r"^#\s*(?:if|ifdef|ifndef|elif)\b.*$", text, re.MULTILINE)

    assert guards == ([f"#ifndef OCTET_{path.stem.upper()}_H"] if path.suffix == ".h" else [])
    assert re.findall(r"\b(?:float|double)\b|\d\.\d+f?\b", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)) == []


def included_from_the_body(text: str) -> list[str]:
    """The headers of hal/ that a source includes."""
    return re.findall(r'^#\s*include "(hal/[^"]+)"', text, re.MULTILINE)


@pytest.mark.parametrize("path", sorted((ROOT / "firmware").rglob("*.[ch]")), ids=lambda path: path.name)
def test_only_main_includes_a_header_of_hal(path):
    assert included_from_the_body(path.read_text()) == (["hal/hal.h"] if path.name == "main.c" else [])


def test_included_header_of_hal_is_detected():
    assert included_from_the_body('#include <stdint.h>\n#include "hal/link/link.h"\n') == ["hal/link/link.h"]
