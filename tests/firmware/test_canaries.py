"""A planted fault is noticed by the unit tests of its module; sound firmware is let through."""

import os
import subprocess
from pathlib import Path

import pytest

from tests.firmware.octet_c import GENERATED
from tests.firmware.planted_faults import FAULTS, FUNCTIONS

ROOT = Path(__file__).resolve().parents[2]
UNITY = Path(os.environ.get("UNITY_DIR", ROOT / "build/unity"))
INCLUDE = [part for folder in (ROOT, GENERATED, UNITY) for part in ("-I", folder)]
MODULES = sorted({fault.module for fault in FAULTS.values()})
CANARY = """\
#include <stdlib.h>
#include <string.h>

#include "firmware/behaviours/behaviour.h"
#include "firmware/behaviours/listing.h"
#include "firmware/memory/confidence.h"
#include "firmware/memory/feel_memory.h"
#include "firmware/memory/memory_kind.h"
#include "firmware/memory/memory_write.h"
#include "firmware/pattern.h"
#include "firmware/robot.h"

#define real __real_{function}
{returns} __real_{function}({parameters});
{returns} __wrap_{function}({parameters});
{returns} __wrap_{function}({parameters})
{{
    {body}
}}
"""


def compiled(program: Path, *arguments: str | Path) -> Path:
    subprocess.run(["gcc", "-std=c99", "-o", program, *arguments], check=True)
    return program


@pytest.fixture(scope="module")
def objects(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The firmware and Unity with the tests' main, compiled."""
    folder = tmp_path_factory.mktemp("objects")
    sources = [source for source in (ROOT / "firmware").rglob("*.c") if source.name != "main.c"]
    sources += [UNITY / "unity.c", ROOT / "tests/test.c"]
    return [compiled(folder / f"{source.stem}.o", *INCLUDE, "-c", source) for source in sources]


def unit_tests_pass(folder: Path, module: str, objects: list[Path], *more: str | Path) -> bool:
    """Builds a module's unit tests with the firmware and with what is more, and runs them."""
    (test,) = (ROOT / "tests/firmware").rglob(f"test_{module}.c")
    rigs = test.parent.glob("*_rig.c")
    program = compiled(folder / "test", *INCLUDE, test, *rigs, *objects, *more, "-lm")
    return subprocess.run([program], capture_output=True, timeout=600, check=False).returncode == 0


def planted(folder: Path, function: str, body: str) -> list[str | Path]:
    """What a compiler is told to link a body in the place of a function."""
    returns, parameters = FUNCTIONS[function]
    source = folder / "canary.c"
    source.write_text(CANARY.format(function=function, returns=returns, parameters=parameters, body=body))
    return [source, f"-Wl,--wrap={function}"]


@pytest.mark.parametrize("module", MODULES)
def test_sound_firmware_passes_its_tests(tmp_path, objects, module):
    assert unit_tests_pass(tmp_path, module, objects)


@pytest.mark.parametrize("module", MODULES)
def test_a_replacement_that_does_the_same_is_let_through(tmp_path, objects, module):
    more = planted(tmp_path, "pattern_of", "return real(feel);")

    assert unit_tests_pass(tmp_path, module, objects, *more)


@pytest.mark.parametrize("fault", FAULTS.values(), ids=FAULTS)
def test_a_planted_fault_fails_the_tests_of_its_module(tmp_path, objects, fault):
    more = planted(tmp_path, fault.function, fault.body)

    assert not unit_tests_pass(tmp_path, fault.module, objects, *more)
