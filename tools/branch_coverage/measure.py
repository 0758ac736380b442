"""What the C tests have gone through, as gcov tells."""

import json
import subprocess
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

MEASURED = ("firmware", "hal")


class MeasureError(Exception):
    """It cannot be measured; says why."""


@dataclass(frozen=True, order=True)
class Gap:
    """A branch or a line that no test takes.

    Attributes:
        file: Where, from the root of the project.
        line: Which one.
        text: What stands there.
    """

    file: str
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.text}"


@dataclass(frozen=True)
class Measured:
    """The sum over all objects.

    Attributes:
        branches: How many there are.
        taken: How many of them were taken.
        gaps: Lines with a branch that was not, or that were never reached; each once.
    """

    branches: int
    taken: int
    gaps: list[Gap]


def measure(root: Path, build: Path) -> Measured:
    """Reads what the tests of a build have left.

    Args:
        root: Of the sources.
        build: Built with `--coverage`, and its tests have been run.

    Raises:
        MeasureError: There is nothing to read.
    """
    notes = sorted(build.rglob("*.gcda"))
    if not notes:
        raise MeasureError(f"no test has left anything in {build}")
    lines: Counter[tuple[str, int]] = Counter()
    branches: Counter[tuple[str, int, int]] = Counter()
    for file, line in _lines(root, build, notes):
        number = line["line_number"]
        lines[file, number] += line["count"]
        for index, branch in enumerate(line["branches"]):
            branches[file, number, index] += branch["count"]
    missed = {place for place, count in lines.items() if count == 0}
    missed |= {(file, number) for (file, number, _), count in branches.items() if count == 0}
    gaps = [Gap(file, number, _text(root / file, number)) for file, number in sorted(missed)]
    return Measured(len(branches), sum(count > 0 for count in branches.values()), gaps)


def _lines(root: Path, build: Path, notes: list[Path]) -> Iterable[tuple[str, dict]]:  # type: ignore[type-arg]
    """Each line of a source of ours, as gcov describes it, once for each object."""
    command = ["gcov", "--json-format", "--stdout", "--branch-probabilities", *map(str, notes)]
    output = subprocess.run(command, cwd=build, capture_output=True, text=True, check=True).stdout
    for text in output.splitlines():
        for source in json.loads(text)["files"]:
            path = (build / source["file"]).resolve()
            if path.is_relative_to(root) and path.relative_to(root).parts[0] in MEASURED:
                yield from ((str(path.relative_to(root)), line) for line in source["lines"])


def _text(path: Path, number: int) -> str:
    return path.read_text().splitlines()[number - 1].strip()
