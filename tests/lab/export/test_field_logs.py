"""The test files of python-can, read as its own readers read them; MF4 as it and as we write it."""

from collections import Counter
from pathlib import Path

import can
import pytest

from host_sim.protocol.codec import Frame, Protocol
from host_sim.recording.log_files import frames_in, mf4_module
from host_sim.recording.log_reader import read_log
from host_sim.recording.log_text import ERROR, EXTENDED, FD, OTHER, REMOTE, Recorded

ROOT = Path(__file__).resolve().parents[3]
FILES = sorted(
    path
    for path in (ROOT / "build/python-can").iterdir()
    if path.suffix in (".asc", ".blf", ".trc", ".gz") and not path.name.endswith(".tar.gz")
)
LEFT_OUT = {"logfile.asc": 2} | {
    f"test_CanMessage_{version}.trc": 1 for version in ("V1_0_BUS1", "V1_1", "V1_3", "V2_0_BUS1", "V2_1")
}
"""Lines without a frame: python-can does not speak of them."""

CLASSIC_ON_FD = {"logfile.asc"}
"""A file with a classic frame of an FD channel, by its flags; python-can takes all there for FD."""


def kind_of(message: can.Message) -> str:
    if message.is_error_frame:
        return ERROR
    if message.is_fd:
        return FD
    if message.is_remote_frame:
        return REMOTE
    return EXTENDED if message.is_extended_id else "classic"


def test_python_can_has_files_of_each_format():
    assert Counter(path.suffix for path in FILES) == {".asc": 12, ".blf": 6, ".trc": 6, ".gz": 1}


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_frames_read_from_a_file_equal_those_of_python_can(path):
    messages = list(can.LogReader(path))
    read = [it for _, it in frames_in(path)]

    kinds = Counter("classic" if isinstance(it, Recorded) else it for it in read)
    theirs = Counter(map(kind_of, messages))
    assert kinds.pop(OTHER, 0) == LEFT_OUT.get(path.name, 0)
    if path.name in CLASSIC_ON_FD:
        theirs += Counter({EXTENDED: 1})
        theirs -= Counter({FD: 1})
    assert kinds == theirs
    classic = [Frame(it.arbitration_id, bytes(it.data)) for it in messages if kind_of(it) == "classic"]
    assert [it.frame for it in read if isinstance(it, Recorded)] == classic


def test_mf4_files_of_python_can_are_read(tmp_path):
    data, path = bytes.fromhex("C311000000000000"), tmp_path / "a.mf4"
    with mf4_module().MF4Writer(path) as writer:
        for i in range(3):
            sent = can.Message(
                timestamp=1_900_000_000 + i / 50,
                arbitration_id=Protocol().id_of("SENSES"),
                data=data,
                is_extended_id=i == 1,
            )
            writer.on_message_received(sent)

    log = read_log(path)
    read = list(log)

    assert [it.frame for it in read] == [Frame(Protocol().id_of("SENSES"), data)] * 2
    assert (read[1].time_us - read[0].time_us, log.skipped) == (40_000, {EXTENDED: 1})


def test_damaged_mf4_file_is_reported_in_one_line(tmp_path):
    path = tmp_path / "a.mf4"
    path.write_bytes(b"MDF     4.10    " + bytes(300))

    with pytest.raises(Exception, match=r"^\S+a\.mf4 is a damaged MF4 file, or one cut short: .+"):
        list(read_log(path))
