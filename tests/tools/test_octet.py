"""tools/octet, with stand-ins for tools/setup and for Python."""

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


def octet(folder: Path, *words: str, **environment: str) -> list[str]:
    """What `tools/octet` asks of tools/setup and of Python, each a line: stand-ins for them print it."""
    for program in ("tools/setup", ".venv/bin/python"):
        stand_in = folder / program
        stand_in.parent.mkdir(parents=True)
        stand_in.write_text('#!/bin/sh\necho "$@" $PYTHONDONTWRITEBYTECODE\n')
        stand_in.chmod(0o755)
    shutil.copy(ROOT / "tools/octet", folder / "tools")
    command = [folder / "tools/octet", *words]
    return subprocess.check_output(command, env={**os.environ, **environment}, text=True).splitlines()


@pytest.mark.parametrize("words", STAGES)
def test_octet_sets_up_what_the_options_need(words: str, tmp_path: Path) -> None:
    assert octet(tmp_path, *words.split()) == [STAGES[words], f"-m host_sim {words}"]


def test_what_python_compiles_for_a_run_is_kept_whatever_the_environment_says(tmp_path: Path) -> None:
    assert octet(tmp_path, "run", PYTHONDONTWRITEBYTECODE="1")[1] == "-m host_sim run"


def test_the_help_of_the_benchmark_waits_for_no_build(tmp_path: Path) -> None:
    for words, stages in (("--help", ["run"]), ("--json", ["tests", "vcan"])):
        folder = tmp_path / words
        for program in ("tools/setup", ".venv/bin/python"):
            stand_in = folder / program
            stand_in.parent.mkdir(parents=True)
            stand_in.write_text('#!/bin/sh\necho "$@"\n')
            stand_in.chmod(0o755)
        shutil.copy(ROOT / "tools/bench", folder / "tools")
        said = subprocess.check_output([folder / "tools/bench", words], text=True)
        assert said.splitlines() == [*stages, f"-m host_sim.bench {words}"]
