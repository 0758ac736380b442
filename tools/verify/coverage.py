"""Coverage of the C tests, from clang's source-based counters.

Three things are measured: the lines reached; for each condition, the outcomes that occurred; and MC/DC, for each
condition of a decision with several (`a && b`): whether two evaluations differ only in this condition and in the
result of the decision.
"""

import json
import os
import subprocess
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from tools.verify.command import VerifyError, output_of

MEASURED = ("firmware", "hal")
VERSION = 19
CLANG = f"clang-{VERSION}"
FLAGS = ("-fprofile-instr-generate", "-fcoverage-mapping", "-fcoverage-mcdc")
NOT_MEASURED = "unsupported MC/DC"
"""Clang's warning about a decision that it cannot measure."""
COPY = "programmed_"
"""Prefix of the core's functions in host_sim/program's own build, which has its own tests."""

_CODE = 0
_JOINT = 6


@dataclass(frozen=True, order=True)
class Gap:
    """A gap in the coverage.

    Attributes:
        file: File, relative to the project's root.
        line: Line, from 1.
        what: "never reached: " and the line or condition, or "never true: ", "never false: " or "never decides: "
            and the condition.
    """

    file: str
    line: int
    what: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.what}"


class Measured(NamedTuple):
    """The gaps, each once, and llvm-cov's totals: `count` and `covered` of `branches` and of `mcdc`."""

    gaps: list[Gap]
    totals: dict[str, dict[str, float]]


class Place(NamedTuple):
    """A range of a source, end exclusive; lines and columns count from 1."""

    line: int
    column: int
    end_line: int
    end_column: int


class Condition(NamedTuple):
    """A condition: its place, its counts of true and false, and whether its decision has several conditions."""

    place: Place
    true: int
    false: int
    joint: bool


class Source:
    """A source file."""

    def __init__(self, root: Path, path: Path) -> None:
        self.name = str(path.relative_to(root))
        self._lines = path.read_text().splitlines()

    def begins(self, line: int, column: int) -> bool:
        """Whether only white space precedes a column in its line."""
        return not self._lines[line - 1][: column - 1].strip()

    def line(self, number: int) -> str:
        """The text of a line; for the opening brace of a function, that of the line above."""
        text = self._lines[number - 1].strip()
        return self.line(number - 1) if text == "{" else text

    def cut(self, place: Place) -> str:
        """The text of a place, joined to one line."""
        lines = self._lines[place.line - 1 : place.end_line]
        lines[-1] = lines[-1][: place.end_column - 1]
        lines[0] = lines[0][place.column - 1 :]
        return " ".join(" ".join(lines).split())


@dataclass(frozen=True)
class File:
    """The code of a function, or of a macro expanded in it, within one file.

    Attributes:
        source: The file.
        unreached: Lines on which unreached code begins.
        conditions: All conditions, in source order.
        decisions: Each decision with several conditions: its place, and which conditions were shown to decide.
    """

    source: Source
    unreached: Sequence[int]
    conditions: Sequence[Condition]
    decisions: Sequence[tuple[Place, Sequence[bool]]]

    def gaps(self) -> Iterator[Gap]:
        """The gaps in this code."""
        for line in self.unreached:
            yield Gap(self.source.name, line, f"never reached: {self.source.line(line)}")
        for condition in self.conditions:
            if not (condition.true and condition.false):
                missing = "false" if condition.true else "true" if condition.false else "reached"
                yield self._gap(f"never {missing}", condition)
        for condition, decides in self.judged():
            if condition.true and condition.false and not decides:
                yield self._gap("never decides", condition)

    def judged(self) -> Iterator[tuple[Condition, bool]]:
        """Each condition of a decision with several, and whether it was shown to decide."""
        for place, decide in self.decisions:
            joint = [each for each in self.conditions if each.joint]
            inside = [it for it in joint if place[:2] <= it.place[:2] and it.place[2:] <= place[2:]]
            yield from zip(inside, decide, strict=True)

    def _gap(self, what: str, condition: Condition) -> Gap:
        return Gap(self.source.name, condition.place.line, f"{what}: {self.source.cut(condition.place)}")


def measure(root: Path, build: Path) -> Measured:
    """Reads the coverage that the tests of a build have recorded.

    Args:
        root: Folder of the sources.
        build: Build folder, compiled by CLANG with FLAGS, whose test_* programs have been run.

    Raises:
        VerifyError: There is no coverage data.
    """
    data = _export(root, build)
    files = _files(root, data["functions"])
    return Measured(sorted({gap for file in files for gap in file.gaps()}), data["totals"])


