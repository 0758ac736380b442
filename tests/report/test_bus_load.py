"""The bits that frames take at worst, and the tables made of them."""

import random
import re
from collections import Counter

from host_sim.protocol.codec import Frame
from host_sim.protocol.every_node import hear
from host_sim.protocol.generated import MESSAGES
from host_sim.recording.log_reader import read_log
from host_sim.report.bus_load import frames_a_second, load_tables, worst_bits
from tests.recording.support import record_run
from tests.report.bits_sent import bits_sent, crc15

UNASKED = ("COMMAND", "ANSWER", "CRASH", "RANGES", "EMERGENCY", "BOOT")
"""What a run without faults sends at its start, or never."""


def test_the_crc_is_that_of_can():
    assert crc15("".join(f"{byte:08b}" for byte in b"123456789")) == 0x059E  # the check value of CRC-15/CAN


def test_no_frame_takes_more_than_the_worst_case():
    source = random.Random(1)
    for length in range(9):
        frames = [Frame(source.randrange(0x800), source.randbytes(length)) for _ in range(300)]
        frames.append(Frame(0x078, b"\x3c\x3c" * (length // 2)))
        assert max(len(bits_sent(frame)) for frame in frames) <= worst_bits(length)
    assert worst_bits(8) == 135
    assert worst_bits(0) == 55


def test_a_log_has_the_frames_a_second_of_the_table(tmp_path):
    log = list(read_log(record_run(tmp_path, seed=4, limit_s=30.0).log))
    seconds = (log[-1].time_us - log[0].time_us) / 1e6
    frames = Counter(hear(it.frame).name for it in log)

    for name, message in MESSAGES.items():
        if name not in UNASKED and frames_a_second(message):
            # The reports of the first stop, and a memory for each lesson, come on top.
            assert -3 <= frames[name] - seconds * frames_a_second(message) <= 30
    assert set(frames) - set(UNASKED) == set(MESSAGES) - set(UNASKED)


def test_the_table_has_a_message_at_its_worst():
    (line,) = re.findall(r"^\| DRIVE .*$", load_tables(), re.MULTILINE)

    worst = worst_bits(8) * 50
    figures = [float(number) for number in re.findall(r"\d+(?:\.\d+)?", line)]
    assert figures == [8, worst_bits(8), 50, worst / 1000]
