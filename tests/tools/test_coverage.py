"""The measure of branches: the C tests take all but those that have a reason, and one that none takes is seen."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.branch_coverage.measure import Gap, MeasureError, measure  # noqa: E402 - found by the line above
from tools.branch_coverage.reasons import compare, read  # noqa: E402
from tools.reason_table import TableError  # noqa: E402

SOURCE = """int main(int argc, char *argv[])
{
    (void)argv;
    if (argc > 1)
        return 1;
    return 0;
}
"""
ROW = '[[uncovered]]\nfile = "firmware/a.c"\nlines = ["{}"]\nwhy = "{}"\n'
GAP = Gap("firmware/a.c", 4, "if (argc > 1)")


@pytest.fixture
def built(tmp_path):
    """A program built for the measure, with its source where ours are."""
    source, build = tmp_path / "firmware" / "a.c", tmp_path / "build"
    source.parent.mkdir()
    build.mkdir()
    source.write_text(SOURCE)
    subprocess.run(("gcc", "--coverage", "-o", "a", source), cwd=build, check=True)
    return tmp_path


def run(built: Path, *arguments: str) -> None:
    subprocess.run((built / "build" / "a", *arguments), check=False)


def test_each_branch_is_taken_or_has_its_reason():
    result = subprocess.run([ROOT / "tools" / "coverage"], capture_output=True, text=True, check=False)

    assert result.returncode == 0, result.stderr
    assert " 0 complaints" in result.stdout


def test_a_branch_that_is_not_taken_is_a_gap(built):
    run(built)

    measured = measure(built, built / "build")

    assert (measured.branches, measured.taken) == (2, 1)
    assert measured.gaps == [GAP, Gap("firmware/a.c", 5, "return 1;")]


def test_runs_add_up(built):
    run(built)
    run(built, "more")

    assert measure(built, built / "build").gaps == []


def test_a_build_whose_tests_have_not_run_is_an_error(built):
    with pytest.raises(MeasureError, match="no test has left anything"):
        measure(built, built / "build")


@pytest.mark.parametrize(
    ("line", "complaints"),
    [
        ("if (argc > 1)", []),
        ("if (*", []),
        (
            "if",
            [
                "firmware/a.c:4: if (argc > 1): has a branch that no test takes",
                "firmware/a.c: `if` needs no reason any more",
            ],
        ),
    ],
)
def test_a_gap_needs_a_reason_and_a_reason_a_gap(tmp_path, line, complaints):
    table = tmp_path / "table.toml"
    table.write_text(ROW.format(line, "a canary"))

    assert compare([GAP], read(table)) == complaints


@pytest.mark.parametrize("text", [ROW.format("if", " "), "uncovered = 1", "[[uncovered]]\n"])
def test_a_table_with_parts_missing_is_an_error(tmp_path, text):
    table = tmp_path / "table.toml"
    table.write_text(text)

    with pytest.raises(TableError):
        read(table)