def _export(root: Path, build: Path) -> dict[str, Any]:
    """llvm-cov's export, merged over all test programs, with the totals of the measured files."""
    profiles = sorted(build.rglob("*.profraw"))
    programs = [path for path in sorted(build.rglob("test_*")) if path.is_file() and os.access(path, os.X_OK)]
    if not profiles or not programs:
        raise VerifyError(f"no test has left coverage data in {build}")
    programs += sorted(build.rglob("lib*.so"))
    merged = build / "tests.profdata"
    output_of(f"llvm-profdata-{VERSION}", "merge", "-o", merged, *profiles)
    objects = [word for program in programs[1:] for word in ("-object", program)]
    folders = ("-sources", *(root / name for name in MEASURED))
    text = output_of(f"llvm-cov-{VERSION}", "export", "-instr-profile", merged, programs[0], *objects, *folders)
    data: dict[str, Any] = json.loads(text)["data"][0]
    return data


def _files(root: Path, functions: Iterable[dict[str, Any]]) -> Iterator[File]:
    """The parts of all functions that are in measured files."""
    for function in functions:
        if function["name"].startswith(COPY):
            continue
        for number, name in enumerate(function["filenames"]):
            path = Path(name)
            if path.is_relative_to(root) and path.relative_to(root).parts[0] in MEASURED:
                yield _file(Source(root, path), number, function)


def _file(source: Source, number: int, function: dict[str, Any]) -> File:
    """One part of a function; the rows are indexed as in llvm-cov's export."""
    regions = [row for row in function["regions"] if row[5] == number]
    branches = [row for row in function["branches"] if row[6] == number]
    decisions = [row for row in function["mcdc_records"] if row[4] == number]
    return File(
        source=source,
        unreached=[row[0] for row in regions if row[7] == _CODE and not row[4] and source.begins(*row[:2])],
        conditions=sorted(Condition(Place(*row[:4]), row[4], row[5], row[8] == _JOINT) for row in branches),
        decisions=[(Place(*row[:4]), row[-1]) for row in decisions],
    )


# These patterns replace coverage.py's: no comment excludes a line, and only lines that do nothing are excluded.
_SETTING = """\
[run]
branch = true
parallel = true
patch = subprocess
source =
{sources}
data_file = {folder}/data
[report]
exclude_lines =
    if TYPE_CHECKING:
    : \\.\\.\\.$
partial_branches =
    never
"""


def measure_python(
    root: Path, python: Path, sources: Sequence[str], tests: Sequence[str], folder: Path
) -> tuple[Any, str]:
    """Runs tests; returns what coverage.py says of each file, and its table of files that are not covered whole.

    Args:
        root: The project's folder.
        python: A Python interpreter that has pytest and coverage.
        sources: Folders to measure, relative to the root.
        tests: Arguments of pytest.
        folder: An existing, empty folder for coverage's files.

    Raises:
        VerifyError: A test failed, or nothing was measured.
    """
    setting = folder / "setting"
    lines = "\n".join(f"    {root / source}" for source in sources)
    setting.write_text(_SETTING.format(sources=lines, folder=folder))

    def coverage(*words: str) -> str:
        command = (str(python), "-m", "coverage", words[0], f"--rcfile={setting}", *words[1:])
        result = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise VerifyError(f"coverage {words[0]} failed:\n{result.stdout}{result.stderr}")
        return result.stdout

    coverage("run", "-m", "pytest", "--quiet", "-p", "no:cacheprovider", *tests)
    coverage("combine", "--quiet")
    coverage("json", "--quiet", "-o", str(folder / "report.json"))
    return json.loads((folder / "report.json").read_text())["files"], coverage("report", "--skip-covered")


def python_gaps(root: Path, files: Mapping[str, Any]) -> list[Gap]:
    """Lines that were never reached, and branches between reached lines that were never taken."""
    return sorted(gap for name, file in files.items() for gap in _gaps(name, (root / name).read_text(), file))


def _gaps(name: str, text: str, file: Mapping[str, Any]) -> Iterator[Gap]:
    lines = [line.strip() for line in text.splitlines()]
    unreached = set(file["missing_lines"])
    for line in unreached:
        yield Gap(name, line, f"never reached: {lines[line - 1]}")
    for line, to in file["missing_branches"]:
        if not {line, to} & unreached:
            where = f"on to: {lines[to - 1]}" if to > 0 else "to its end"
            yield Gap(name, line, f"never from: {lines[line - 1]} {where}")
