"""tools/setup, with stand-ins for the programs that it calls."""

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# Notes each call; `python3 -m venv` makes a .venv whose python does the same, and cmake and tools/generate make what
# they are to make.
STAND_IN = """#!/bin/bash
[ "$*" = --version ] || echo "${0##*/} $*" >>"$CALLS"
case "${0##*/} $*" in
  "python3 -m venv"*) mkdir -p .venv/bin && cp "$0" .venv/bin/python ;;
  "python tools/generate"*) touch "$3" "$5" ;;
  cmake*) mkdir -p build/host ;;
  *install*--require-hashes*) [ ! -e "$CALLS.break" ] ;;
esac
"""


class Tree:
    """A copy of what tools/setup reads, in a folder of its own."""

    def __init__(self, tmp_path: Path) -> None:
        self.folder = tmp_path / "a tree"
        self.calls = tmp_path / "calls"
        self.bin = tmp_path / "bin"
        (self.folder / "tools").mkdir(parents=True)
        shutil.copy(ROOT / "tools/setup", self.folder / "tools")
        for name in ("requirements.lock", "pyproject.toml", "CMakePresets.json"):
            shutil.copy(ROOT / name, self.folder)
        for name in (
            "hal/protocol/octet.dbc",
            "hal/protocol/robot.toml",
            "tools/generate",
            "tools/robot_words/model.py",
        ):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        for name in ("host_sim/protocol", "host_sim/web"):
            (self.folder / name).mkdir(parents=True)
        self.bin.mkdir()
        for name in ("python3", "cmake", "ninja"):
            (self.bin / name).write_text(STAND_IN)
            (self.bin / name).chmod(0o755)

    def setup(self, path: str | None = None) -> tuple[subprocess.CompletedProcess[str], list[str]]:
        """Runs tools/setup and returns how it ended and what it called."""
        self.calls.write_text("")
        environment = {"PATH": path or f"{self.bin}:{os.environ['PATH']}", "CALLS": str(self.calls)}
        command = [self.folder / "tools/setup"]
        done = subprocess.run(command, cwd="/", env=environment, capture_output=True, text=True, check=False)
        return done, [line.split()[0] for line in self.calls.read_text().splitlines()]


@pytest.fixture
def tree(tmp_path: Path) -> Tree:
    return Tree(tmp_path)


def test_the_first_call_sets_up_and_names_each_step(tree: Tree) -> None:
    done, calls = tree.setup()
    assert done.returncode == 0
    assert {"python3", "python", "cmake", "ninja"} == set(calls)
    assert [line.split()[1] for line in done.stderr.splitlines()] == ["installing", "registering", "building"]


def test_the_second_call_only_asks_ninja_and_says_nothing(tree: Tree) -> None:
    tree.setup()
    done, calls = tree.setup()
    assert calls == ["ninja"]
    assert done.stdout + done.stderr == ""


def test_an_interrupted_set_up_is_repaired(tree: Tree) -> None:
    broken = Path(f"{tree.calls}.break")
    broken.touch()
    assert tree.setup()[0].returncode != 0
    broken.unlink()
    done, calls = tree.setup()
    assert done.returncode == 0
    assert calls.count("cmake") == 1


def test_a_moved_folder_is_set_up_anew(tree: Tree) -> None:
    tree.setup()
    tree.folder = tree.folder.rename(tree.folder.with_name("moved"))
    assert "cmake" in tree.setup()[1]


def test_a_changed_lock_file_is_installed(tree: Tree) -> None:
    tree.setup()
    with (tree.folder / "requirements.lock").open("a") as lock:
        lock.write("# changed\n")
    assert "python3" in tree.setup()[1]


def test_what_cannot_be_installed_is_named_with_the_command(tree: Tree) -> None:
    for name in ("bash", "cat", "dirname", "env", "flock", "mkdir", "readlink"):
        (tree.bin / name).symlink_to(str(shutil.which(name)))
    (tree.bin / "cmake").unlink()
    done, _ = tree.setup(path=str(tree.bin))
    assert done.returncode != 0
    assert "apt-get install gcc cmake\n" in done.stderr


def test_with_nothing_to_do_it_takes_less_than_0_3_s() -> None:
    times = []
    for _ in range(5):
        start = time.monotonic()
        subprocess.run([ROOT / "tools/setup"], check=True)
        times.append(time.monotonic() - start)
    assert min(times) < 0.3


def test_the_lock_files_pin_by_hash_and_name_no_address() -> None:
    for path in (ROOT / "requirements.lock", ROOT / "tools/unity.lock"):
        text = path.read_text()
        assert "://" not in text
        assert text.count("==") <= text.count("--hash=sha256:")
