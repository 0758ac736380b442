"""The core asks nothing of anyone: no heap, no clock, no operating system, no floating point, no conditional code."""

import re
import subprocess
from pathlib import Path

import pytest

from tests.firmware.octet_c import GENERATED

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


def test_the_core_wants_nothing_but_copying_and_clearing(core):
    assert len(CORE) >= 12
    assert wanted_by(core) <= ALLOWED


@pytest.mark.parametrize("source", IMPURE.values(), ids=IMPURE.keys())
def test_whoever_wants_more_is_noticed(source, core, tmp_path):
    impure = tmp_path / "impure.c"
    impure.write_text(source)

    assert not wanted_by(linked([core, impure], tmp_path)) <= ALLOWED


@pytest.mark.parametrize("path", sorted((ROOT / "firmware").rglob("*.[ch]")), ids=lambda path: path.name)
def test_the_core_is_the_same_everywhere_and_counts_in_whole_numbers(path):
    text = path.read_text()
    guards = re.findall(r"^#\s*(?:if|ifdef|ifndef|elif)\b.*$", text, re.MULTILINE)

    assert guards == ([f"#ifndef OCTET_{path.stem.upper()}_H"] if path.suffix == ".h" else [])
    assert re.findall(r"\b(?:float|double)\b|\d\.\d+f?\b", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)) == []


def included_from_the_body(text: str) -> list[str]:
    """The headers of hal/ that a source includes."""
    return re.findall(r'^#\s*include "(hal/[^"]+)"', text, re.MULTILINE)


@pytest.mark.parametrize("path", sorted((ROOT / "firmware").rglob("*.[ch]")), ids=lambda path: path.name)
def test_only_main_knows_that_there_is_a_body(path):
    assert included_from_the_body(path.read_text()) == (["hal/hal.h"] if path.name == "main.c" else [])


def test_a_header_of_the_body_is_noticed():
    assert included_from_the_body('#include <stdint.h>\n#include "hal/link/link.h"\n') == ["hal/link/link.h"]
