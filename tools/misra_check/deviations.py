"""The table of deviations, and whether the findings are what it says."""

import importlib
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

from tools.misra_check.commands import CheckError
from tools.misra_check.cppcheck import Finding

# Python 3.10 has none of its own.
_toml = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")


@dataclass(frozen=True)
class Deviation:
    """A rule that is not kept.

    Attributes:
        rule: Its number.
        where: Patterns of files; `*` also stands for any folders.
        why: The reason.
    """

    rule: str
    where: Sequence[str]
    why: str


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
        CheckError: It cannot be read, or a row lacks a part.
    """
    try:
        rows = _toml.loads(path.read_text())["deviation"]
        table = [Deviation(row["rule"], tuple(row["where"]), row["why"]) for row in rows]
    except (OSError, _toml.TOMLDecodeError, KeyError, TypeError) as error:
        raise CheckError(f"cannot read {path}: {error!r}") from error
    for row in table:
        if not row.why.strip() or not row.where:
            raise CheckError(f"{path}: rule {row.rule} has no reason or no files")
    return table


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
