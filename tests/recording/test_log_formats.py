"""Logs that other programs write: the robots' frames are read, others are skipped and counted by their kind."""

import bz2
import gzip
import lzma
import subprocess
import sys
from pathlib import Path

import can
import pytest

from host_sim.base.errors import OctetError, UsageError
from host_sim.protocol.codec import Frame, Protocol
from host_sim.recording.log_reader import Recorded, read_log

ID = Protocol().id_of("SENSES")
DATA = bytes.fromhex("C311000000000000")
SPACED = "C3 11 00 00 00 00 00 00"
BINARY = "11000011 00010001 00000000 00000000 00000000 00000000 00000000 00000000"
S = 1_000_000
T = 1_795_285_590 * S + 648_617
"""2026-11-21 18:26:30.648617, in us."""


def frames(*times_us: int) -> list[Recorded]:
    return [Recorded(time_us, Frame(ID, DATA)) for time_us in times_us]


def read(path: Path, text: str | bytes) -> tuple[list[Recorded], dict[str, int]]:
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    log = read_log(path)
    return list(log), dict(log.skipped)


COMPACT = f"(1795285590.648617) can0 {ID:03X}#{DATA.hex().upper()}"
LINES = {
    "a run, candump -L": (COMPACT, T),
    "candump -L -x: received": (f"{COMPACT} R", T),
    "candump -L -x: sent": (f"{COMPACT} T", T),
    "candump -L, DLC above 8": (f"{COMPACT}_9", T),
    "candump -L, nanoseconds": (COMPACT.replace("648617", "648617999"), T),
    "another program, small digits": (COMPACT.lower().replace("C", "c"), T),
    "another program, carriage returns": (f"{COMPACT}\r", T),
    "candump -t a": (f" (1795285590.648617)  vcan0  {ID:03X}   [8]  {SPACED}", T),
    "candump -t a, several interfaces": (f" (1795285590.648617)   can0       {ID:03X}   [8]  {SPACED}", T),
    "candump -t A": (f" (2026-11-21 18:26:30.648617)  vcan0  {ID:03X}   [8]  {SPACED}", T),
    "candump -t z": (f" (000.020000)  vcan0  {ID:03X}   [8]  {SPACED}", 20_000),
    "candump": (f"  vcan0  {ID:03X}   [8]  {SPACED}", 0),
    "candump -x -a": (f" (1795285590.648617)  vcan0  TX - -  {ID:03X}   [8]  {SPACED}   '......'..'", T),
    "candump -c": (f" (1795285590.648617)  \x1b[1m\x1b[34mvcan0\x1b[0m  {ID:03X}   [8]  {SPACED}", T),
    "log2long": (f"(1795285590.648617)  octet       {ID:03X}   [8]  {SPACED}   '........'", T),
}


@pytest.mark.parametrize(("line", "time_us"), LINES.values(), ids=LINES)
def test_line_of_each_format_is_read(tmp_path, line, time_us):
    assert read(tmp_path / "a.log", f"{line}\n{line}\n") == (frames(time_us, time_us), {})


def test_relative_time_stamps_of_candump_are_added_up(tmp_path):
    lines = "".join(f" (000.{us:06d})  vcan0  {ID:03X}   [8]  {SPACED}\n" for us in (0, 20_000, 19_000, 21_000))

    assert read(tmp_path / "a.log", lines)[0] == frames(0, 20_000, 39_000, 60_000)


OTHERS = {
    "(0.000000) can0 12345678#C311": "extended",
    "(0.000000) can0 123#R": "remote",
    "(0.000000) can0 123#R8 R": "remote",
    "(0.000000) can0 12345678#R": "remote",
    "(0.000000) can0 123##1AABBCC": "FD",
    "(0.000000) can0 20000080#0000000000000000": "error",
    "(0.000000) can0 20000080# R": "error",
    "(0.000000) can0 00123#81:00:12345678#1122334455667788AABB": "XL",
    "(0.000000) can0 7FF#0102": "foreign",
    " (1795285590.664608)  vcan0  12345678   [2]  C3 11": "extended",
    " (1795285590.718756)  vcan0       123   [3]  remote request": "remote",
    " (1795285590.856751)  vcan0  RX B -       7FF  [03]  AA BB CC                  '...'": "FD",
    " (1795285590.866404)  vcan0  20000080   [8]  00 00 00 00 00 00 00 00   ERRORFRAME": "error",
    " (1795285590.846822)  vcan0       7FF   [0] ": "foreign",
}


