"""tools/test in a project of its own: what it counts, and what it does when time runs out."""

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tests.tools.processes import alive, soon

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.testing import places  # noqa: E402 - as by the next line
from tools.testing.limits import NO_LIMIT, Limits, Steps, run_within, side_by_side  # noqa: E402 - as by the line above

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


@dataclass(frozen=True)
class Until(Limits):
    """A limit that is reached when something has happened, however long that takes."""

    happened: Callable[[], bool] = lambda: True

    def passed(self, quiet_s: float = 0.0) -> str:
        """The limit in words."""
        del quiet_s
        return "it happened" if self.happened() else ""


def until(happened: Callable[[], bool]) -> Until:
    return Until(1.0, 1.0, 0.0, happened)


def run_until(project: Project, name: str, happened: Callable[[], bool]) -> Any:
    """The result of a stage, which is stopped as soon as that has happened."""
    script = project.stages()
    stage = script.c_stage() if name == "c" else script.pytest_stage(name, [], ())
    script.REPORTS.mkdir()
    results: dict[str, Any] = {}
    running = [False]

    def passed() -> bool:
        running[0] = running[0] or happened()  # what has happened stays so
        return running[0]

    def lane() -> Steps[None]:
        results[name] = yield from script.run_stage(stage, (), until(passed), None)

    side_by_side(lane())
    return results[name]


def test_at_a_limit_what_has_run_is_counted_and_what_runs_is_named(project, monkeypatch):
    monkeypatch.setenv("PYTEST_XDIST_AUTO_NUM_WORKERS", "1")
    hangs = project.folder / "hangs"
    project.python_tests(PASSES, PASSES, HANGS.format(note=str(hangs)))

    result = run_until(project, "python", hangs.exists)

    assert (result.verdict, result.passed, result.failed) == ("FAILED", 2, 1)
    assert result.why == "stopped: it happened during tests/test_2.py::test_that_hangs"


def test_at_a_limit_the_c_tests_are_counted_as_well(project):
    hangs = project.folder / "hangs"
    project.c_tests(one="true", two=f"touch '{hangs}'; sleep 1000", three="true")

    result = run_until(project, "c", hangs.exists)

    assert (result.verdict, result.passed, result.failed) == ("FAILED", 1, 1)
    assert result.why == "stopped: it happened during ctest two"


def test_what_a_stopped_stage_had_started_ends_with_it(project):
    note = project.folder / "pid"
    project.c_tests(one=f"echo $$ >'{note}'; trap '' INT TERM; sleep 1000 & wait")

    run_until(project, "c", lambda: note.exists() and note.read_text() != "")

    assert soon(lambda: not alive(int(note.read_text())))


def test_a_stage_that_the_time_limit_leaves_no_time_does_not_begin_and_says_why(project):
    project.c_tests(one="true")

    code, said = project.run("c", "--time-limit=0")

    assert (code, last(said)) == (1, "0 passed, 1 failed")
    assert "did not begin: the time limit of 0 min was reached (--time-limit)" in said


def test_a_stage_in_which_nothing_happens_any_more_is_stopped(project):
    project.c_tests(one="sleep 1000")

    code, said = project.run("c", "--stall-limit=0.02")

    assert (code, last(said)) == (1, "0 passed, 1 failed")
    assert "stopped: no test began or ended for 0.02 min (--stall-limit)" in said


def test_each_test_that_begins_or_ends_begins_the_stall_limit_anew(tmp_path, monkeypatch):
    report, now_s = tmp_path / "report", [0.0]
    monkeypatch.setattr("tools.testing.limits.time.monotonic", lambda: now_s[0])
    steps = run_within(Limits(NO_LIMIT, 1.0, begun=0.0), ["sleep", "1000"], [report])
    next(steps)

    for _ in range(3):
        now_s[0] += 59.0
        with report.open("a") as file:
            file.write("news\n")
        next(steps)

    now_s[0] += 60.0
    with pytest.raises(StopIteration) as ended:
        next(steps)
    assert ended.value.value == (False, "no test began or ended for 1 min (--stall-limit)")


