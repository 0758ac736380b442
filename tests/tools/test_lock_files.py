"""The lock files: what is pinned, how, and how much of it a run installs."""

import re
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RUN = ROOT / "requirements/run.lock"
LOCKS = sorted(ROOT.glob("requirements/*.lock"))


def test_the_lock_files_pin_by_hash_and_name_no_address() -> None:
    for path in LOCKS:
        text = path.read_text()
        assert "://" not in text
        assert 0 < text.count("==") <= text.count("--hash=sha256:")


def megabytes(locks: Sequence[Path]) -> float:
    """The size of the packages of lock files, as they are installed here."""
    names = set(re.findall(r"^([\w.-]+)==", "".join(lock.read_text() for lock in locks), re.MULTILINE))
    installed = {it.name.lower().replace("_", "-"): it for it in metadata.distributions()}
    files = [
        Path(it.locate_file(file)) for name in names & set(installed) for it in [installed[name]] for file in it.files
    ]
    return sum(file.stat().st_size for file in files if file.exists()) / 1e6


def test_a_run_installs_less_than_200_mb() -> None:
    pip = 20
    assert 50 < megabytes([RUN]) < 200 - pip


def test_a_run_that_installed_what_the_tests_need_would_be_noticed() -> None:
    assert megabytes(LOCKS) > 200
