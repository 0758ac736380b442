"""Coverage of the tests: each gap has a reason, and each kind of gap is found."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.tools.project import script_named
from tools.verify.command import VerifyError, compare, read
from tools.verify.coverage import CLANG, COPY, FLAGS, NOT_MEASURED, Gap, measure, measure_python, python_gaps

ROOT = Path(__file__).resolve().parents[2]

# Its argument gives a, b and c: "100" for a true and the others false.
SOURCE = """int main(int argc, char *argv[])
{
    const char *told = argv[argc - 1];
    if ((told[0] == '1' && told[1] == '1') || told[2] == '1')
        return 1;
    return 0;
}
"""
A, B, C = (f"told[{i}] == '1'" for i in range(3))
ENOUGH = ("000", "100", "110", "001")
ROW = '[["firmware/a.c"]]\nwhat = ["{}"]\nwhy = "{}"\n'
GAP = Gap("firmware/a.c", 4, f"never true: {B}")


@pytest.fixture
def built(tmp_path):
    """A program built with coverage, its source in the place of ours."""
    source, build = tmp_path / "firmware" / "a.c", tmp_path / "build"
    source.parent.mkdir()
    build.mkdir()
    source.write_text(SOURCE)
    subprocess.run((CLANG, *FLAGS, "-o", "test_a", source), cwd=build, check=True)
    return tmp_path


def missing_after(built: Path, *runs: str) -> list[str]:
    for run in runs:
        environment = {"LLVM_PROFILE_FILE": str(built / "build" / f"{run}.profraw")}
        subprocess.run((built / "build" / "test_a", run), check=False, env=environment)
    return [f"{gap.line}: {gap.what}" for gap in measure(built, built / "build").gaps]


def test_c_code_is_covered_or_has_a_reason():
    result = subprocess.run([ROOT / "tools" / "coverage"], capture_output=True, text=True, check=False)

    assert result.returncode == 0, result.stderr
    assert "\n0 complaints" in result.stdout


def test_runs_that_cover_all_conditions_leave_no_gap(built):
    assert missing_after(built, *ENOUGH) == []


@pytest.mark.parametrize(
    ("runs", "missing"),
    [
        (
            ("000",),
            [f"4: never reached: {B}", f"4: never true: {A}", f"4: never true: {C}", "5: never reached: return 1;"],
        ),
        (("000", "100", "001"), [f"4: never decides: {A}", f"4: never true: {B}"]),
        (("000", "110", "001"), [f"4: never false: {B}"]),
        (("000", "101", "110", "001"), [f"4: never decides: {B}"]),
    ],
)
def test_uncovered_condition_is_a_gap(built, runs, missing):
    assert missing_after(built, *runs) == missing


@pytest.mark.parametrize(
    ("prefix", "missing"), [(COPY, []), ("other_", ["10: never reached: void other_step(void)"])]
)
def test_copy_of_the_core_under_its_prefix_leaves_no_gap(built, prefix, missing):
    source = built / "firmware" / "a.c"
    source.write_text(f"{SOURCE}void {prefix}step(void);\nvoid {prefix}step(void)\n{{\n}}\n")
    subprocess.run((CLANG, *FLAGS, "-o", "test_a", source), cwd=built / "build", check=True)

    assert missing_after(built, *ENOUGH) == missing


def test_coverage_of_several_runs_adds_up(built):
    for run in ENOUGH[:-1]:
        assert missing_after(built, run) != []
    assert missing_after(built, ENOUGH[-1]) == []


def test_totals_count_all_conditions(built):
    missing_after(built, "000", "110")
    totals = measure(built, built / "build").totals

    assert [(totals[kind]["count"], totals[kind]["covered"]) for kind in ("branches", "mcdc")] == [(6, 4), (3, 1)]


def test_build_whose_tests_have_not_run_is_an_error(built):
    with pytest.raises(VerifyError, match="no test has left coverage data"):
        measure(built, built / "build")


def test_unmeasurable_decision_is_reported(tmp_path):
    source = tmp_path / "a.c"
    source.write_text("int is(int x);\nint a(int x, int y) { return x && is(x && y); }\n")

    said = subprocess.run(
        (CLANG, *FLAGS, "-c", source), cwd=tmp_path, capture_output=True, text=True, check=True
    ).stderr

    assert NOT_MEASURED in said


def test_failed_build_is_removed_so_that_it_warns_again(tmp_path, monkeypatch):
    script = script_named("coverage")
    monkeypatch.setattr(script, "BUILD", tmp_path / "coverage")

    def output_of(*words: object) -> str:
        script.BUILD.mkdir(exist_ok=True)
        if "--build" in words:
            raise VerifyError("another file does not compile")
        return ""

    monkeypatch.setattr(script.command, "output_of", output_of)
    with pytest.raises(VerifyError, match="another file"):
        script.build()

    assert not script.BUILD.exists()


@pytest.mark.parametrize(
    ("text", "complaints"),
    [
        (f"never true: {B}", []),
        ("never *: told[1] *", []),
        (
            "never",
            [
                f"firmware/a.c:4: never true: {B}: not allowed by the table",
                "firmware/a.c: `never` is not found any more",
            ],
        ),
    ],
)
def test_gap_needs_a_reason_and_a_reason_a_gap(tmp_path, text, complaints):
    table = tmp_path / "table.toml"
    table.write_text(ROW.format(text, "a canary"))

    assert compare([GAP], read(table)) == complaints


PYTHON_SOURCE = """def sign(number: int) -> int:
    if number < 0:
        number = -1
    if number == 0:  # pragma: no cover
        return 0
    return number
"""
TEST = "from package.sign import sign\n\n\ndef test_sign() -> None:\n    assert [sign(n) for n in {}] == {}\n"


def measured(folder: Path, numbers: list[int], expected: list[int]) -> tuple[dict, str]:
    """A package with one function, whose test calls it with some numbers."""
    for name, text in {"package/sign.py": PYTHON_SOURCE, "test_sign.py": TEST.format(numbers, expected)}.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    (folder / "measure").mkdir()
    return measure_python(folder, Path(sys.executable), ["package"], ["test_sign.py"], folder / "measure")


def test_python_code_is_covered_or_has_a_reason():
    command = [ROOT / "tools" / "coverage", "python", "--gate"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)

    assert result.returncode == 0, result.stderr
    assert "\n0 complaints" in result.stdout


def test_each_name_left_out_of_the_measurement_is_that_of_a_test():
    script = script_named("coverage")
    folders = (folder for folder in script.PYTHON_GATE_TESTS if folder.startswith("tests/"))
    texts = [path.read_text() for folder in folders for path in (ROOT / folder).glob("test_*.py")]

    for name in script.PYTHON_SLOW:
        assert any(re.search(rf"def test_\w*{name}", text) for text in texts), name


def test_tests_that_take_every_branch_leave_no_gap(tmp_path):
    files, table = measured(tmp_path, [-5, 0, 1], [-1, 0, 1])

    assert python_gaps(tmp_path, files) == []
    assert table.split("TOTAL")[1].split()[:5] == ["6", "0", "4", "0", "100%"]


def test_untaken_branch_or_line_is_a_gap_despite_a_comment(tmp_path):
    files, _ = measured(tmp_path, [-5], [-1])

    assert [str(gap) for gap in python_gaps(tmp_path, files)] == [
        "package/sign.py:2: never from: if number < 0: on to: if number == 0:  # pragma: no cover",
        "package/sign.py:5: never reached: return 0",
    ]


def test_failing_test_is_reported(tmp_path):
    with pytest.raises(VerifyError, match="coverage run failed"):
        measured(tmp_path, [1], [2])
