"""Files are written whole or not at all, and read only if they end; compressed files can be read when cut off."""

import errno
import gzip
import json
import os
import random
import stat
import sys
import tracemalloc
import xml.etree.ElementTree as ET
import zlib
from pathlib import Path

import pytest

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.files import CompressedFile, read_bytes, read_words, replacing, write_bytes
from host_sim.base.result_files import Case, write_results
from host_sim.base.toml_file import parse_toml


def test_write_bytes_creates_only_the_target_file(tmp_path):
    write_bytes(tmp_path / "a", b"new")

    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"a": b"new"}


def test_write_through_a_symlink_replaces_its_target(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder/target").write_bytes(b"old")
    (tmp_path / "link").symlink_to("folder/target")

    write_bytes(tmp_path / "link", b"new")

    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "folder/target").read_bytes() == b"new"


def test_rewritten_file_keeps_its_mode(tmp_path):
    (tmp_path / "a").write_bytes(b"old")
    (tmp_path / "a").chmod(0o600)

    write_bytes(tmp_path / "a", b"new")

    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o600


def test_new_file_has_the_default_mode_of_the_process(tmp_path):
    (tmp_path / "usual").write_bytes(b"")

    write_bytes(tmp_path / "a", b"new")

    assert (tmp_path / "a").stat().st_mode == (tmp_path / "usual").stat().st_mode


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir])
def test_write_refuses_to_replace_a_pipe_or_a_folder(tmp_path, make):
    make(tmp_path / "a")
    before = (tmp_path / "a").stat()

    with pytest.raises(OctetError, match="not a regular file"):
        write_bytes(tmp_path / "a", b"new")

    assert (tmp_path / "a").stat() == before


def test_write_ignores_a_pipe_named_like_an_old_temporary_file(tmp_path):
    os.mkfifo(tmp_path / "a.part")

    write_bytes(tmp_path / "a", b"new")

    assert (tmp_path / "a").read_bytes() == b"new"


@pytest.mark.parametrize("call", ["fsync", "fchmod"])
def test_failed_write_leaves_only_the_old_file(tmp_path, monkeypatch, call):
    (tmp_path / "a").write_bytes(b"old")

    def fail(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, call, fail)
    with pytest.raises(OctetError, match=r"cannot write .*/a: No space left on device"):
        write_bytes(tmp_path / "a", b"new")

    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"a": b"old"}


def test_regular_file_is_read_through_a_symlink_too(tmp_path):
    (tmp_path / "a").write_bytes(b"12345678")
    (tmp_path / "link").symlink_to("a")

    assert read_bytes(tmp_path / "a", 8) == read_bytes(tmp_path / "link", 8) == b"12345678"


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (os.mkfifo, "not a regular file"),
        (lambda path: path.symlink_to("/dev/zero"), "not a regular file"),
        (lambda path: (path.touch(), os.truncate(path, 1 << 40)), "at most 8"),
    ],
    ids=["pipe", "endless", "huge"],
)
def test_read_refuses_pipe_device_and_oversized_file_at_once(tmp_path, make, why):
    make(tmp_path / "a")

    with pytest.raises(UsageError, match=why):
        read_bytes(tmp_path / "a", 8)


def test_reading_a_small_file_takes_little_memory_despite_a_high_limit(tmp_path):
    (tmp_path / "a").write_bytes(b"12345678")

    tracemalloc.start()
    read_bytes(tmp_path / "a", 2_000_000_000)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert peak < 1_000_000


def write_half(path: Path, error: BaseException) -> None:
    """Begins to write a file, and fails."""
    with replacing(path) as part:
        part.write_text("half")
        raise error


def test_failed_replacement_leaves_only_the_old_file(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")

    with pytest.raises(OctetError, match=f"^cannot write {path}: the encoder failed$"):
        write_half(path, OSError("the encoder failed"))  # as Pillow raises it, without an errno

    assert [(it.name, it.read_text()) for it in tmp_path.iterdir()] == [("file", "old")]


def test_interruption_is_raised_although_the_temporary_file_is_gone(tmp_path, monkeypatch):
    monkeypatch.setattr(Path, "write_text", lambda part, _text: part.unlink())  # somebody has tidied up meanwhile

    with pytest.raises(KeyboardInterrupt):
        write_half(tmp_path / "file", KeyboardInterrupt())

    assert list(tmp_path.iterdir()) == []


CASES = [Case("drives", "passed", seconds=1.5), Case("a<b", "failed", "it \x1bdoes\nnot"), Case("c", "skipped")]


def test_junit_report_has_each_case_without_control_characters(tmp_path):
    write_results("robot", CASES, None, tmp_path / "robot.xml")

    suite = ET.parse(tmp_path / "robot.xml").getroot()
    assert {name: suite.get(name) for name in ("name", "tests", "failures", "skipped")} == {
        "name": "robot",
        "tests": "3",
        "failures": "1",
        "skipped": "1",
    }
    assert [case.get("name") for case in suite] == ["drives", "a<b", "c"]
    assert suite[0].get("time") == "1.500"
    assert (suite[1][0].tag, suite[1][0].get("message"), suite[1][0].text) == ("failure", "it ?does", "it ?does\nnot")
    assert suite[2][0].tag == "skipped"


def test_json_report_has_each_case(tmp_path):
    write_results("robot", CASES, tmp_path / "robot.json", None)

    assert [Case(**case) for case in json.loads((tmp_path / "robot.json").read_text())] == CASES


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


def test_compressed_file_decompresses_to_its_content(tmp_path):
    assert gzip.decompress(write(tmp_path / "a", [])) == CONTENT


def test_compressed_bytes_do_not_depend_on_the_sizes_of_writes(tmp_path):
    draws = random.Random(1)

    assert write(tmp_path / "a", []) == write(tmp_path / "b", [draws.randrange(5000) for _ in range(50)])


def test_compressed_file_on_disk_lacks_less_than_64_kib_of_the_content(tmp_path):
    path = tmp_path / "a"
    file = CompressedFile(path.open("wb"))
    for at in range(0, len(CONTENT), 1000):
        file.write(CONTENT[at : at + 1000])

        read = zlib.decompressobj(31).decompress(path.read_bytes())

        assert CONTENT.startswith(read)
        assert len(read) > at + 1000 - KEPT_BACK
    file.close()


def test_compressed_file_without_writes_is_empty(tmp_path):
    CompressedFile((tmp_path / "a").open("wb")).close()

    assert (tmp_path / "a").read_bytes() == b""


def test_compressed_file_on_a_full_disk_raises_and_still_closes():
    file = CompressedFile(Path("/dev/full").open("wb", buffering=0))  # noqa: SIM115 - it is closed below
    file.write(b"some")

    with pytest.raises(OSError, match="No space left"):
        file.flush()
    with pytest.raises(OSError, match="No space left"):
        file.close()

    assert file.closed


def test_toml_is_refused_where_python_has_no_parser(monkeypatch):
    for name in ("tomllib", "tomli"):
        monkeypatch.setitem(sys.modules, name, None)

    with pytest.raises(UsageError, match=r"cannot read TOML: use 3\.11 or newer"):
        parse_toml("a = 1")


def test_overlong_word_is_refused_and_not_truncated(tmp_path):
    (tmp_path / "words.txt").write_text(f"one # fine\nturn_deg={'0' * 191}77\n")

    with pytest.raises(UsageError, match=r"words\.txt:2: 'turn_deg=00000000000' goes on for 202 characters"):
        read_words(tmp_path / "words.txt", 1000, str)
