"""tools/octet and tools/bench, with stand-ins for tools/setup and for Python."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# What `tools/octet` sets up, by the words after it.
STAGES = {
    "run": "run",
    "replay out/run.log": "run",
    "run --robot qemu": "images",
    "run --robot=qemu --seed 2": "images",
    "run --robot emulated --board stm32f103": "images emulator",
    "watch --robot=emulated": "images emulator",
}


def called(folder: Path, *words: str, **environment: str) -> list[str]:
    """What a tool asks of tools/setup and of Python, each a line: stand-ins for them print it."""
    for program in ("tools/setup", ".venv/bin/python"):
        stand_in = folder / program
        stand_in.parent.mkdir(parents=True)
        stand_in.write_text('#!/bin/sh\necho "$@" $PYTHONDONTWRITEBYTECODE\n')
        stand_in.chmod(0o755)
    shutil.copy(ROOT / words[0], folder / "tools")
    return subprocess.check_output(words, cwd=folder, env={**os.environ, **environment}, text=True).splitlines()


@pytest.mark.parametrize("words", STAGES)
def test_octet_sets_up_what_the_options_need(words: str, tmp_path: Path) -> None:
    assert called(tmp_path, "tools/octet", *words.split()) == [STAGES[words], f"-m host_sim {words}"]


def test_what_python_compiles_for_a_run_is_kept_whatever_the_environment_says(tmp_path: Path) -> None:
    assert called(tmp_path, "tools/octet", "run", PYTHONDONTWRITEBYTECODE="1")[1] == "-m host_sim run"


@pytest.mark.parametrize(("word", "stages"), [("--help", ["run"]), ("--json", ["tests", "vcan"])])
def test_the_help_of_the_benchmark_waits_for_no_build(word: str, stages: list[str], tmp_path: Path) -> None:
    assert called(tmp_path, "tools/bench", word) == [*stages, f"-m host_sim.bench {word}"]
