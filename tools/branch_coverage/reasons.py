"""The table of lines that the C tests need not go through, and whether it fits what they did."""

import importlib
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from tools.branch_coverage.measure import Gap, MeasureError

# Python 3.10 has none of its own.
_toml = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")


@dataclass(frozen=True)
class Reason:
    """Why some lines of a file are not gone through.

    Attributes:
        file: Which file, from the root of the project.
        lines: Their text, without what stands around it; `*` stands for anything.
        why: The reason.
    """

    file: str
    lines: Sequence[str]
    why: str


def read(path: Path) -> list[Reason]:
    """The table in a file.

    Raises:
        MeasureError: It cannot be read, or a row lacks a part.
    """
    try:
        rows = _toml.loads(path.read_text())["uncovered"]
        table = [Reason(row["file"], tuple(row["lines"]), row["why"]) for row in rows]
    except (OSError, _toml.TOMLDecodeError, KeyError, TypeError) as error:
        raise MeasureError(f"cannot read {path}: {error!r}") from error
    if any(not row.why.strip() for row in table):
        raise MeasureError(f"{path}: a row has no reason")
    return table


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
