"""Line and branch coverage of the Python tests, measured by coverage.py.

Processes that the tests start are included.
"""

import json
import subprocess
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.verify.command import VerifyError
from tools.verify.coverage.measure import Gap

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


@dataclass
class Sum:
    """Numbers of lines and branches, and of those executed."""

    lines: int = 0
    lines_seen: int = 0
    branches: int = 0
    branches_seen: int = 0

    def __str__(self) -> str:
        return f"{self.lines_seen} of {self.lines} lines, {self.branches_seen} of {self.branches} branches"


def measure_python(root: Path, python: Path, sources: Sequence[str], tests: Sequence[str], folder: Path) -> Any:
    """Runs tests and returns coverage.py's report of each file.

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

    def coverage(*words: str) -> None:
        command = (str(python), "-m", "coverage", words[0], f"--rcfile={setting}", *words[1:])
        result = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise VerifyError(f"coverage {words[0]} failed:\n{result.stdout}{result.stderr}")

    coverage("run", "-m", "pytest", "--quiet", "-p", "no:cacheprovider", *tests)
    coverage("combine", "--quiet")
    coverage("json", "--quiet", "-o", str(folder / "report.json"))
    return json.loads((folder / "report.json").read_text())["files"]


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


def sums(files: Mapping[str, Any], depth: int = 2) -> dict[str, Sum]:
    """Totals for each package, which is the first `depth` folders of a path."""
    found: dict[str, Sum] = defaultdict(Sum)
    for name, file in files.items():
        it, total = file["summary"], found["/".join(Path(name).parts[:-1][:depth])]
        total.lines += it["num_statements"]
        total.lines_seen += it["covered_lines"]
        total.branches += it["num_branches"]
        total.branches_seen += it["covered_branches"]
    return dict(sorted(found.items()))


def table(files: Mapping[str, Any]) -> Iterable[str]:
    """A line for each package."""
    return (f"{name:26} {total}\n" for name, total in sums(files).items())