def test_ended_from_outside_it_leaves_nothing_behind(project):
    notes = [project.folder / "c_pid", project.folder / "python_pid"]
    project.c_tests(one=f"echo $$ >'{notes[0]}'; exec sleep 1000")
    project.python_tests(HANGS.format(note=str(notes[1])))
    process = subprocess.Popen(project.command("c", "python"), stdout=subprocess.DEVNULL)
    assert soon(lambda: all(note.exists() and note.read_text() != "" for note in notes))
    process.send_signal(signal.SIGTERM)
    process.wait()

    assert soon(lambda: not any(alive(int(note.read_text())) for note in notes))


def test_other_stages_run_beside_the_python_tests_and_their_output_stays_together(project):
    ended = project.folder / "ended"
    project.c_tests(one=f"touch '{ended}'")
    project.python_tests(WAITS.format(note=str(ended)))

    code, said = project.run("c", "python")

    assert (code, last(said)) == (0, "2 passed, 0 failed")
    assert "\n== c\n" in said
    assert said.index("\n== c\n") < said.index("100% tests passed") < said.index("1 passed in")


def test_a_stage_whose_set_up_fails_is_not_run_and_the_others_are(project):
    project.program("tools/setup", '[[ " $* " != *" python "* ]]')
    project.c_tests(one="true")

    code, said = project.run("c", "python")

    assert (code, last(said)) == (1, "1 passed, 1 failed")
    assert re.search(r"^python +not run", said, re.MULTILINE)
    assert project.run("c", "python", "--allow-missing=python")[0] == 0


def test_each_stage_is_set_up_for_itself_alone(project):
    asked = project.folder / "asked"
    project.program("tools/setup", f"echo \"$@\" >>'{asked}'")
    project.c_tests(one="true")

    project.run("c")

    assert asked.read_text() == "c\n"


def test_a_stage_of_tools_prove_that_cannot_be_set_up_costs_no_other(project):
    project.program("tools/setup", '[[ " $* " != *" eva "* ]]')
    for name in ("test_fuzz", "test_readers"):
        (project.folder / f"tests/proof/{name}.py").parent.mkdir(exist_ok=True)
        (project.folder / f"tests/proof/{name}.py").write_text(PASSES)

    code, said = project.run("eva", "fuzz", tool="prove")

    assert (code, last(said)) == (1, "2 passed, 1 failed")
    assert re.search(r"^eva +not run", said, re.MULTILINE)
    assert project.run("eva", "fuzz", "--allow-missing=eva", tool="prove")[0] == 0


@pytest.mark.parametrize("path", places.named())
def test_what_a_stage_is_to_run_exists(path):
    assert (ROOT / path).exists()


def test_tools_setup_has_each_stage():
    setup = (ROOT / "tools/setup").read_text()
    (proving,) = re.findall(r"^prove_stages=\((.*)\)$", setup, re.MULTILINE)

    assert proving.split() == list(places.PROVE)


def test_each_test_has_one_stage():
    files = [path.relative_to(ROOT).as_posix() for path in (ROOT / "tests").rglob("test_*.py")]
    named = set(places.named())
    stages = {path: [own for own in named if f"{path}/".startswith(f"{own}/")] for path in files if path not in named}

    assert {path: own for path, own in stages.items() if len(own) > 1} == {}


def test_what_tools_prove_names_within_a_folder_of_tools_test_is_left_out_there(project):
    (project.folder / "tests/web").mkdir()
    for name, text in {"browsers": FAILS, "pages": PASSES}.items():
        (project.folder / f"tests/web/test_{name}.py").write_text(text)

    code, said = project.run("web")

    assert (code, last(said)) == (0, "1 passed, 0 failed")
