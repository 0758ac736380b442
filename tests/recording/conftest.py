"""Runs to look at, and one to change."""

import shutil
from pathlib import Path

import pytest

from tests.recording.support import Kept, record_run


@pytest.fixture(scope="session")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Kept:
    """Two environments, left as they are."""
    return record_run(tmp_path_factory.mktemp("kept") / "run", seed=2, environments=2)


@pytest.fixture(scope="session")
def ten_seconds(tmp_path_factory: pytest.TempPathFactory) -> Kept:
    """Ten seconds, left as they are."""
    return record_run(tmp_path_factory.mktemp("short") / "run", seed=333, limit_s=10.0)


@pytest.fixture
def short(ten_seconds: Kept, tmp_path: Path) -> Kept:
    """Ten seconds, to be changed."""
    shutil.copytree(ten_seconds.log.parent, tmp_path / "short")
    return Kept(tmp_path / "short" / ten_seconds.log.name, ten_seconds.trajectory)
