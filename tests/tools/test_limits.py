"""tools/test in a project of its own, when time runs out or it is terminated."""

import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from tests.tools.project import HANGS, PASSES, ROOT, Project, alive, last, soon
from tools.testing.limits import NO_LIMIT, Limits, Steps, run_within, side_by_side

sys.path.insert(0, str(ROOT))


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


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
        running[0] = running[0] or happened()  # stays true
        return running[0]

    def lane() -> Steps[None]:
        results[name] = yield from script.run_stage(stage, (), until(passed), None)

    side_by_side(lane())
    return results[name]


def test_stage_at_a_limit_counts_its_tests_and_names_the_running_one(project, monkeypatch):
    monkeypatch.setenv("PYTEST_XDIST_AUTO_NUM_WORKERS", "1")
    hangs = project.folder / "hangs"
    project.python_tests(PASSES, PASSES, HANGS.format(note=str(hangs)))

    result = run_until(project, "python", hangs.exists)

    assert (result.verdict, result.passed, result.failed) == ("FAILED", 2, 1)
    assert result.why == "stopped: it happened during tests/test_2.py::test_that_hangs"


def test_c_stage_stopped_at_a_limit_counts_its_tests(project):
    report = project.folder / "build/reports/c.log"
    project.c_tests(one="true", two="sleep 1000", three="true")

    result = run_until(project, "c", lambda: report.exists() and ": two" in report.read_text())

    assert (result.verdict, result.passed, result.failed) == ("FAILED", 1, 1)
    assert result.why == "stopped: it happened during ctest two"


def test_stopping_a_stage_ends_its_processes(project):
    note = project.folder / "pid"
    project.c_tests(one=f"echo $$ >'{note}'; trap '' INT TERM; sleep 1000 & wait")

    run_until(project, "c", lambda: note.exists() and note.read_text() != "")

    assert soon(lambda: not alive(int(note.read_text())))


@pytest.mark.parametrize(
    ("limit", "why"),
    [
        ("--time-limit=0", "did not begin: the time limit of 0 min was reached (--time-limit)"),
        ("--stall-limit=0.02", "stopped: no test began or ended for 0.02 min (--stall-limit)"),
    ],
)
def test_stage_that_a_limit_stops_says_why(project, limit, why):
    project.c_tests(one="sleep 1000")

    code, said = project.run("c", limit)

    assert (code, last(said)) == (1, "0 passed, 1 failed")
    assert why in said


def test_begin_or_end_of_a_test_restarts_the_stall_limit(tmp_path, monkeypatch):
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


def test_terminated_run_leaves_no_process_behind(project):
    notes = [project.folder / "c_pid", project.folder / "python_pid"]
    project.c_tests(one=f"echo $$ >'{notes[0]}'; exec sleep 1000")
    project.python_tests(HANGS.format(note=str(notes[1])))
    process = subprocess.Popen(project.command("c", "python"), stdout=subprocess.DEVNULL)
    assert soon(lambda: all(note.exists() and note.read_text() != "" for note in notes))
    process.send_signal(signal.SIGTERM)
    process.wait()

    assert soon(lambda: not any(alive(int(note.read_text())) for note in notes))


@pytest.mark.parametrize("tool", ["test", "prove"])
def test_second_run_in_a_checkout_is_refused_and_the_first_goes_on(project, tool):
    note, leave = project.folder / "pid", project.folder / "leave"
    project.c_tests(one=f"echo $$ >'{note}'; until [ -e '{leave}' ]; do sleep 0.05; done")
    first = subprocess.Popen(project.command("c"), stdout=subprocess.PIPE, text=True)
    assert soon(note.exists)

    words = project.command("fuzz" if tool == "prove" else "c", tool=tool)
    second = subprocess.run(words, capture_output=True, text=True, check=False)
    leave.touch()

    assert (second.returncode, second.stdout) == (2, "")
    assert second.stderr.endswith(f"tools/{tool}: error: tools/test or tools/prove is running in this checkout\n")
    assert last(first.communicate()[0]) == "1 passed, 0 failed"


CONFTEST = Path(__file__).resolve().parents[1] / "conftest.py"
SKIPS = {
    "in a test": "import pytest\ndef test_it():\n    pytest.skip('bus: there is none')\n",
    "in a fixture": (
        "import pytest\n@pytest.fixture\ndef bus():\n    pytest.skip('bus: there is none')\n"
        "def test_it(bus):\n    pass\n"
    ),
    "by a mark": "import pytest\n@pytest.mark.skip(reason='bus: there is none')\ndef test_it():\n    pass\n",
}
SKIPPED_FILE = "import pytest\npytest.skip('bus: there is none', allow_module_level=True)\n"
EXPECTED_FAILURES = {
    "run": "import pytest\n@pytest.mark.xfail(reason='bus: known')\ndef test_it():\n    assert 0\n",
    "not run": "import pytest\n@pytest.mark.xfail(run=False, reason='bus: known')\ndef test_it():\n    pass\n",
    "at run time": "import pytest\ndef test_it():\n    pytest.xfail('bus: known')\n",
}


def run_pytest(folder: Path, tests: Iterable[str], *options: str) -> subprocess.CompletedProcess[str]:
    """Runs tests, each in a file of its own."""
    shutil.copy(CONFTEST, folder)
    for number, test in enumerate(tests):
        (folder / f"test_{number}.py").write_text(test)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--rootdir={folder}", *options, "."]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_skipped_test_fails_the_run_and_is_named(tmp_path):
    done = run_pytest(tmp_path, [*SKIPS.values(), PASSES])

    assert done.returncode != 0
    assert done.stdout.splitlines()[-1].startswith("1 failed, 1 passed, 2 errors in")
    assert done.stdout.count("skipped, which counts as failed: bus: there is none") >= len(SKIPS)


def test_skipped_file_fails_the_run_and_is_named(tmp_path):
    done = run_pytest(tmp_path, [SKIPPED_FILE])

    assert done.returncode != 0
    assert "skipped, which counts as failed: bus: there is none" in done.stdout


def test_allowed_skip_does_not_fail_the_run(tmp_path):
    done = run_pytest(tmp_path, [*SKIPS.values(), SKIPPED_FILE, PASSES], "--allow-missing=bus")

    assert done.returncode == 0
    assert f"1 passed, {len(SKIPS) + 1} skipped" in done.stdout


def test_allowed_name_allows_no_other(tmp_path):
    assert run_pytest(tmp_path, [SKIPS["in a test"]], "--allow-missing=browser").returncode != 0


def test_expected_failure_fails_the_run_whatever_is_allowed(tmp_path):
    done = run_pytest(tmp_path, [*EXPECTED_FAILURES.values(), PASSES], "--allow-missing=bus")

    assert done.stdout.splitlines()[-1].startswith("2 failed, 1 passed, 1 error in")
    assert "skipped, which counts as failed: xfail: " in done.stdout
