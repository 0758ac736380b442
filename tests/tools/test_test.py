"""tools/test in a project of its own: what it counts, and the tests of each stage."""

import re
import signal
import sys
import time
from pathlib import Path

import pytest

from tests.tools.project import BROKEN, ENDS, FAILS, PASSES, ROOT, SKIPS, TEARDOWN_FAILS, WAITS, Project, last

sys.path.insert(0, str(ROOT))

from tools.testing import stage_paths


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


@pytest.mark.parametrize(
    ("python", "c", "stages", "counted"),
    [
        ([PASSES, PASSES, PASSES], {"one": "true", "two": "true"}, ["c", "python"], (0, "5 passed, 0 failed")),
        ([PASSES, FAILS, SKIPS, TEARDOWN_FAILS], {}, ["python"], (1, "1 passed, 3 failed")),
        ([], {"one": "true", "two": "false", "three": "true"}, ["c"], (1, "2 passed, 1 failed")),
        ([], {}, ["c"], (1, "0 passed, 1 failed")),
        ([], {}, ["python"], (1, "0 passed, 1 failed")),
    ],
    ids=["all passed", "failed and skipped", "in C", "no test in C", "no test in Python"],
)
def test_tests_are_counted_and_those_skipped_or_missing_have_failed(project, python, c, stages, counted):
    project.python_tests(*python)
    project.c_tests(**c)

    code, said = project.run(*stages)

    assert (code, last(said)) == counted


def test_broken_test_file_is_counted_as_failed(project):
    project.python_tests(PASSES, BROKEN)

    code, said = project.run("python")

    assert code == 1
    assert last(said).endswith(", 1 failed")


def test_allowed_skip_is_named(project):
    project.python_tests(PASSES, SKIPS)

    code, said = project.run("python", "--allow-missing=bus")

    assert (code, last(said)) == (0, "1 passed, 0 failed")
    assert "skipped, as allowed: tests/test_1.py::test_that_skips: bus: there is none" in said


def test_exit_during_a_test_as_if_all_were_well_fails_the_stage(project):
    project.python_tests(PASSES, ENDS, PASSES)
    script = project.stages()
    report = script.REPORTS / "bus.jsonl"
    report.parent.mkdir()
    stage = script.Stage("bus", "bus", [script.pytest_command(report, (), ())], [report])
    results = {}

    def lane():
        results["bus"] = yield from script.run_stage(stage, (), script.Limits(1, 1, time.monotonic()), None)

    script.side_by_side(lane())

    assert (results["bus"].verdict, results["bus"].passed, results["bus"].failed) == ("FAILED", 1, 1)


def test_stage_whose_tests_are_only_collected_fails(project, monkeypatch):
    monkeypatch.setenv("PYTEST_ADDOPTS", "--collect-only")
    project.python_tests(PASSES)

    code, said = project.run("python")

    assert (code, last(said)) == (1, "0 passed, 1 failed")


def test_stages_beside_the_python_tests_keep_their_output_together(project):
    ended = project.folder / "ended"
    project.c_tests(one=f"touch '{ended}'")
    project.python_tests(WAITS.format(note=str(ended)))

    code, said = project.run("c", "python")

    assert (code, last(said)) == (0, "2 passed, 0 failed")
    assert "\n== c\n" in said
    assert said.index("\n== c\n") < said.index("100% tests passed") < said.index("1 passed in")


def test_stage_whose_setup_fails_is_not_run_and_the_others_are(project):
    project.program("tools/setup", '[[ " $* " != *" python "* ]]')
    project.c_tests(one="true")

    code, said = project.run("c", "python")

    assert (code, last(said)) == (1, "1 passed, 1 failed")
    assert re.search(r"^python +not run", said, re.MULTILINE)
    assert project.run("c", "python", "--allow-missing=python")[0] == 0


def test_repeated_runs_are_counted_and_those_that_failed_are_numbered(project):
    once = project.folder / "once"
    project.c_tests(one=f"[ ! -e '{once}' ] && touch '{once}'")

    code, said = project.run("c", "--repeat=3", "--beside=1")

    assert (code, last(said)) == (1, "1 of 3 runs passed; failed: 2, 3")


def test_busy_loops_end_with_the_runs_beside_them(project):
    with project.stages().busy(2) as loops:
        assert [loop.poll() for loop in loops] == [None, None]

    assert [loop.returncode for loop in loops] == [-signal.SIGKILL] * 2


def test_setup_is_called_only_for_the_requested_stage(project):
    asked = project.folder / "asked"
    project.program("tools/setup", f"echo \"$@\" >>'{asked}'")
    project.c_tests(one="true")

    project.run("c")

    assert asked.read_text() == "c\n"


def test_stage_of_prove_whose_setup_fails_stops_no_other(project):
    project.program("tools/setup", '[[ " $* " != *" eva "* ]]')
    test = project.folder / "tests/proof/test_fuzz.py"
    test.parent.mkdir(exist_ok=True)
    test.write_text(PASSES)

    code, said = project.run("eva", "fuzz", tool="prove")

    assert (code, last(said)) == (1, "1 passed, 1 failed")
    assert re.search(r"^eva +not run", said, re.MULTILINE)
    assert project.run("eva", "fuzz", "--allow-missing=eva", tool="prove")[0] == 0


def test_stages_of_prove_run_beside_a_long_one(project):
    ended = project.folder / "ended"
    notes = f"import pathlib\ndef test_that_notes():\n    pathlib.Path({str(ended)!r}).touch()\n"
    for folder, text in {"campaign": WAITS.format(note=str(ended)), "study": PASSES, "export": notes}.items():
        path = project.folder / f"tests/lab/{folder}/test_it.py"
        path.parent.mkdir(parents=True)
        path.write_text(text)

    code, said = project.run("campaign", "studies", "formats", tool="prove")

    assert (code, last(said)) == (0, "3 passed, 0 failed")


@pytest.mark.parametrize("path", stage_paths.named())
def test_path_of_a_stage_exists(path):
    assert (ROOT / path).exists()


def test_tools_setup_has_each_stage():
    setup = (ROOT / "tools/setup").read_text()
    (proving,) = re.findall(r"^  \[prove\]='(.*)'$", setup, re.MULTILINE)

    assert proving.split() == list(stage_paths.PROVE)


def test_test_files_belong_to_one_stage_each():
    files = [path.relative_to(ROOT).as_posix() for path in (ROOT / "tests").rglob("test_*.py")]
    named = set(stage_paths.named())
    assert len(named) == len(stage_paths.named())
    stages = {path: [own for own in named if f"{path}/".startswith(f"{own}/")] for path in files if path not in named}

    assert {path: own for path, own in stages.items() if len(own) > 1} == {}


def test_path_of_another_stage_is_left_out_of_a_folder(project):
    project.program(".venv/bin/mypy", "exit 0")
    files = {"web/test_browsers": FAILS, "web/test_pages": PASSES, "report/test_laboratory": PASSES}
    for name, text in files.items():
        path = project.folder / f"tests/{name}.py"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)

    code, said = project.run("web", tool="prove")

    assert (code, last(said)) == (0, "2 passed, 0 failed")
