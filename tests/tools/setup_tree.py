"""A tree in which tools/setup runs, with stand-ins for the programs that it calls."""

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

EXTRAS = ("export", "study", "cluster", "classroom")
INSTALLERS = ("sudo", "apt-get")
"""With stand-ins for these, no test installs a package that this machine lacks."""
STAGES = ("run", "emulator", "gym", *EXTRAS, "tests", "web")
LOCKS = tuple(f"requirements/{name}.lock" for name in STAGES)

# Notes each call. `python3 -m venv` makes a folder whose python does the same, with a script as pip writes it;
# cmake, tools/generate and the download of Unity make what they are to make. With a file beside the
# notes, installing that lock fails, as without a network.
STAND_IN = """#!/bin/bash
[ "$*" = --version ] || echo "${0##*/} $*" >>"$CALLS"
case "${0##*/} $*" in
  "python3 -m venv"*)
    mkdir -p "$3/bin" && cp "$0" "$3/bin/python"
    printf '%s\\n' "#!$PWD/$3/bin/python" >"$3/bin/script"
    ;;
  "python tools/generate"*) touch "$3" "$5" "$7" ;;
  cmake*) mkdir -p "$2" ;;
  *" download "*)
    mkdir -p build/unity/its/tests/c/test_framework
    touch -d 2020-01-01 build/unity/its/tests/c/test_framework/unity.c
    tar -czf build/unity/cantools-1.tar.gz -C build/unity its
    ;;
  *install*--require-hashes*) lock=${!#} && [ ! -e "$CALLS.no-${lock##*/}" ] ;;
esac
"""


class Tree:
    """A copy of what tools/setup reads, in a folder of its own."""

    def __init__(self, tmp_path: Path) -> None:
        self.folder = tmp_path / "a tree"
        self.calls = tmp_path / "calls"
        self.environment: dict[str, str] = {}
        self.bin = tmp_path / "bin"
        (self.folder / "tools").mkdir(parents=True)
        shutil.copy(ROOT / "tools/setup", self.folder / "tools")
        for name in ("pyproject.toml", "CMakePresets.json"):
            shutil.copy(ROOT / name, self.folder)
        for name in (
            *LOCKS,
            "hal/protocol/octet.dbc",
            "hal/protocol/robot.toml",
            "tools/generate",
            "requirements/unity.lock",
            "tools/robot_words/description.py",
            "tools/robot_words/model.py",
            "tools/cmake/wasm32.cmake",
            "host_sim/recording/state_types.py",
            "host_sim/world/geometry.py",
        ):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        for name in ("host_sim/protocol", "host_sim/web"):
            (self.folder / name).mkdir(parents=True)
        self.bin.mkdir()
        for name in ("python3", "cmake", "ninja", *INSTALLERS):
            (self.bin / name).write_text(STAND_IN)
            (self.bin / name).chmod(0o755)

    def setup(self, *stages: str, path: str | None = None) -> tuple[subprocess.CompletedProcess[str], list[str]]:
        """Runs tools/setup and returns how it ended and what it called."""
        self.calls.write_text("")
        environment = {
            **self.environment,
            "PATH": path or f"{self.bin}:{os.environ['PATH']}",
            "CALLS": str(self.calls),
        }
        command = [self.folder / "tools/setup", *stages]
        done = subprocess.run(command, cwd="/", env=environment, capture_output=True, text=True, check=False)
        return done, [line.split()[0] for line in self.calls.read_text().splitlines()]

    def installed(self) -> list[str]:
        """The lock files whose packages the last call installed."""
        return [line.split()[-1] for line in self.calls.read_text().splitlines() if "--require-hashes" in line]

    def built(self) -> list[str]:
        """The folders that the last call configured."""
        return [line.split()[2] for line in self.calls.read_text().splitlines() if line.startswith("cmake -B")]

    @contextmanager
    def offline(self, lock: str) -> Iterator[None]:
        """Makes the installation of that lock file fail."""
        broken = Path(f"{self.calls}.no-{Path(lock).name}")
        broken.touch()
        yield
        broken.unlink()

    def change(self, lock: str) -> None:
        with (self.folder / lock).open("a") as text:
            text.write("# changed\n")
