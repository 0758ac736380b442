"""tools/release names what a release lacks, in a checkout of its own with one fault each; and in this checkout."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FILES = {
    "pyproject.toml": 'version = "2.1"\n',
    "CMakeLists.txt": "project(octet VERSION 2.1 LANGUAGES C)\n",
    "CITATION.cff": "version: 2.1\n",
    "CHANGELOG.md": "# Changelog\n\n## 2.1 - 2030-01-31\n",
    ".gitignore": "/build\n",
}


def git(folder: Path, *words: str) -> None:
    who = ("-c", "user.name=a", "-c", "user.email=a")
    subprocess.run(["git", *who, *words], cwd=folder, check=True, capture_output=True)


def write(folder: Path, name: str, text: str) -> None:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text)


@pytest.fixture
def checkout(tmp_path):
    """A checkout that can be released."""
    (tmp_path / "tools").mkdir()
    for name, text in FILES.items():
        write(tmp_path, name, text)
    shutil.copy(ROOT / "tools/release", tmp_path / "tools")
    write(tmp_path, "build/wheelhouse/octet_robot-2.1-py3-none-any.whl", "")
    git(tmp_path, "init", "-q")
    commit(tmp_path, "tools: add all")
    return tmp_path


def commit(folder: Path, subject: str) -> None:
    git(folder, "add", ".")
    git(folder, "commit", "-q", "--allow-empty", "-m", subject)


def missing(folder: Path) -> list[str]:
    done = subprocess.run(
        [folder / "tools/release", "--check"], capture_output=True, text=True, check=False, cwd=folder
    )
    lines = [line.removeprefix("missing ").strip() for line in done.stdout.splitlines() if line.startswith("missing")]
    assert done.returncode == bool(lines), done.stderr
    return lines


def test_nothing_is_missing_of_a_checkout_that_can_be_released(checkout):
    assert missing(checkout) == []


@pytest.mark.parametrize(
    ("name", "text", "title"),
    [
        ("CMakeLists.txt", "project(octet VERSION 2.0 LANGUAGES C)\n", "one version everywhere"),
        ("CITATION.cff", "title: Octet\n", "one version everywhere"),
        ("CHANGELOG.md", "# Changelog\n\n## Unreleased\n\n## 2.1 - 2030-01-31\n", "CHANGELOG.md"),
        ("CHANGELOG.md", "# Changelog\n\n## 2.0 - 2030-01-31\n", "CHANGELOG.md"),
        ("pyproject.toml", 'version = "2.2"\n', "wheels"),
    ],
)
def test_a_file_that_names_another_version_is_found(checkout, name, text, title):
    write(checkout, name, text)
    commit(checkout, "tools: change one")

    assert title in missing(checkout)


@pytest.mark.parametrize("subject", ["Change something", "tools: " + "x" * 66, "Tools: change one"])
def test_a_subject_that_is_not_as_agreed_is_found(checkout, subject):
    commit(checkout, subject)

    assert missing(checkout) == ["subjects of commits"]


def test_uncommitted_changes_and_the_tag_are_found(checkout):
    git(checkout, "tag", "v2.1")
    write(checkout, "README.md", "more\n")

    assert missing(checkout) == ["no uncommitted changes", "no tag yet"]


def test_this_checkout_has_one_version_and_subjects_as_agreed():
    assert {"one version everywhere", "subjects of commits"}.isdisjoint(missing(ROOT))
