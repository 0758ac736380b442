"""What the Python tests show: in the packages of the gate, all but what has a reason; and what none shows is seen."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.verify.command import VerifyError  # noqa: E402 - found by the line above
from tools.verify.coverage.python_tests import measure_python, python_gaps, sums  # noqa: E402

SOURCE = """def sign(number: int) -> int:
    if number < 0:
        number = -1
    if number == 0:  # pragma: no cover
        return 0
    return number
"""
TEST = "from package.sign import sign\n\n\ndef test_sign() -> None:\n    assert [sign(n) for n in {}] == {}\n"


def measured(folder: Path, numbers: list[int], expected: list[int]) -> dict:
    """A package with one function, whose test calls it with some numbers."""
    for name, text in {"package/sign.py": SOURCE, "test_sign.py": TEST.format(numbers, expected)}.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    (folder / "measure").mkdir()
    return measure_python(folder, Path(sys.executable), ["package"], ["test_sign.py"], folder / "measure")


def test_all_is_taken_or_has_its_reason():
    command = [ROOT / "tools" / "coverage", "python", "--gate"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)

    assert result.returncode == 0, result.stderr
    assert "\n0 complaints" in result.stdout


def test_tests_that_take_every_branch_leave_no_gap(tmp_path):
    files = measured(tmp_path, [-5, 0, 1], [-1, 0, 1])

    assert python_gaps(tmp_path, files) == []
    assert str(sums(files)["package"]) == "6 of 6 lines, 4 of 4 branches"


def test_a_branch_or_a_line_that_no_test_takes_is_a_gap_even_if_a_comment_excuses_it(tmp_path):
    files = measured(tmp_path, [-5], [-1])

    assert [str(gap) for gap in python_gaps(tmp_path, files)] == [
        "package/sign.py:2: never from: if number < 0: on to: if number == 0:  # pragma: no cover",
        "package/sign.py:5: never reached: return 0",
    ]


def test_a_failing_test_is_reported(tmp_path):
    with pytest.raises(VerifyError, match="coverage run failed"):
        measured(tmp_path, [1], [2])
