"""Files are written whole or not at all, and read only where that ends."""

import errno
import os
import stat
import tracemalloc
from pathlib import Path

import pytest

from host_sim.base.atomic_file import write_bytes
from host_sim.base.errors import OctetError, UsageError
from host_sim.base.regular_file import read_bytes


def test_a_file_is_written_and_leaves_nothing_else(tmp_path):
    write_bytes(tmp_path / "a", b"new")

    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"a": b"new"}


def test_a_link_stays_a_link_and_its_file_is_written(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder/target").write_bytes(b"old")
    (tmp_path / "link").symlink_to("folder/target")

    write_bytes(tmp_path / "link", b"new")

    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "folder/target").read_bytes() == b"new"


def test_a_file_keeps_its_mode(tmp_path):
    (tmp_path / "a").write_bytes(b"old")
    (tmp_path / "a").chmod(0o600)

    write_bytes(tmp_path / "a", b"new")

    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o600


def test_a_new_file_has_the_mode_that_the_process_gives_its_files(tmp_path):
    (tmp_path / "usual").write_bytes(b"")

    write_bytes(tmp_path / "a", b"new")

    assert (tmp_path / "a").stat().st_mode == (tmp_path / "usual").stat().st_mode


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir])
def test_what_is_not_a_regular_file_is_not_replaced(tmp_path, make):
    make(tmp_path / "a")
    before = (tmp_path / "a").stat()

    with pytest.raises(OctetError, match="not a regular file"):
        write_bytes(tmp_path / "a", b"new")

    assert (tmp_path / "a").stat() == before


def test_a_pipe_in_the_place_of_an_old_temporary_name_does_not_matter(tmp_path):
    os.mkfifo(tmp_path / "a.part")

    write_bytes(tmp_path / "a", b"new")

    assert (tmp_path / "a").read_bytes() == b"new"


@pytest.mark.parametrize("call", ["fsync", "fchmod"])
def test_what_fails_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch, call):
    (tmp_path / "a").write_bytes(b"old")

    def fail(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, call, fail)
    with pytest.raises(OctetError, match=r"cannot write .*/a: No space left on device"):
        write_bytes(tmp_path / "a", b"new")

    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"a": b"old"}


def test_a_regular_file_is_read(tmp_path):
    (tmp_path / "a").write_bytes(b"12345678")

    assert read_bytes(tmp_path / "a", 8) == b"12345678"


def test_a_link_to_a_regular_file_is_read(tmp_path):
    (tmp_path / "a").write_bytes(b"1")
    (tmp_path / "link").symlink_to("a")

    assert read_bytes(tmp_path / "link", 8) == b"1"


def make_pipe(path: Path) -> None:
    os.mkfifo(path)


def make_endless(path: Path) -> None:
    path.symlink_to("/dev/zero")


def make_huge(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(1 << 40)


@pytest.mark.parametrize(
    ("make", "why"),
    [(make_pipe, "not a regular file"), (make_endless, "not a regular file"), (make_huge, "at most 8")],
)
def test_what_never_ends_or_is_too_large_is_refused_at_once(tmp_path, make, why):
    make(tmp_path / "a")

    with pytest.raises(UsageError, match=why):
        read_bytes(tmp_path / "a", 8)


def test_a_small_file_takes_little_memory_whatever_the_limit(tmp_path):
    (tmp_path / "a").write_bytes(b"12345678")

    tracemalloc.start()
    read_bytes(tmp_path / "a", 2_000_000_000)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert peak < 1_000_000
