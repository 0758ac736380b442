"""What is built depends on the sources and the presets, and on nothing that the caller's environment holds."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CANARY = "OCTET_CANARY"
VARIABLES = ("CFLAGS", "CPPFLAGS", "LDFLAGS")


def configured(folder: Path, preset: str, *options: str) -> str:
    """What ninja would do, configured with flags in the environment."""
    environment = {**os.environ, **{name: f"-D{CANARY}_{name}" for name in VARIABLES}}
    command = ["cmake", "-B", folder, "--preset", preset, *options]
    subprocess.run(command, cwd=ROOT, env=environment, check=True, capture_output=True)
    return (folder / "build.ninja").read_text()


@pytest.mark.parametrize("preset", ["host", "blue_pill"])
def test_flags_of_the_environment_reach_no_build(preset: str, tmp_path: Path) -> None:
    assert CANARY not in configured(tmp_path / "build", preset)


def test_flags_that_reach_a_build_are_seen(tmp_path: Path) -> None:
    assert CANARY in configured(tmp_path / "build", "host", f"-DCMAKE_C_FLAGS=-D{CANARY}")
