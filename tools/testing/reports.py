"""What tests have said so far, read from files that grow as tests end: a run that is stopped is counted all the same.

pytest's is written by tests/conftest.py (`--progress FILE.jsonl`), ctest's is what it prints.
"""

import json
import re
from collections.abc import Collection, Iterable
from pathlib import Path
from typing import NamedTuple

RUNNING, PASSED, FAILED, SKIPPED = "running", "passed", "failed", "skipped"

_CTEST_BEGINS = re.compile(r" *Start +\d+: (\S+)")
_CTEST_ENDS = re.compile(r" *\d+/\d+ Test +#\d+: (\S+) \.+ *(Passed)?")


class Count(NamedTuple):
    """How tests went.

    Attributes:
        passed: How many passed.
        failed: How many did not, those that were still running not counted.
        allowed: Skipped tests that the caller allowed, with their reasons.
        running: Tests that have begun and not ended.
    """

    passed: int
    failed: int
    allowed: list[str]
    running: list[str]


def count(reports: Iterable[Path], allowed: Collection[str]) -> Count:
    """Counts all tests of some reports; one that is not there has none.

    Args:
        reports: Files as named above.
        allowed: Words before the colon in a skip's reason that make it no failure.
    """
    state: dict[str, str] = {}
    reasons: dict[str, str] = {}
    for report in (report for report in reports if report.exists()):
        lines = report.read_text(errors="replace").splitlines()
        for event, test, reason in _pytest(lines) if report.suffix == ".jsonl" else _ctest(lines):
            if state.get(test) != FAILED:
                state[test] = event
                reasons[test] = reason
    skipped = [test for test, said in state.items() if said == SKIPPED]
    fine = [test for test in skipped if reasons[test].split(":")[0] in allowed]
    said = list(state.values())
    return Count(
        passed=said.count(PASSED),
        failed=said.count(FAILED) + len(skipped) - len(fine),
        allowed=[f"{test}: {reasons[test]}" for test in fine],
        running=[test for test, said in state.items() if said == RUNNING],
    )


def _pytest(lines: Iterable[str]) -> Iterable[tuple[str, str, str]]:
    for line in lines:
        try:
            event, test, reason = json.loads(line)
        except ValueError:
            continue  # cut short
        yield event, test, reason


def _ctest(lines: Iterable[str]) -> Iterable[tuple[str, str, str]]:
    for line in lines:
        if begins := _CTEST_BEGINS.match(line):
            yield RUNNING, f"ctest {begins[1]}", ""
        elif ends := _CTEST_ENDS.match(line):
            yield PASSED if ends[2] else FAILED, f"ctest {ends[1]}", ""
