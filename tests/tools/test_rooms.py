"""tools/rooms: what came and went in a checkout of its own, with sums counted by hand."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PYTHON = '"""Adds."""\n\nimport sys\n\n\ndef add(a: int) -> int:\n    """As it says."""\n    return a + 1\n'
C = "/* Adds; twice. */\nint add(int a)\n{\n    if (a)   // never\n        return a + 1;\n    return 2;\n}\n"


@pytest.fixture
def rooms(tmp_path):
    """A checkout with a commit, and its rows by room."""
    for name, text in {"host_sim/world/add.py": PYTHON, "firmware/add.c": C, "picture.png": "1\n2\n"}.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    for words in ("init -q", "add .", "-c user.name=a -c user.email=a commit -qm a"):
        subprocess.run(["git", *words.split()], cwd=tmp_path, check=True)
    (tmp_path / ".git/info/exclude").write_text("tools\n")
    (tmp_path / "tools").mkdir()
    shutil.copy(ROOT / "tools/rooms", tmp_path / "tools")

    def run(*words: str) -> dict[str, list[str]]:
        said = subprocess.check_output([tmp_path / "tools/rooms", *words], text=True).splitlines()[1:]
        return {line.split()[0]: line.split()[1:] for line in said}

    return tmp_path, run


def test_a_checkout_without_changes_differs_in_no_room(rooms):
    _, run = rooms

    assert run() == {"product": ["2", "15", "5", "+0", "+0", "+0"], "tests": ["0", "0", "0", "+0", "+0", "+0"]}


def test_each_room_counts_files_lines_and_statements(rooms):
    _, run = rooms

    assert run("--all")["host_sim/world"] == ["1", "8", "2", "+0", "+0", "+0"]
    assert run("--all")["firmware"] == ["1", "7", "3", "+0", "+0", "+0"]


def test_new_changed_and_deleted_files_count(rooms):
    folder, run = rooms
    (folder / "firmware/add.c").unlink()
    (folder / "tests").mkdir()
    (folder / "tests/test_add.py").write_text("def test_add():\n    assert add(1) == 2\n")
    (folder / "host_sim/world/add.py").write_text(PYTHON + "\n\nONE = 1\n")

    found = run()

    assert found["firmware"] == ["0", "0", "0", "-1", "-7", "-3"]
    assert found["host_sim/world"] == ["1", "11", "3", "+0", "+3", "+1"]
    assert found["tests"] == ["1", "2", "2", "+1", "+2", "+2"]
