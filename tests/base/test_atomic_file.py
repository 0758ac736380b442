"""A file is replaced whole or not at all, and what prevents that is said."""

from pathlib import Path

import pytest

from host_sim.base.atomic_file import replacing
from host_sim.base.errors import OctetError


def write_half(path: Path, error: BaseException) -> None:
    """Begins to write a file, and fails."""
    with replacing(path) as part:
        part.write_text("half")
        raise error


def test_a_write_that_fails_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")

    with pytest.raises(OctetError, match=f"^cannot write {path}: the encoder failed$"):
        write_half(path, OSError("the encoder failed"))  # as Pillow says it, without a number

    assert [(it.name, it.read_text()) for it in tmp_path.iterdir()] == [("file", "old")]


def test_an_interruption_stays_one_where_the_new_file_is_gone(tmp_path, monkeypatch):
    monkeypatch.setattr(Path, "write_text", lambda part, _text: part.unlink())  # somebody has tidied up meanwhile

    with pytest.raises(KeyboardInterrupt):
        write_half(tmp_path / "file", KeyboardInterrupt())

    assert list(tmp_path.iterdir()) == []
