"""A build depends on the sources and the presets, and on nothing in the caller's environment."""

import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CANARY = "OCTET_CANARY"
FLAGS = ("CFLAGS", "CPPFLAGS", "LDFLAGS")
PLACES = ("CPATH", "C_INCLUDE_PATH", "COMPILER_PATH", "GCC_EXEC_PREFIX", "LIBRARY_PATH")
PRESETS = ("host", "blue_pill")


def configure(folder: Path, preset: str, *options: str) -> str:
    """The build.ninja of a preset that is configured with flags in the environment."""
    environment = {**os.environ, **{name: f"-D{CANARY}_{name}" for name in FLAGS}}
    command = ["cmake", "-B", folder, "--preset", preset, *options]
    subprocess.run(command, cwd=ROOT, env=environment, check=True, capture_output=True)
    return (folder / "build.ninja").read_text()


@pytest.fixture(scope="module", params=PRESETS)
def configured(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which a preset is configured with flags in the environment."""
    folder = tmp_path_factory.mktemp(request.param)
    configure(folder, request.param)
    return folder


@pytest.fixture
def misled(tmp_path: Path) -> dict[str, str]:
    """An environment in which a compiler finds a header that stops it, before its own, and a linker that fails."""
    (tmp_path / "stdint.h").write_text("#error misled\n")
    (tmp_path / "as").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "as").chmod(0o755)
    return {**os.environ, **dict.fromkeys(PLACES, f"{tmp_path}/")}


def test_flags_of_the_environment_reach_no_build(configured: Path) -> None:
    assert CANARY not in (configured / "build.ninja").read_text()


def test_flags_given_to_cmake_reach_the_build(tmp_path: Path) -> None:
    assert CANARY in configure(tmp_path / "build", "host", f"-DCMAKE_C_FLAGS=-D{CANARY}")


def test_search_paths_of_the_environment_mislead_no_build(configured: Path, misled: dict[str, str]) -> None:
    target, *_ = [
        line.split()[1].rstrip(":")
        for line in (configured / "build.ninja").read_text().splitlines()
        if re.match(r"build \S*/pattern\.c\.o(bj)?:", line)
    ]

    done = subprocess.run(
        ["ninja", "-C", configured, target], env=misled, capture_output=True, text=True, check=False
    )

    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("compiler", ["gcc", "arm-none-eabi-gcc"])
def test_search_paths_mislead_a_bare_compiler(compiler: str, misled: dict[str, str], tmp_path: Path) -> None:
    source = tmp_path / "one.c"
    source.write_text("#include <stdint.h>\nint32_t one;\n")

    done = subprocess.run([compiler, "-c", source], cwd=tmp_path, env=misled, capture_output=True, check=False)

    assert done.returncode != 0


@pytest.mark.parametrize("compiles", [True, False])
def test_compiler_and_linker_run_without_search_paths_of_the_environment(configured: Path, compiles: bool) -> None:
    listed = ["ninja", "-C", configured, "-t", "commands"]
    lines = subprocess.run(listed, capture_output=True, text=True, check=True).stdout.splitlines()
    calls = [line for line in lines if re.search(r"/(cc|arm-none-eabi-gcc) ", line)]
    commands = [line for line in calls if (" -c " in line) == compiles]

    assert commands
    assert all(f"-u {name} " in command for command in commands for name in PLACES)
