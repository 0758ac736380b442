"""Compressed files that are cut off while they are written."""

import gzip
import random
import zlib
from pathlib import Path

import pytest

from host_sim.base.compressed_file import CompressedFile

CONTENT = b"".join(b"(0000000001.%06d) octet 081#%08X\n" % (i, i * 2654435761 % 2**32) for i in range(8000))
KEPT_BACK = 1 << 16


def write(path: Path, sizes: list[int]) -> bytes:
    """Writes the content in pieces of these sizes, and then the rest."""
    file, at = CompressedFile(path.open("wb")), 0
    for size in sizes:
        file.write(CONTENT[at : at + size])
        at += size
    file.write(CONTENT[at:])
    file.close()
    return path.read_bytes()


def test_what_is_written_can_be_read(tmp_path):
    assert gzip.decompress(write(tmp_path / "a", [])) == CONTENT


def test_the_bytes_do_not_depend_on_how_the_content_was_handed_over(tmp_path):
    draws = random.Random(1)

    assert write(tmp_path / "a", []) == write(tmp_path / "b", [draws.randrange(5000) for _ in range(50)])


def test_all_but_the_last_that_was_written_is_in_the_file_at_once(tmp_path):
    path = tmp_path / "a"
    file = CompressedFile(path.open("wb"))
    for at in range(0, len(CONTENT), 1000):
        file.write(CONTENT[at : at + 1000])

        read = zlib.decompressobj(31).decompress(path.read_bytes())

        assert CONTENT.startswith(read)
        assert len(read) > at + 1000 - KEPT_BACK
    file.close()


def test_an_empty_file_stays_empty(tmp_path):
    CompressedFile((tmp_path / "a").open("wb")).close()

    assert (tmp_path / "a").read_bytes() == b""


def test_on_a_full_disk_it_fails_and_is_closed_all_the_same():
    file = CompressedFile(Path("/dev/full").open("wb", buffering=0))  # noqa: SIM115 - it is closed below
    file.write(b"some")

    with pytest.raises(OSError, match="No space left"):
        file.flush()
    with pytest.raises(OSError, match="No space left"):
        file.close()

    assert file.closed
