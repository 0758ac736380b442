"""A project of its own, with tools/test and stand-ins for what it calls."""

import os
import shutil
import subprocess
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).resolve().parents[2]


def script_named(name: str) -> ModuleType:
    """A script of tools/ as a module."""
    loader = SourceFileLoader(f"tools_{name}", str(ROOT / "tools" / name))
    spec = spec_from_loader(loader.name, loader)
    assert spec is not None
    module = module_from_spec(spec)
    loader.exec_module(module)
    return module


PASSES = "def test_that_passes():\n    pass\n"
FAILS = "def test_that_fails():\n    assert False\n"
TEARDOWN_FAILS = (
    "import pytest\n@pytest.fixture\ndef thing():\n    yield\n    assert False\n"
    "def test_whose_thing_fails(thing):\n    pass\n"
)
SKIPS = "import pytest\ndef test_that_skips():\n    pytest.skip('bus: there is none')\n"
HANGS = """
import os, pathlib, time
def test_that_hangs():
    pathlib.Path({note!r}).write_text(str(os.getpid()))
    time.sleep(1000)
"""
WAITS = """
import pathlib, time
def test_that_waits_for_another_stage():
    while not pathlib.Path({note!r}).exists():
        time.sleep(0.01)
"""
ENDS = "import os\ndef test_that_ends_all():\n    os._exit(0)\n"
BROKEN = "import nothing_of_this_name\n"


class Project:
    """A folder with tools/test, and stand-ins for what it calls."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        shutil.copytree(ROOT / "tools/testing", folder / "tools/testing")
        for tool in ("test", "prove"):
            shutil.copy(ROOT / "tools" / tool, folder / "tools")
        (folder / "tests").mkdir()
        shutil.copy(ROOT / "tests/conftest.py", folder / "tests")
        (folder / "pyproject.toml").write_text("[tool.pytest.ini_options]\nmarkers = ['vcan']\n")
        self.program("tools/setup", "exit 0")
        self.program(".venv/bin/python", f'exec {sys.executable} "$@"')
        (folder / "build/host-san").mkdir(parents=True)

    def program(self, name: str, line: str) -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#!/bin/bash\n{line}\n")
        path.chmod(0o755)

    def python_tests(self, *tests: str) -> None:
        for number, test in enumerate(tests):
            (self.folder / f"tests/test_{number}.py").write_text(test)

    def c_tests(self, **tests: str) -> None:
        lines = [f'add_test({name} "bash" "-c" "{line}")\n' for name, line in tests.items()]
        (self.folder / "build/host-san/CTestTestfile.cmake").write_text("".join(lines))

    def stages(self) -> ModuleType:
        """Its module tools/testing/stages.py."""
        loader = SourceFileLoader("its_stages", str(self.folder / "tools/testing/stages.py"))
        module = module_from_spec(spec_from_loader(loader.name, loader))
        sys.modules[loader.name] = module  # its dataclasses look themselves up
        loader.exec_module(module)
        return module

    def command(self, *words: str, tool: str = "test") -> list[str]:
        return [sys.executable, str(self.folder / "tools" / tool), *words]

    def run(self, *words: str, tool: str = "test") -> tuple[int, str]:
        """The exit code, and what was printed."""
        command = self.command(*words, tool=tool)
        environment = {**os.environ, "PYTEST_XDIST_AUTO_NUM_WORKERS": "1"}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


def last(text: str) -> str:
    return text.splitlines()[-1]
