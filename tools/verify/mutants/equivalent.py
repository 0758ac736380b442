"""Equivalent mutants, which no test can kill: those that compile to the same code, and those listed with a reason."""

import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tools.verify.exceptions import Permit, uncovering
from tools.verify.mutants.schemata import Mutant
from tools.verify.mutants.sources import Source


def unmatched(table: Sequence[Permit], mutants: Sequence[Mutant]) -> list[str]:
    """Complaints about entries that match no mutant, or every mutant of a line."""
    broad = [f"{permit} would excuse any: name the mutants" for permit in table if permit.what.endswith("-> *")]
    return [*broad, *(f"{permit.file}: no mutant is `{permit.what}`" for permit in uncovering(table, mutants))]


def needless(table: Sequence[Permit], killed: Sequence[Mutant], alive: Sequence[Mutant]) -> list[str]:
    """Complaints about entries whose mutants tests kill."""
    unneeded = set(uncovering(table, alive)) - set(uncovering(table, killed))
    return [f"{it} is listed as equivalent, but a test kills it" for it in table if it in unneeded]


class Compiler:
    """Compares the code of mutants with that of their sources."""

    def __init__(self) -> None:
        self._originals: dict[str, str] = {}

    def same_code(self, source: Source, mutant: Mutant) -> bool:
        """Whether a mutant compiles to the same instructions as its source, with gcc -O2."""
        if source.file not in self._originals:
            self._originals[source.file] = self._code(source, source.text)
        original = self._originals[source.file]
        return original != "" and self._code(source, mutant.apply(source.text)) == original

    def _code(self, source: Source, text: str) -> str:
        """The assembly of a text; empty if it does not compile by itself."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, Path(source.file).name)
            path.write_text(text)
            command = ["gcc", "-O2", "-w", "-S", "-o", "-", *source.options, path.name]
            return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False).stdout