@pytest.mark.parametrize(("line", "kind"), OTHERS.items())
def test_frame_that_is_no_robot_s_is_skipped_and_counted(tmp_path, line, kind):
    assert read(tmp_path / "a.log", f"{COMPACT}\n{line}\n{COMPACT}\n") == (frames(T, T), {kind: 1})


def test_skipped_frames_are_noted_in_one_line(tmp_path):
    path = tmp_path / "a.log"
    path.write_text("".join(f"{line}\n" for line in list(OTHERS)[:5]))
    log = read_log(path)
    assert log.note() is None

    list(log)

    assert log.note() == f"{path}: skipped 1 FD, 1 extended and 3 remote frames"


def test_empty_lines_and_explanations_of_errors_are_ignored(tmp_path):
    assert read(tmp_path / "a.log", f"\n{COMPACT}\n\tbus-error\n\r\n") == (frames(T), {})


MALFORMED = {
    "an odd number of digits": COMPACT[:-1],
    "nine bytes": f"{COMPACT}00",
    "no identifier": "(0.000000) can0 #00",
    "no time": f"can0 {ID:03X}#00",
    "a huge time": f"({'9' * 400}.000000) can0 {ID:03X}#00",
    "fewer bytes than said": f"  can0  {ID:03X}   [8]  C3 11",
    "bytes in reverse": f"  can0  {ID:03X}   [8]  {SPACED.replace(' ', '`')}",
    "bits": f"  can0  {ID:03X}   [8]  {BINARY}",
    "a date of no calendar": f" (20261-11-21 18:26)  can0  {ID:03X}   [0] ",
    "words": "Dear robot,",
    "a long line": "x" * 100_000,
}


@pytest.mark.parametrize("line", MALFORMED.values(), ids=MALFORMED)
def test_malformed_line_is_reported_with_its_number(tmp_path, line):
    with pytest.raises(OctetError, match=r"a\.log, line 3: "):
        read(tmp_path / "a.log", f"{COMPACT}\n{COMPACT}\n{line}\n{COMPACT}\n")


def test_last_line_without_an_end_is_left_out(tmp_path):
    assert read(tmp_path / "a.log", f"{COMPACT}\n{COMPACT}") == (frames(T), {})


def message(time_s: float, **fields: object) -> can.Message:
    return can.Message(timestamp=time_s, **{"is_extended_id": False, "channel": 0, **fields})


def logged(path: Path, *messages: can.Message) -> Path:
    """As python-can writes them."""
    with can.Logger(path) as logger:
        for it in messages:
            logger.on_message_received(it)
    return path


MESSAGES = [
    message(1000.0, arbitration_id=ID, data=DATA),
    message(1000.02, arbitration_id=0x12345, is_extended_id=True, data=DATA),
    message(1000.02, arbitration_id=ID, is_remote_frame=True, dlc=8),
    message(1000.02, arbitration_id=ID, is_fd=True, data=bytes(12)),
    message(1000.02, is_error_frame=True),
    message(1000.02, arbitration_id=0x7FF, data=DATA),
    message(1000.04, arbitration_id=ID, data=DATA, is_rx=False),
]
SKIPPED = {"extended": 1, "remote": 1, "FD": 1, "error": 1, "foreign": 1}


@pytest.mark.parametrize("suffix", [".log", ".asc", ".blf", ".csv", ".db", ".log.gz", ".asc.gz", ".csv.gz"])
def test_logs_of_python_can_are_read(tmp_path, suffix):
    log = read_log(logged(tmp_path / f"a{suffix}", *MESSAGES))
    read = list(log)

    assert [it.frame for it in read] == [Frame(ID, DATA)] * 2
    assert read[1].time_us - read[0].time_us == 40_000
    assert log.skipped == SKIPPED


@pytest.mark.parametrize("suffix", ["asc", "blf", "csv", "db", "trc"])
def test_log_converted_by_can_logconvert_is_read(tmp_path, suffix):
    lines = [f"({1_700_000_000 + i / 50:.6f}) can0 {ID:03X}#{DATA.hex().upper()}\n" for i in range(5)]
    (tmp_path / "a.log").write_text("".join(lines))
    words = [sys.executable, "-m", "can.logconvert", tmp_path / "a.log", tmp_path / f"b.{suffix}"]
    subprocess.run(words, check=True, capture_output=True)

    log = list(read_log(tmp_path / f"b.{suffix}"))

    assert [it.frame for it in log] == [Frame(ID, DATA)] * 5
    assert [it.time_us - log[0].time_us for it in log] == [20_000 * i for i in range(5)]


