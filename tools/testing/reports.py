"""Counts test results in reports that grow as tests end, so that a stopped run is counted, too.

The report of pytest is written by tests/conftest.py (`--progress FILE.jsonl`); that of ctest is its output.
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
    """Test results.

    Attributes:
        passed: Number that passed.
        failed: Number that failed, or were skipped and not allowed; without those still running.
        allowed: Skipped tests that the caller allowed, with their reasons.
        running: Tests that have begun and not ended.
    """

    passed: int
    failed: int
    allowed: list[str]
    running: list[str]


def count(reports: Iterable[Path], allowed: Collection[str]) -> Count:
    """Counts the tests in some reports; a missing report has none.

    Args:
        reports: Files in the formats named above.
        allowed: Words before the colon in the reasons of accepted skips.
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
