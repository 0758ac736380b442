"""tools/rooms: changes of files, lines and statements in a checkout of its own, with sums counted by hand."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.tools.project import ROOT, script_named

PYTHON = '"""Adds."""\n\nimport sys\n\n\ndef add(a: int) -> int:\n    """As it says."""\n    return a + 1\n'
C = "/* Adds; twice. */\nint add(int a)\n{\n    if (a)   // never\n        return a + 1;\n    return 2;\n}\n"


@pytest.fixture
def rooms(tmp_path):
    """A checkout with a commit, and its rows by room."""
    for name, text in {"host_sim/world/add.py": PYTHON, "firmware/add.c": C, "picture.png": "1\n2\n"}.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    for words in ("init -q", "add .", "-c user.name=a -c user.email=a commit -qm a"):
        subprocess.run(["git", *words.split()], cwd=tmp_path, check=True)
    (tmp_path / ".git/info/exclude").write_text("tools\n")
    (tmp_path / "tools").mkdir()
    shutil.copy(ROOT / "tools/rooms", tmp_path / "tools")

    def run(*words: str) -> dict[str, list[str]]:
        said = subprocess.check_output([tmp_path / "tools/rooms", *words], text=True).splitlines()[1:]
        return {line.split()[0]: line.split()[1:] for line in said}

    return tmp_path, run


def test_unchanged_checkout_differs_in_no_room(rooms):
    _, run = rooms

    assert run() == {"product": ["2", "15", "5", "+0", "+0", "+0"], "tests": ["0", "0", "0", "+0", "+0", "+0"]}


def test_unknown_commit_is_refused_in_one_line(rooms):
    path, _ = rooms

    done = subprocess.run([path / "tools/rooms", "--since", "nonsense"], capture_output=True, text=True, check=False)

    assert (done.returncode, done.stderr) == (2, "tools/rooms: there is no commit nonsense: see git log\n")


def test_room_counts_files_lines_and_statements(rooms):
    _, run = rooms

    assert run("--all")["host_sim/world"] == ["1", "8", "2", "+0", "+0", "+0"]
    assert run("--all")["firmware"] == ["1", "7", "3", "+0", "+0", "+0"]


def test_new_changed_and_deleted_files_count(rooms):
    folder, run = rooms
    (folder / "firmware/add.c").unlink()
    (folder / "tests").mkdir()
    (folder / "tests/test_add.py").write_text("def test_add():\n    assert add(1) == 2\n")
    (folder / "host_sim/world/add.py").write_text(PYTHON + "\n\nONE = 1\n")

    found = run()

    assert found["firmware"] == ["0", "0", "0", "-1", "-7", "-3"]
    assert found["host_sim/world"] == ["1", "11", "3", "+0", "+3", "+1"]
    assert found["tests"] == ["1", "2", "2", "+1", "+2", "+2"]


COMMANDS = {
    Path(command[0]).name + "".join(command[1:2]): command
    for stage in script_named("test").all_stages(())
    if stage.name in {"lint", "types"}
    for command in stage.commands
}
FAULTS = {
    "ruffcheck": "import os\n",
    "ruffformat": "def one() -> int:\n# Too far to the left.\n    return 1\n",
    "mypy": "def same(it):\n    return it\n",
    "shellchecktools/setup": '#!/bin/sh\nrm "$1" $2\n',
}
FINE = {"shellchecktools/setup": '#!/bin/sh\nrm "$1"\n'}


@pytest.fixture
def folder() -> Iterator[Path]:
    """A folder to which the settings of this project apply."""
    with TemporaryDirectory(dir=ROOT / "build") as temporary:
        yield Path(temporary)


def judge(command: tuple[str, ...], path: Path) -> int:
    """The exit code of a stage's command, for one file instead of all."""
    options = [word for word in command if not word.startswith("tools/") and word != ".ci/run"]
    return subprocess.run([*options, path], cwd=ROOT, capture_output=True, check=False).returncode


@pytest.mark.parametrize("name", FAULTS)
def test_stage_command_finds_a_fault(folder, name):
    path = folder / "planted.py"
    path.write_text(FINE.get(name, '"""A module."""\n'))
    assert judge(COMMANDS[name], path) == 0

    path.write_text(FAULTS[name])

    assert judge(COMMANDS[name], path) == 1


@pytest.mark.parametrize("stage", ["extend-include", "files"])
def test_python_scripts_are_all_checked(stage):
    named = re.search(rf"^{stage} = \[(.*)\]$", (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    scripts = [
        it
        for it in (ROOT / "tools").iterdir()
        if it.is_file() and it.read_bytes().startswith(b"#!/usr/bin/env python3")
    ]

    assert len(scripts) > 10
    assert named is not None
    assert {f'"tools/{it.name}"' for it in scripts if not it.suffix} <= set(named[1].split(", "))


def test_shell_scripts_are_all_checked():
    scripts = [it for it in (ROOT / "tools").iterdir() if it.is_file() and b"bash\n" in it.read_bytes()[:25]]

    assert {f"tools/{it.name}" for it in scripts} <= set(COMMANDS["shellchecktools/setup"])
