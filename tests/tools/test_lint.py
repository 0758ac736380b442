"""The stages lint and types reject what they are for, in every script of tools/."""

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.tools.project import ROOT, script_named

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
    """The exit code of a command of a stage for one file in place of all."""
    options = [word for word in command if not word.startswith("tools/") and word != ".ci/run"]
    return subprocess.run([*options, path], cwd=ROOT, capture_output=True, check=False).returncode


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_found(folder, name):
    path = folder / "planted.py"
    path.write_text(FINE.get(name, '"""A module."""\n'))
    assert judge(COMMANDS[name], path) == 0

    path.write_text(FAULTS[name])

    assert judge(COMMANDS[name], path) == 1


@pytest.mark.parametrize("stage", ["extend-include", "files"])
def test_every_script_in_python_is_checked(stage):
    named = re.search(rf"^{stage} = \[(.*)\]$", (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    scripts = [
        it
        for it in (ROOT / "tools").iterdir()
        if it.is_file() and it.read_bytes().startswith(b"#!/usr/bin/env python3")
    ]

    assert len(scripts) > 10
    assert named is not None
    assert {f'"tools/{it.name}"' for it in scripts if not it.suffix} <= set(named[1].split(", "))


def test_every_script_for_a_shell_is_checked():
    scripts = [it for it in (ROOT / "tools").iterdir() if it.is_file() and b"bash\n" in it.read_bytes()[:25]]

    assert {f"tools/{it.name}" for it in scripts} <= set(COMMANDS["shellchecktools/setup"])