def test_log_written_by_asc2log_is_read(tmp_path):
    logged(tmp_path / "a.asc", *MESSAGES)
    subprocess.run(["asc2log", "-I", tmp_path / "a.asc", "-O", tmp_path / "a.log"], check=True, capture_output=True)

    log = read_log(tmp_path / "a.log")

    assert [it.frame for it in log] == [Frame(ID, DATA)] * 2
    assert log.skipped == SKIPPED


ASC = "date Sat Nov 21 18:26:30 2026\nbase hex  timestamps absolute\n"
GOOD = f"   0.020000 1  {ID:X}             Rx   d 8 {SPACED}\n"
BAD_ASC = {
    "no identifier": "0.1 1 Q Rx d 1 00",
    "a huge time": f"{'9' * 400}.0 1 {ID:X} Rx d 1 00",
    "fewer bytes than said": f"0.03 1  {ID:X} Rx d 8 C3 11 00",
    "half a byte": f"0.03 1  {ID:X} Rx d 2 C3 1",
    "cut after the identifier": f"0.03 1  {ID:X}",
    "a large identifier": "0.03 1  800 Rx d 1 00",
    "FD, cut": f"0.03 CANFD   1 Rx  {ID:X}",
    "other words": "Dear robot,",
}


@pytest.mark.parametrize("line", BAD_ASC.values(), ids=BAD_ASC)
def test_malformed_line_of_an_asc_file_is_reported_with_its_number(tmp_path, line):
    with pytest.raises(OctetError, match=r"a\.asc, line 4: "):
        read(tmp_path / "a.asc", f"{ASC}{GOOD}{line}\n{GOOD}")


@pytest.mark.parametrize("line", BAD_ASC.values(), ids=BAD_ASC)
def test_truncated_last_line_of_an_asc_file_is_left_out(tmp_path, line):
    assert read(tmp_path / "a.asc", f"{ASC}{GOOD}{line}")[0] == frames(20_000)


def test_relative_times_of_an_asc_file_are_added_up(tmp_path):
    """CANoe counts each line from the one before it, whatever that line says."""
    text = ASC.replace("absolute", "relative") + GOOD + "   0.005000 1  Statistic: D 0 R 0\n" + GOOD

    assert read(tmp_path / "a.asc", text)[0] == frames(20_000, 45_000)


def test_negative_times_of_an_asc_file_count_from_its_first_line(tmp_path):
    before = GOOD.replace("   0.020000", "  -0.010000")

    assert read(tmp_path / "a.asc", ASC + before + GOOD)[0] == frames(0, 30_000)


def on_fd_channel(flags: str, brs: int = 0) -> str:
    return f"   0.020000 CANFD   1 Rx  {ID:X}  Senses  {brs} 0 8  8 {SPACED}   102203  133   {flags} e0006659\n"


def test_classic_frames_of_an_fd_channel_are_read(tmp_path):
    text = ASC + "   0.000000 CANFD 1 Start of measurement\n" + on_fd_channel("200050") + on_fd_channel("303000", 1)

    assert read(tmp_path / "a.asc", text) == (frames(20_000), {"FD": 1})


def test_events_without_a_frame_are_counted(tmp_path):
    text = ASC + GOOD + "   0.03 J1939TP FEE3p 6 0 0 - Rx d 23 A0\n   0.04 1  SV: 2 0 1 ::Test = 3\n" + GOOD
    path = tmp_path / "a.asc"

    assert read(path, text) == (frames(20_000, 20_000), {"other": 2})
    log = read_log(path)
    list(log)
    assert log.note() == f"{path}: skipped 2 lines without a frame"


def test_decimal_asc_file_is_read(tmp_path):
    decimal = " ".join(str(byte) for byte in DATA)

    text = f"date Sat\nbase dec  timestamps absolute\n 0.02 1 {ID} Rx d 8 {decimal}\n"
    assert read(tmp_path / "a.asc", text)[0] == frames(20_000)


def test_trc_file_of_python_can_is_read(tmp_path):
    written = [it for it in MESSAGES if not (it.is_fd or it.is_error_frame or it.is_remote_frame)]

    log = read_log(logged(tmp_path / "a.trc", *written))

    assert [it.frame for it in log] == [Frame(ID, DATA)] * 2
    assert log.skipped == {"extended": 1, "foreign": 1}


TRC = ";$FILEVERSION=1.1\n;$STARTTIME=43000.5\n"
TRC_LINE = f"     1)     20.0  Rx         {ID:04X}  8  {SPACED}\n"


