"""The table of deviations, and whether the findings are what it says."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple

from tools.misra_check.cppcheck import Finding
from tools.reason_table import read_table


class Deviation(NamedTuple):
    """A rule that is not kept; the table says why.

    Attributes:
        rule: Its number.
        where: Patterns of files; `*` also stands for any folders.
    """

    rule: str
    where: Sequence[str]


@dataclass(frozen=True)
class Verdict:
    """How findings and table fit together.

    Attributes:
        complaints: What does not fit, in sentences.
        used: Number of deviations that findings need.
    """

    complaints: Sequence[str]
    used: int


def read(path: Path) -> list[Deviation]:
    """The table in a file.

    Raises:
        TableError: It cannot be read, or a row lacks a part.
    """
    return [Deviation(*row) for row in read_table(path, "deviation", "rule", "where")]


def verdict(found: Iterable[Finding], table: Sequence[Deviation]) -> Verdict:
    """Compares them: each finding is to be named, each pattern to be needed."""
    needed: set[tuple[str, str]] = set()
    complaints = []
    for finding in found:
        patterns = {
            (row.rule, pattern)
            for row in table
            for pattern in row.where
            if row.rule == finding.rule and fnmatch(finding.file, pattern)
        }
        needed |= patterns
        if not patterns:
            complaints.append(f"{finding} is not kept, and no deviation says why")
    complaints += [
        f"rule {row.rule}: no finding in {pattern}; the deviation is not needed any more"
        for row in table
        for pattern in row.where
        if (row.rule, pattern) not in needed
    ]
    return Verdict(complaints, len({rule for rule, _ in needed}))
