"""Tables of exceptions: findings that a check permits, each with its reason. All have this format.

[["firmware/brain.c"]]             # a file; * stands for anything
what = ["never true: default"]     # what is found there, one or several; * stands for anything
why = "A reason."

[[exception]]
in = ["firmware/*", "hal/*"]       # several files
"""

from collections.abc import Sequence
from fnmatch import fnmatchcase
from itertools import product
from pathlib import Path
from typing import NamedTuple, Protocol

from host_sim.base.toml_file import parse_toml
from tools.verify.command import VerifyError


class Finding(Protocol):
    """A finding of a check."""

    @property
    def file(self) -> str:
        """Its file, relative to the project's root."""

    @property
    def what(self) -> str:
        """Its description, as tables name it."""


class Permit(NamedTuple):
    """A permitted finding; `*` matches anything.

    Attributes:
        file: Pattern of the file.
        what: Pattern of the description.
    """

    file: str
    what: str

    def covers(self, finding: Finding) -> bool:
        """Whether it permits a finding."""
        return _fits(finding.file, self.file) and _fits(finding.what, self.what)

    def __str__(self) -> str:
        return f"{self.file}: `{self.what}`"


def read(path: Path) -> list[Permit]:
    """Reads the exceptions of a table.

    Raises:
        VerifyError: The table cannot be read, or an exception lacks a part.
    """
    try:
        table = parse_toml(path.read_text())
        rows = [{"in": name, **row} for name, rows in table.items() for row in rows]
        parts = [(_several(row["in"]), _several(row["what"]), row["why"].strip()) for row in rows]
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise VerifyError(f"cannot read {path}: {error!r}") from error
    for files, texts, why in parts:
        if not (files and texts and why):
            raise VerifyError(f"{path}: an exception in {files} lacks `in`, `what` or `why`")
    return [Permit(*each) for files, texts, _ in parts for each in product(files, texts)]


def compare(findings: Sequence[Finding], table: Sequence[Permit]) -> list[str]:
    """Complaints, in sentences: findings that are not permitted, and entries that match no finding."""
    complaints = [f"{it}: not allowed by the table" for it in findings if not is_covered(it, table)]
    return complaints + [f"{permit} is not found any more" for permit in uncovering(table, findings)]


def is_covered(finding: Finding, table: Sequence[Permit]) -> bool:
    """Whether a table permits a finding."""
    return any(permit.covers(finding) for permit in table)


def uncovering(table: Sequence[Permit], findings: Sequence[Finding]) -> list[Permit]:
    """The entries of a table that match none of these findings."""
    return [permit for permit in table if not any(map(permit.covers, findings))]


def _several(value: str | list[str]) -> list[str]:
    return [value] if isinstance(value, str) else list(map(str, value))


def _fits(text: str, pattern: str) -> bool:
    return fnmatchcase(text, pattern.replace("[", "[[]"))
