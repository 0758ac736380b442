"""The table of what the C tests need not show, and whether it fits what they did."""

from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple

from tools.branch_coverage.measure import Gap
from tools.reason_table import read_table


class Reason(NamedTuple):
    """Some gaps of a file that the table has a reason for.

    Attributes:
        file: Which file, from the root of the project.
        gaps: Their text, as `Gap` has it; `*` stands for anything.
    """

    file: str
    gaps: Sequence[str]


def read(path: Path) -> list[Reason]:
    """The table in a file.

    Raises:
        TableError: It cannot be read, or a row lacks a part.
    """
    return [Reason(*row) for row in read_table(path, "uncovered", "file", "gaps")]


def compare(gaps: Sequence[Gap], table: Sequence[Reason]) -> list[str]:
    """What does not fit, in sentences: a gap without a reason, a reason without a gap."""
    complaints = [
        f"{gap}: no test shows it"
        for gap in gaps
        if not any(_covers(row, text, gap) for row in table for text in row.gaps)
    ]
    complaints += [
        f"{row.file}: `{text}` needs no reason any more"
        for row in table
        for text in row.gaps
        if not any(_covers(row, text, gap) for gap in gaps)
    ]
    return complaints


def _covers(row: Reason, text: str, gap: Gap) -> bool:
    escaped = text.replace("[", "[[]")
    return row.file == gap.file and fnmatchcase(gap.text, escaped)
