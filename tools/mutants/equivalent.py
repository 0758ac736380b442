"""Mutants that no test can kill: those that compile to the same code, and those listed with their reason."""

import subprocess
import tempfile
from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple

from tools.mutants.schemata import Mutant
from tools.mutants.sources import Source
from tools.reason_table import read_table


class Row(NamedTuple):
    """Mutants of a file that the table says are equivalent.

    Attributes:
        file: Which file, from the root of the project.
        changes: What each of them changes; `*` stands for anything.
    """

    file: str
    changes: Sequence[str]


def read(path: Path) -> list[Row]:
    """The table in a file.

    Raises:
        TableError: It cannot be read, or a row lacks a part.
    """
    return [Row(*row) for row in read_table(path, "equivalent", "file", "mutants")]


def is_listed(mutant: Mutant, table: Sequence[Row]) -> bool:
    """Whether the table says that it is equivalent."""
    return any(row.file == mutant.file and _fits(change, mutant) for row in table for change in row.changes)


def unmatched(table: Sequence[Row], mutants: Sequence[Mutant]) -> list[str]:
    """The rows' changes that no mutant makes, in sentences."""
    return [
        f"{row.file}: no mutant is `{change}`"
        for row in table
        for change in row.changes
        if not _any_fits(row, change, mutants)
    ]


def needless(table: Sequence[Row], killed: Sequence[Mutant], alive: Sequence[Mutant]) -> list[str]:
    """The rows' changes that tests do notice, wherever they are made, in sentences."""
    return [
        f"{row.file}: `{change}` is listed as equivalent, but a test kills it"
        for row in table
        for change in row.changes
        if _any_fits(row, change, killed) and not _any_fits(row, change, alive)
    ]


def _any_fits(row: Row, change: str, mutants: Sequence[Mutant]) -> bool:
    return any(row.file == mutant.file and _fits(change, mutant) for mutant in mutants)


def _fits(change: str, mutant: Mutant) -> bool:
    return fnmatchcase(mutant.change, change.replace("[", "[[]"))


class Compiler:
    """Compares code."""

    def __init__(self) -> None:
        self._originals: dict[str, str] = {}

    def same_code(self, source: Source, mutant: Mutant) -> bool:
        """Whether a mutant compiles to the very instructions of its source, with gcc -O2."""
        if source.file not in self._originals:
            self._originals[source.file] = self._code(source, source.text)
        original = self._originals[source.file]
        return original != "" and self._code(source, mutant.apply(source.text)) == original

    def _code(self, source: Source, text: str) -> str:
        """Empty for what does not compile by itself."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, Path(source.file).name)
            path.write_text(text)
            command = ["gcc", "-O2", "-w", "-S", "-o", "-", *source.options, path.name]
            return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False).stdout
