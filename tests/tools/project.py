"""A project of its own, with tools/test and stand-ins for what it calls."""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
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


def soon(condition: Callable[[], bool]) -> bool:
    """Whether the condition comes true within ten minutes: long enough for any machine that works at all."""
    deadline = time.monotonic() + 600
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.05)
    return condition()


def alive(pid: int) -> bool:
    """Whether the process exists and is more than a zombie that nobody has waited for."""
    try:
        return "\nState:\tZ" not in Path(f"/proc/{pid}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False


EXTRAS = ("export", "study", "cluster", "classroom")
INSTALLERS = ("sudo", "apt-get")
"""Replaced by stand-ins, so that no test installs a package that this machine lacks."""
STAGES = ("run", "emulator", "gym", *EXTRAS, "tests", "web")
LOCKS = tuple(f"requirements/{name}.lock" for name in STAGES)

# Notes each call. `python3 -m venv` makes a folder whose python does the same, with a script as pip writes it;
# cmake, esbuild, tools/generate and the download of Unity make what they are to make. With a file beside the
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
  esbuild*) mkdir -p build/web ;;
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
        for name in ("python3", "cmake", "esbuild", "ninja", *INSTALLERS):
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
