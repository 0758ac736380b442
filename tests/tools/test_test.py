"""tools/test in a project of its own: what it counts, and what it does when time runs out."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.tools.processes import alive, soon

ROOT = Path(__file__).resolve().parents[2]

PASSES = "def test_that_passes():\n    pass\n"
FAILS = "def test_that_fails():\n    assert False\n"
TEARDOWN_FAILS = (
    "import pytest\n@pytest.fixture\ndef thing():\n    yield\n    assert False\n"
    "def test_whose_thing_fails(thing):\n    pass\n"
)
SKIPS = "import pytest\ndef test_that_skips():\n    pytest.skip('bus: there is none')\n"
HANGS = "import time\ndef test_that_hangs():\n    time.sleep(1000)\n"
BROKEN = "import nothing_of_this_name\n"


class Project:
    """A folder with tools/test, and stand-ins for what it calls."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        shutil.copytree(ROOT / "tools/testing", folder / "tools/testing")
        shutil.copy(ROOT / "tools/test", folder / "tools")
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

    def command(self, *words: str) -> list[str]:
        return [sys.executable, str(self.folder / "tools/test"), *words]

    def run(self, *words: str) -> tuple[int, str]:
        """The exit code, and what was printed."""
        environment = {**os.environ, "PYTEST_XDIST_AUTO_NUM_WORKERS": "1"}
        done = subprocess.run(
            self.command(*words), env=environment, capture_output=True, text=True, timeout=120, check=False
        )
        return done.returncode, done.stdout


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


def last(text: str) -> str:
    return text.splitlines()[-1]


def test_tests_that_pass_are_counted(project):
    project.python_tests(PASSES, PASSES, PASSES)
    project.c_tests(one="true", two="true")

    code, said = project.run("c", "python")

    assert (code, last(said)) == (0, "5 passed, 0 failed")


def test_tests_that_do_not_pass_are_counted_as_failed(project):
    project.python_tests(PASSES, FAILS, SKIPS, TEARDOWN_FAILS)

    code, said = project.run("python")

    assert (code, last(said)) == (1, "1 passed, 3 failed")


def test_a_file_that_cannot_be_read_is_counted_as_failed(project):
    project.python_tests(PASSES, BROKEN)

    code, said = project.run("python")

    assert code == 1
    assert last(said).endswith(", 1 failed")


def test_a_skip_that_the_caller_allowed_is_named(project):
    project.python_tests(PASSES, SKIPS)

    code, said = project.run("python", "--allow-missing=bus")

    assert (code, last(said)) == (0, "1 passed, 0 failed")
    assert "skipped, as allowed: tests/test_1.py::test_that_skips: bus: there is none" in said


def test_a_c_test_that_fails_is_counted(project):
    project.c_tests(one="true", two="false", three="true")

    code, said = project.run("c")

    assert (code, last(said)) == (1, "2 passed, 1 failed")


@pytest.mark.parametrize("stage", ["c", "python"])
def test_a_stage_without_a_test_fails(stage, project):
    project.c_tests()

    code, said = project.run(stage)

    assert (code, last(said)) == (1, "0 passed, 1 failed")


def test_at_the_time_limit_what_has_run_is_counted_and_what_runs_is_named(project):
    project.python_tests(PASSES, PASSES, HANGS)

    code, said = project.run("python", "--time-limit=0.5")

    assert (code, last(said)) == (1, "2 passed, 1 failed")
    assert (
        "stopped: the time limit of 0.5 min was reached (--time-limit) during tests/test_2.py::test_that_hangs\n"
        in said
    )


def test_at_the_time_limit_the_c_tests_are_counted_as_well_and_later_stages_say_why_they_did_not_begin(project):
    project.c_tests(one="true", two="sleep 1000", three="true")
    project.python_tests(PASSES)

    code, said = project.run("c", "python", "--time-limit=0.05")

    assert (code, last(said)) == (1, "1 passed, 2 failed")
    assert "stopped: the time limit of 0.05 min was reached (--time-limit) during ctest two\n" in said
    assert "did not begin: the time limit of 0.05 min was reached" in said


def test_a_stage_in_which_nothing_happens_any_more_is_stopped(project):
    project.c_tests(one="sleep 1.5", two="sleep 1.5", three="sleep 1.5", four="sleep 1000")

    code, said = project.run("c", "--stall-limit=0.05")

    assert (code, last(said)) == (1, "3 passed, 1 failed")
    assert "stopped: no test began or ended for 0.05 min (--stall-limit) during ctest four\n" in said


def test_what_a_stopped_stage_had_started_ends_with_it(project):
    note = project.folder / "pid"
    project.c_tests(one=f"echo $$ >'{note}'; trap '' INT TERM; sleep 1000 & wait")

    project.run("c", "--time-limit=0.05")

    assert soon(lambda: not alive(int(note.read_text())))


def test_ended_from_outside_it_leaves_nothing_behind(project):
    note = project.folder / "pid"
    project.c_tests(one=f"echo $$ >'{note}'; exec sleep 1000")
    process = subprocess.Popen(project.command("c"), stdout=subprocess.DEVNULL)
    assert soon(lambda: note.exists() and note.read_text() != "")
    process.send_signal(signal.SIGTERM)
    process.wait(timeout=30)

    assert soon(lambda: not alive(int(note.read_text())))
