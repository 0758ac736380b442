"""The folder of a run: one run at a time."""

import errno
import fcntl
import os
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from host_sim.recording.run_folder import run_folder


def open_files() -> set[str]:
    """What this process has open, but for the folder that lists it."""
    return {path.readlink().as_posix() for path in Path("/proc/self/fd").iterdir() if path.is_symlink()}


def test_a_second_run_is_told_who_is_using_it(tmp_path):
    with run_folder(tmp_path), pytest.raises(UsageError, match=f"in use by another run .process {os.getpid()}."):
        run_folder(tmp_path).__enter__()


def test_it_is_free_again_after_a_run(tmp_path):
    with run_folder(tmp_path):
        pass
    with run_folder(tmp_path):
        pass


def test_a_folder_that_cannot_be_locked_is_named_and_closed(tmp_path, monkeypatch):
    def fail(*_: object) -> None:
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))  # as some network file systems do

    monkeypatch.setattr(fcntl, "flock", fail)
    before = open_files()

    with pytest.raises(UsageError, match=f"^cannot lock the folder {tmp_path}: No locks available; choose"):
        run_folder(tmp_path).__enter__()
    assert open_files() == before
