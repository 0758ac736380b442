"""A planted fault is noticed, by the unit tests of its module or by the sanitizers; sound code is let through."""

import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.firmware.octet_c import GENERATED

ROOT = Path(__file__).resolve().parent.parent
UNITY = Path(os.environ.get("UNITY_DIR", ROOT / "build/unity"))


class Mutant(NamedTuple):
    """One line of a module, and what it is changed to."""

    module: str
    text: str
    changed: str


MUTANTS = {
    "pattern counts two sensors only": Mutant("pattern", " + ((pattern >> 2) & 1u)", ""),
    "pattern is one bit off": Mutant("pattern", "feel >> 1", "feel >> 2"),
    "memory takes a side for cell 0": Mutant("memory", "cells[p] > max[p]", "cells[p] > 2"),
    "memory takes what is no side": Mutant("memory", "cells[p] > max[p]", "cells[p] > max[p] + (p > 0)"),
    "dice favour small numbers": Mutant("random", "if (drawn < n)", "drawn %= n;\n        if (drawn < n)"),
    "dice are rotated by one more": Mutant("random", "rotated(s1, 13)", "rotated(s1, 14)"),
    "a range is open at its end": Mutant("config", "value <= ranges", "value < ranges"),
    "left is right": Mutant("brain", "side == SIDE_RIGHT ? 1 : -1", "side == SIDE_RIGHT ? -1 : 1"),
    "boredom never ends": Mutant("brain", "repeat_count == config", "repeat_count >= config"),
    "a clear way does not end the count": Mutant(
        "brain", "    brain->repeat_count = 0;\n    brain->awaits = AWAITS_L", "    brain->awaits = AWAITS_L"
    ),
    "no better is good enough": Mutant("brain", ">= pattern_count(brain->tried", "> pattern_count(brain->tried"),
    "the lesson goes to another cell": Mutant(
        "brain", "&brain->memory, brain->tried_pattern", "&brain->memory, pattern_of(senses->feel)"
    ),
    "a frozen brain learns": Mutant("brain", "brain->frozen || ", ""),
    "food is eaten one millimetre too far": Mutant("brain", "beacon_mm < config", "beacon_mm <= config"),
    "turns forget what the last one missed": Mutant("motion", "turn_left += action", "turn_left = action"),
    "odometers do not wrap": Mutant("motion", "& (ODOMETER_SPAN - 1)", "& 0xFFFF"),
    "a step runs into the obstacle": Mutant("motion", " || pattern_of(senses->feel) != 0", ""),
    "stuck wheels are waited for": Mutant("motion", "        motion->ticks_left--;", "        ;"),
    "silence drives on": Mutant(
        "robot",
        "out->drive = drive_at_rest(robot);",
        "out->drive = drive_at_rest(robot);\n    motion_drive(&robot->motion, &robot->config, &out->drive);",
    ),
    "silence names no tick": Mutant("robot", "    out->drive = drive_at_rest(robot);\n", ""),
    "trials eat": Mutant("robot", "drive->reason == REASON_EAT", "drive->reason >= REASON_TRIAL"),
    "a stop goes on": Mutant("commands", "    robot->running = false;", "    ;"),
    "a start forgets": Mutant(
        "commands", "    motion_start(&robot->motion);", "    memory_erase(&robot->brain.memory);"
    ),
}


def compiled(program: Path, *arguments: str | Path) -> Path:
    subprocess.run(["gcc", "-std=c99", "-o", program, *arguments], check=True)
    return program


@pytest.fixture(scope="module")
def unity(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return compiled(tmp_path_factory.mktemp("unity") / "unity.o", "-c", UNITY / "unity.c")


def unit_tests_pass(folder: Path, module: str, unity: Path) -> bool:
    """Builds a module's unit tests on the firmware in folder/firmware, and runs them."""
    sources = [source for source in (folder / "firmware").glob("*.c") if source.name != "main.c"]
    test = ROOT / f"tests/firmware/test_{module}.c"
    include = [part for path in (folder, ROOT, GENERATED, UNITY) for part in ("-I", path)]
    program = compiled(folder / "test", *include, test, *sources, unity, "-lm")
    return subprocess.run([program], capture_output=True, timeout=20, check=False).returncode == 0


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    shutil.copytree(ROOT / "firmware", tmp_path / "firmware")
    return tmp_path


@pytest.mark.parametrize("module", sorted({mutant.module for mutant in MUTANTS.values()}))
def test_sound_firmware_passes_its_tests(copy, unity, module):
    assert unit_tests_pass(copy, module, unity)


@pytest.mark.parametrize("mutant", MUTANTS.values(), ids=MUTANTS)
def test_a_planted_fault_fails_the_tests_of_its_module(copy, unity, mutant):
    source = copy / "firmware" / f"{mutant.module}.c"
    sound = source.read_text()
    assert sound.count(mutant.text) == 1, "the text to change is no longer there, or not once"
    source.write_text(sound.replace(mutant.text, mutant.changed))

    assert not unit_tests_pass(copy, mutant.module, unity)


def sanitizer_flags() -> list[str]:
    """What the C tests are built with."""
    (options,) = re.findall(r"add_compile_options\((.*)\)", (ROOT / "tools/cmake/sanitizers.cmake").read_text())
    return options.split()


CRASHES = {
    "heap-buffer-overflow": "char *bytes = calloc(8, 1); int result = bytes[7 + argc]; free(bytes);",
    "heap-use-after-free": "char *bytes = malloc(8); free(bytes); int result = bytes[argc];",
    "signed integer overflow": "int result = INT_MAX; result += argc;",
    "shift exponent": "int result = 1 << (31 + argc);",
}


def run_sanitized(folder: Path, body: str) -> subprocess.CompletedProcess[str]:
    source = folder / "canary.c"
    source.write_text(
        "#include <limits.h>\n#include <stdlib.h>\n"
        f"int main(int argc, char *argv[]) {{ (void)argv; {body} return result == 42; }}\n"
    )
    program = compiled(folder / "canary", *sanitizer_flags(), source)
    return subprocess.run([program], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("error", CRASHES)
def test_the_sanitizers_end_a_program_that_errs(tmp_path, error):
    ended = run_sanitized(tmp_path, CRASHES[error])

    assert ended.returncode != 0
    assert error in ended.stderr


def test_the_sanitizers_let_a_sound_program_be(tmp_path):
    assert run_sanitized(tmp_path, "char *bytes = calloc(8, 1); int result = bytes[7]; free(bytes);").returncode == 0