@pytest.mark.parametrize("line", [TRC_LINE[:-4] + "\n", TRC_LINE.replace("8  C3", "8  Q3"), "     2)\n", "words\n"])
def test_malformed_line_of_a_trc_file_is_reported_with_its_number(tmp_path, line):
    with pytest.raises(OctetError, match=r"a\.trc, line 4: not a frame: .*\w.*$"):
        read(tmp_path / "a.trc", f"{TRC}{TRC_LINE}{line}{TRC_LINE}")


def test_lines_of_a_trc_file_that_python_can_skips_are_left_out(tmp_path):
    text = f"{TRC}{TRC_LINE}     2)     21.0  Warng  FFFFFFFF  4  00 00 00 08  BUSHEAVY\n{TRC_LINE}{TRC_LINE[:-6]}"

    assert [len(it) for it in read(tmp_path / "a.trc", text)] == [2, 0]


@pytest.mark.parametrize("pack", [gzip.compress, bz2.compress, lzma.compress])
def test_compressed_logs_are_read(tmp_path, pack):
    assert read(tmp_path / "a.log", pack(f"{COMPACT}\n".encode())) == (frames(T), {})


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (bytes.fromhex("d4c3b2a1020004000000000000000000ffff0000e3000000"), "a capture of Wireshark or tcpdump"),
        (b"PK\x03\x04" + bytes(30) + b"\xff\n", "it is not text"),
        (b"Dear robot,\n", "not a frame, or cut short"),
    ],
)
def test_unreadable_format_is_refused_with_the_readable_ones(tmp_path, content, said):
    with pytest.raises(UsageError, match=f"{said}.*\\.blf .*can_logconvert writes them"):
        read(tmp_path / "a.pcap", content)


def test_blf_file_with_trailing_zeros_is_refused_as_cut_short(tmp_path):
    path = logged(tmp_path / "a.blf", MESSAGES[0])
    path.write_bytes(path.read_bytes() + bytes(64))

    with pytest.raises(UsageError, match="cut short: no object begins where the last one ends"):
        list(read_log(path))


ON_TWO = "".join(f"{COMPACT.replace('can0', bus)}\n" for bus in ("can0", "can1", "can0"))


def test_node_on_two_interfaces_is_refused_unless_one_is_chosen(tmp_path):
    with pytest.raises(UsageError, match="node 1 is on can0 and on can1: choose one, such as --channel can0"):
        read(tmp_path / "a.log", ON_TWO)


def test_channel_option_reads_one_channel_of_several(tmp_path):
    (tmp_path / "a.log").write_text(ON_TWO)

    assert [len(list(read_log(tmp_path / "a.log", name))) for name in ("can0", "can1")] == [2, 1]
    log = read_log(tmp_path / "a.log", "can0")
    assert list(log)
    assert log.note() == f"{log.path}: skipped 1 other-channel frame"
    with pytest.raises(UsageError, match="no robot on can2"):
        list(read_log(tmp_path / "a.log", "can2"))


def test_channels_of_asc_and_blf_files_count_from_one(tmp_path):
    for suffix in (".asc", ".blf"):
        on_two = (message(1.0, arbitration_id=ID, data=DATA, channel=channel) for channel in (0, 1))
        path = logged(tmp_path / f"a{suffix}", *on_two)

        assert [len(list(read_log(path, name))) for name in ("1", "2")] == [1, 1]


@pytest.mark.parametrize(
    "content",
    [b"LOGG" + bytes(200), gzip.compress(b"x" * 4000)[:-20], b"\x1f\x8b\x08\x00" + bytes(40)],
    ids=["BLF", "cut gzip", "garbage as gzip"],
)
def test_damaged_file_is_refused_in_one_line(tmp_path, content):
    with pytest.raises(OctetError, match=r"^\S+a\.log[^\n]+$"):
        read(tmp_path / "a.log", content)


def test_damage_within_a_blf_file_is_reported_in_one_line(tmp_path, caplog):
    path = tmp_path / "a.blf"
    with can.BLFWriter(path, compression_level=0) as writer:
        writer.on_message_received(MESSAGES[0])
    whole = path.read_bytes()
    at = whole.rindex(b"LOBJ") + len("LOBJ12")
    path.write_bytes(whole[:at] + b"\x09" + whole[at + 1 :])

    with pytest.raises(UsageError, match="damaged BLF file, or one cut short: Unknown object header version"):
        list(read_log(path))
    assert caplog.messages == []
    list(can.BLFReader(path))  # other readers are only warned
    assert caplog.messages == ["Unknown object header version (9)"]


def test_binary_file_is_reported_as_not_text(tmp_path):
    with pytest.raises(UsageError, match="not text"):
        read(tmp_path / "a.log", bytes(range(256)))
