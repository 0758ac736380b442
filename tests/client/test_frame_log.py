"""The log of a run: whole, or not in the place of the old one."""

import gzip
import hashlib
import os
import resource
from pathlib import Path

import pytest

from host_sim.base.compressed_file import CompressedFile
from host_sim.base.errors import OctetError, UsageError
from host_sim.client.frame_log import FrameLog, digest_of, line_of
from host_sim.protocol.codec import Frame, Protocol

FRAME = Frame(0x081, bytes(range(8)))


@pytest.fixture(params=["run.log", "run.log.gz"])
def path(request, tmp_path):
    return tmp_path / request.param


def text_in(path: Path) -> bytes:
    content = path.read_bytes()
    return gzip.decompress(content) if path.suffix == ".gz" else content


def test_what_is_added_is_written_and_its_digest_is_returned(path):
    log = FrameLog(path)
    log.set_time(1_020_000)
    log.add(FRAME)

    digest = log.close()

    assert text_in(path).decode() == line_of(1_020_000, FRAME) + "\n"
    assert digest == hashlib.sha256(text_in(path)).hexdigest()


def test_the_digest_is_the_same_whatever_build_boot_names(tmp_path):
    digests, boot = [], Protocol(3).id_of("BOOT")
    for build in (bytes(8), bytes(range(8))):
        log = FrameLog(tmp_path / "run.log")
        for frame in (FRAME, Frame(boot, build), FRAME):
            log.add(frame)
        digests.append(log.close())

        assert digest_of(text_in(tmp_path / "run.log")) == digests[-1]
    assert digests[0] == digests[1]
    assert digest_of(b"(1.0) octet 081#00\n") != digest_of(b"(1.0) octet 081#01\n")


def test_lines_that_were_written_elsewhere_stand_in_order_among_the_others(path):
    log = FrameLog(path)
    log.add(FRAME)
    log.add_block(b"elsewhere\n")
    log.add(FRAME)

    digest = log.close()

    line = line_of(0, FRAME).encode() + b"\n"
    assert text_in(path) == line + b"elsewhere\n" + line
    assert digest == hashlib.sha256(text_in(path)).hexdigest()


def test_the_old_log_stays_until_the_new_one_is_closed(path):
    path.write_text("old")
    log = FrameLog(path)
    log.add(FRAME)

    assert path.read_text() == "old"
    log.close()
    assert path.read_bytes() != b"old"


def test_a_log_without_a_frame_does_not_replace_the_old_one(path):
    path.write_text("old")

    FrameLog(path).close()

    assert path.read_text() == "old"
    assert [file.name for file in path.parent.iterdir()] == [path.name]


@pytest.mark.parametrize("path", ["", ".", "/"])
def test_a_path_without_a_name_is_refused(path):
    with pytest.raises(UsageError, match="not the name of a file"):
        FrameLog(Path(path))


def test_a_log_that_could_not_be_written_does_not_replace_the_old_one(path):
    path.write_text("old")
    log = FrameLog(path)
    log._file.close()
    full = Path("/dev/full").open("wb", buffering=0)  # noqa: SIM115 - the log closes it
    log._file = CompressedFile(full) if path.suffix == ".gz" else full

    with pytest.raises(OctetError, match=r"cannot write .*run\.log.*\.part: No space left on device"):
        add_many(log)
    log.close()

    assert path.read_text() == "old"


def add_many(log):
    for _ in range(5000):
        log.add(FRAME)


def make_pipe(part):
    os.mkfifo(part)


def make_pipe_with_a_reader(part):
    os.mkfifo(part)
    return os.open(part, os.O_RDONLY | os.O_NONBLOCK)


def make_link(part):
    (part.parent / "elsewhere").write_text("mine")
    part.symlink_to("elsewhere")


@pytest.mark.parametrize("make", [make_pipe, make_pipe_with_a_reader, make_link])
def test_a_part_file_that_is_something_else_is_refused_and_left(path, make):
    part = path.with_name(f"{path.name}.part")
    reader = make(part)

    with pytest.raises(UsageError, match="choose another folder"):
        FrameLog(path)

    assert not path.exists()
    elsewhere = path.parent / "elsewhere"
    assert not elsewhere.exists() or elsewhere.read_text() == "mine"
    if reader is not None:
        os.close(reader)


def test_a_log_whose_place_is_taken_says_so_and_keeps_what_there_is(path):
    log = FrameLog(path)
    log.add(FRAME)
    path.mkdir()

    with pytest.raises(OctetError, match=r"cannot write .*: Is a directory"):
        log.close()

    assert path.with_name(f"{path.name}.part").stat().st_size > 0


def test_a_log_on_a_full_disk_fails_once(path):
    log = FrameLog(path)
    log.add(Frame(1, bytes(8)))
    _, most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10, most))
    try:
        with pytest.raises(OctetError, match="File too large"):
            log.flush()
        with pytest.raises(OctetError, match="an earlier write failed"):
            log.flush()
        assert log.close() == log.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
