"""The table of lines that the C tests need not go through, and whether it fits what they did."""

from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple

from tools.branch_coverage.measure import Gap
from tools.reason_table import read_table


class Reason(NamedTuple):
    """Why some lines of a file are not gone through: the table says it.

    Attributes:
        file: Which file, from the root of the project.
        lines: Their text, without what stands around it; `*` stands for anything.
    """

    file: str
    lines: Sequence[str]


def read(path: Path) -> list[Reason]:
    """The table in a file.

    Raises:
        TableError: It cannot be read, or a row lacks a part.
    """
    return [Reason(*row) for row in read_table(path, "uncovered", "file", "lines")]


def compare(gaps: Sequence[Gap], table: Sequence[Reason]) -> list[str]:
    """What does not fit, in sentences: a gap without a reason, a reason without a gap."""
    complaints = [
        f"{gap}: has a branch that no test takes"
        for gap in gaps
        if not any(_covers(row, line, gap) for row in table for line in row.lines)
    ]
    complaints += [
        f"{row.file}: `{line}` needs no reason any more"
        for row in table
        for line in row.lines
        if not any(_covers(row, line, gap) for gap in gaps)
    ]
    return complaints


def _covers(row: Reason, line: str, gap: Gap) -> bool:
    escaped = line.replace("[", "[[]")
    return row.file == gap.file and fnmatchcase(gap.text, escaped)
