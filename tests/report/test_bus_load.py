"""The bits that frames take, and the tables made of them."""

import random
import re

import pytest

from host_sim.cli.main import main
from host_sim.protocol.codec import Frame
from host_sim.protocol.frame_bits import crc15, frame_bits, frames_a_second, worst_bits
from host_sim.protocol.generated import MESSAGES
from host_sim.recording.log_reader import read_log
from host_sim.report.bus_load import load_tables, measure
from tests.recording.support import Kept, record_run

UNASKED = ("COMMAND", "ANSWER", "CRASH", "RANGES", "EMERGENCY", "BOOT")
"""What a run without faults sends at its start, or never."""


@pytest.fixture(scope="module")
def kept(tmp_path_factory) -> Kept:
    return record_run(tmp_path_factory.mktemp("run"), seed=4, limit_s=30.0)


def test_the_crc_is_that_of_can():
    assert crc15(b"123456789") == 0x059E  # the check value of CRC-15/CAN


def as_sent(frame: Frame) -> str:
    """The bits of a frame, written out as the standard has them."""
    bits = f"0{frame.id:011b}000{len(frame.data):04b}" + "".join(f"{byte:08b}" for byte in frame.data)
    crc = 0
    for bit in bits:
        crc = ((crc << 1) & 0x7FFF) ^ (0x4599 if int(bit) ^ (crc >> 14) else 0)
    sent = ""
    for bit in f"{bits}{crc:015b}":
        sent += bit
        if sent[-5:] in ("00000", "11111"):
            sent += "1" if bit == "0" else "0"
    return sent + "1" + "01" + "1" * 7 + "1" * 3


def test_a_frame_has_the_bits_that_are_sent():
    source = random.Random(4)
    frames = [Frame(source.randrange(0x800), source.randbytes(source.randrange(9))) for _ in range(500)]
    frames += [Frame(0, bytes(8)), Frame(0x7FF, b"\xff" * 8), Frame(0, b""), Frame(0x078, b"\x3c\x3c" * 4)]

    for frame in frames:
        assert frame_bits(frame) == len(as_sent(frame))


def test_no_frame_takes_more_than_the_worst_case():
    source = random.Random(1)
    for length in range(9):
        frames = [Frame(source.randrange(0x800), source.randbytes(length)) for _ in range(300)]
        assert max(map(frame_bits, frames)) <= worst_bits(length)
    assert worst_bits(8) == 135
    assert worst_bits(0) == 55


def test_a_log_has_the_frames_a_second_of_the_table(kept):
    load = measure(read_log(kept.log))

    assert load.nodes == {1}
    for name, message in MESSAGES.items():
        if name not in UNASKED and frames_a_second(message):
            # The reports of the first stop, and a memory for each lesson, come on top.
            surplus = load.messages[name].frames - load.seconds * frames_a_second(message)
            assert -3 <= surplus <= 30
    assert set(load.messages) - set(UNASKED) == set(MESSAGES) - set(UNASKED)


def test_a_log_stays_within_the_worst_case(kept):
    log = list(read_log(kept.log))
    load = measure(log)

    for name, share in load.messages.items():
        assert share.worst == share.frames * worst_bits(MESSAGES[name].length)
        assert 0.8 * share.worst < share.bits <= share.worst
    assert sum(share.bits for share in load.messages.values()) == sum(frame_bits(it.frame) for it in log)


def figures(text: str, row: str) -> list[float]:
    (line,) = re.findall(rf"^\| {row} .*$", text, re.MULTILINE)
    return [float(number) for number in re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?=[% |(])", line)]


def test_the_command_prints_the_tables(capsys, kept):
    assert main(["load"]) == 0
    tables = capsys.readouterr().out
    assert tables == load_tables()

    worst = worst_bits(8) * 50
    assert figures(tables, "DRIVE") == [8, worst_bits(8), 50, worst / 1000]

    assert main(["load", str(kept.log)]) == 0
    measured = capsys.readouterr().out
    frames, a_second, *_ = figures(measured, "DRIVE")
    assert frames == measure(read_log(kept.log)).messages["DRIVE"].frames
    assert a_second == pytest.approx(50, abs=0.2)
    assert "1 robot in 29.98 s" in measured


def test_a_log_without_times_has_no_rates(tmp_path, capsys, kept):
    path = tmp_path / "a.log"
    frame = next(iter(read_log(kept.log))).frame
    path.write_text(f"  can0  {frame.id:03X}   [{len(frame.data)}]  {frame.data.hex(' ').upper()}\n" * 2)

    assert main(["load", str(path)]) == 0

    assert "The log has no times." in capsys.readouterr().out
