"""The table of mutants that do the same: what it lists, what it should not, and what the score leaves out."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.tools.mutants_of_text import TEXT, mutants  # noqa: E402 - found by the line above
from tools.verify.command import VerifyError  # noqa: E402
from tools.verify.exceptions import is_covered, read  # noqa: E402
from tools.verify.mutants.equivalent import needless, unmatched  # noqa: E402
from tools.verify.mutants.verdicts import Verdict, scores  # noqa: E402

ROW = '[["firmware/a.c"]]\nwhat = ["{}"]\nwhy = "{}"\n'


@pytest.mark.parametrize(
    ("change", "listed", "unknown"),
    [
        ("return x < 3; -> return x <= 3;", 1, []),
        ("return x < 3; -> *;", 4, []),
        ("return x < 3; -> *", 4, ["firmware/a.c: `return x < 3; -> *` would excuse any: name the mutants"]),
        ("return x -> return x", 0, ["firmware/a.c: no mutant is `return x -> return x`"]),
    ],
)
def test_a_mutant_is_listed_by_what_it_changes(tmp_path, change, listed, unknown):
    found, _ = mutants(tmp_path, TEXT)
    table = tmp_path / "table.toml"
    table.write_text(ROW.format(change, "a canary"))
    rows = read(table)

    assert sum(is_covered(mutant, rows) for mutant in found) == listed
    assert unmatched(rows, found) == unknown


def test_a_listed_mutant_that_is_killed_is_an_error(tmp_path):
    found, _ = mutants(tmp_path, TEXT)
    table = tmp_path / "table.toml"
    table.write_text(ROW.format(found[0].what, "a canary"))
    complaint = f"firmware/a.c: `{found[0].what}` is listed as equivalent, but a test kills it"

    assert needless(read(table), found, []) == [complaint]
    assert needless(read(table), found[1:], found[:1]) == []


@pytest.mark.parametrize("text", [ROW.format("a -> b", " "), "exception = 1", "[[exception]]\n"])
def test_a_table_with_parts_missing_is_an_error(tmp_path, text):
    table = tmp_path / "table.toml"
    table.write_text(text)

    with pytest.raises(VerifyError):
        read(table)


def test_a_score_leaves_out_what_nobody_can_kill(tmp_path):
    found, _ = mutants(tmp_path, TEXT)
    verdicts = zip(found, [Verdict.KILLED, Verdict.SAME_CODE, Verdict.LISTED, Verdict.ALIVE], strict=True)

    (score,) = scores(list(verdicts))

    assert (score.group.name, score.percent, score.is_enough) == ("core", 50.0, False)
