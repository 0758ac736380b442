"""A folder is small enough to find a file in it by guessing, and a file is not too small.

No folder has more than `FILES_MAX` files. A module under `LINES_MIN` lines that only one other file
imports is part of that one. No line of the product's C is longer than ruff allows Python.
"""

import os
import re
import subprocess
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from pathlib import PurePath

import pytest

from tests.runs.support import ROOT

FILES_MAX, LINES_MIN, LINE_MAX = 30, 40, 118
STAND_ALONE = {
    "host_sim/__main__.py": "a program, which a test imports as well",
    "host_sim/world/arena.py": "a view of one struct, as body.py is",
}
PYTHON = re.compile(r"^\s*(?:from ([\w.]+) import ([\w, ]+|\()|import ([\w.]+))", re.MULTILINE)
TYPESCRIPT = re.compile(r'^import \{[^}]*\} from "(\.[^"]+)\.js"', re.MULTILINE)


def crowded(files: Iterable[str]) -> dict[str, int]:
    """The folders with too many files, and how many they have."""
    counts = Counter(str(PurePath(file).parent) for file in files)
    return {folder: count for folder, count in counts.items() if count > FILES_MAX}


def imported(file: str, text: str) -> set[str]:
    """The modules that a file imports, as paths."""
    if file.endswith(".ts"):
        return {os.path.normpath(PurePath(file).parent / f"{name}.ts") for name in TYPESCRIPT.findall(text)}
    found: set[str] = set()
    for package, names, module in PYTHON.findall(text):
        dotted = [package or module, *(f"{package}.{name.strip()}" for name in names.split(",") if package)]
        found |= {f"{name.replace('.', '/')}.py" for name in dotted}
    return found


def too_small(texts: Mapping[str, str]) -> set[str]:
    """The modules of the product that belong in the only file that imports them."""
    importers: dict[str, set[str]] = defaultdict(set)
    for file, text in texts.items():
        for module in imported(file, text):
            importers[module].add(file)
    small = {file for file, text in texts.items() if text.count("\n") < LINES_MIN and not file.startswith("tests/")}
    return {file for file in small if len(importers[file]) == 1}


@pytest.fixture(scope="module")
def files() -> list[str]:
    """All files of the project, those that are not committed yet among them."""
    command = ("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    named = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")[:-1]
    return [file for file in named if (ROOT / file).exists()]


def test_folders_have_at_most_30_files(files):
    assert crowded(files) == {}


def test_folder_with_31_files_is_found(files):
    room = [file for file in files if PurePath(file).parent == PurePath("host_sim/base")]
    planted = [f"host_sim/base/planted_{i}.py" for i in range(FILES_MAX + 1 - len(room))]

    assert room
    assert crowded([*files, *planted[1:]]) == {}
    assert crowded([*files, *planted]) == {"host_sim/base": FILES_MAX + 1}


@pytest.fixture(scope="module")
def texts(files) -> dict[str, str]:
    """The sources in Python and TypeScript."""
    scripts = [file for file in files if file.startswith("tools/") and "." not in PurePath(file).name]
    sources = [file for file in files if file.endswith((".py", ".ts"))]
    return {file: (ROOT / file).read_text() for file in sources + scripts}


def test_modules_with_one_importer_have_at_least_40_lines(texts):
    assert too_small(texts) <= set(STAND_ALONE)


@pytest.mark.parametrize("where", ["host_sim/live/qr_code.py", "host_sim/web/board/board.ts"])
def test_small_module_with_one_importer_is_found(texts, where):
    planted = str(PurePath(where).with_stem("planted"))
    line = {".ts": 'import { planted } from "./planted.js";', ".py": "from host_sim.live.planted import planted"}
    one = {**texts, planted: "\n", where: f"{line[PurePath(where).suffix]}\n{texts[where]}"}
    another = str(PurePath(where).with_stem("another"))

    assert planted in too_small(one)
    assert planted not in too_small({**one, another: one[where]})


def too_long(text: str) -> list[str]:
    """The lines of a file that are longer than `LINE_MAX`."""
    return [line for line in text.splitlines() if len(line) > LINE_MAX]


def test_lines_of_c_have_at_most_118_columns(files):
    sources = [file for file in files if file.endswith((".c", ".h")) and not file.startswith("tests/")]

    assert len(sources) > 100
    assert {file: lines for file in sources if (lines := too_long((ROOT / file).read_text()))} == {}


def test_line_over_118_columns_is_found():
    fine = f"/* {'x' * (LINE_MAX - 6)} */"

    assert too_long(f"{fine}\n{fine} ") == [f"{fine} "]


def rooms_without_a_sentence(rooms: Iterable[str], architecture: str) -> set[str]:
    """The folders of host_sim of which docs/architecture.md does not say what they may know."""
    told = re.findall(r"^  \| `(\w+)/` \| \w.{20,}\|$", architecture, re.MULTILINE)
    return set(rooms) - set(told)


def test_architecture_page_describes_each_folder_of_host_sim(files):
    rooms = {file.split("/")[1] for file in files if re.match(r"host_sim/\w+/", file)}
    architecture = (ROOT / "docs/architecture.md").read_text()

    assert rooms_without_a_sentence(rooms, architecture) == set()
    assert rooms_without_a_sentence({*rooms, "attic"}, architecture) == {"attic"}
