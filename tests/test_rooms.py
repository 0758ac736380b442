"""A room is small enough to find a file in it by guessing: no folder has more than `FILES_MAX` files."""

import subprocess
from collections import Counter
from collections.abc import Iterable
from pathlib import PurePath

import pytest

from tests.runs.support import ROOT

FILES_MAX = 30


def crowded(files: Iterable[str]) -> dict[str, int]:
    """The folders with too many files, and how many they have."""
    counts = Counter(str(PurePath(file).parent) for file in files)
    return {folder: count for folder, count in counts.items() if count > FILES_MAX}


@pytest.fixture(scope="module")
def files() -> list[str]:
    """All files of the project, those that are not committed yet among them."""
    command = ("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    named = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")[:-1]
    return [file for file in named if (ROOT / file).exists()]


def test_no_folder_is_crowded(files):
    assert crowded(files) == {}


def test_one_file_too_many_is_found(files):
    room = [file for file in files if PurePath(file).parent == PurePath("host_sim/base")]
    planted = [f"host_sim/base/planted_{i}.py" for i in range(FILES_MAX + 1 - len(room))]

    assert room
    assert crowded([*files, *planted[1:]]) == {}
    assert crowded([*files, *planted]) == {"host_sim/base": FILES_MAX + 1}
