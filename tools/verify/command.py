"""Common parts of the verification commands: errors, argument parser, exit codes, subprocesses, exceptions.

Tables of exceptions, findings that a check permits, all have this format:

[["firmware/brain.c"]]             # a file; * stands for anything
what = ["never true: default"]     # what is found there, one or several; * stands for anything
why = "A reason."

[[exception]]
in = ["firmware/*", "hal/*"]       # several files
"""

import argparse
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from fnmatch import fnmatchcase
from itertools import product
from pathlib import Path
from typing import NamedTuple, Protocol

from host_sim.base.toml_file import parse_toml

OUTPUT_MAX = 4000


class VerifyError(Exception):
    """The check cannot be made; the message says why."""


class ChoiceError(VerifyError):
    """The requested item does not exist."""


def parser(name: str, description: str | None) -> argparse.ArgumentParser:
    """The argument parser of the command tools/NAME."""
    return argparse.ArgumentParser(
        prog=f"tools/{name}", description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )


def run(name: str, check: Callable[[], Sequence[str]]) -> int:
    """Runs a check and prints its complaints; returns the exit code: 0, 1 for complaints, 2 for a wrong request."""
    code = 1
    try:
        complaints = check()
    except VerifyError as error:
        complaints = [str(error)]
        code = 2 if isinstance(error, ChoiceError) else 1
    sys.stderr.writelines(f"{name}: {complaint}\n" for complaint in complaints)
    return code if complaints else 0


def output_of(*command: object, env: Mapping[str, str] | None = None) -> str:
    """Runs a program and returns its standard output.

    Args:
        command: Program and arguments.
        env: Environment; None for this process's.

    Raises:
        VerifyError: The program is missing or fails; the message ends with its last output.
    """
    words = [str(word) for word in command]
    try:
        result = subprocess.run(words, capture_output=True, text=True, check=False, env=env)
    except OSError as reason:
        raise VerifyError(f"cannot run {words[0]}: {reason}; tools/setup tests installs it") from reason
    if result.returncode != 0:
        raise VerifyError(f"{' '.join(words[:3])} failed:\n{(result.stdout + result.stderr)[-OUTPUT_MAX:]}")
    return result.stdout


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
