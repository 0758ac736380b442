"""The same firmware does the same everywhere: host and images, byte for byte, with every profile."""

import pytest

from host_sim.client.connection import Connection
from host_sim.emulator.board import start_board
from host_sim.protocol.generated import PROFILES
from host_sim.sim.access import BOARDS
from tests.image.support import run_robot
from tests.runs.equality import IMAGES, REFERENCE, compare, first_difference, record

TICKS = 700
MEMORY = b" 681#"


@pytest.mark.parametrize("seed", [1, 2])
def test_all_images_do_what_the_host_build_does(seed, tmp_path):
    verdicts = list(compare([seed], TICKS, tmp_path))

    assert [(verdict.where, verdict.difference) for verdict in verdicts] == [(image, None) for image in IMAGES]
    log = (tmp_path / f"{REFERENCE}-{seed}.log").read_bytes()
    memories = {line.split(b"#")[1][4:] for line in log.splitlines() if MEMORY in line}  # without CRC and counter
    assert len(memories) > 1, "it learned while it was watched"


def test_another_seed_is_another_run(tmp_path):
    logs = [tmp_path / f"{seed}.log" for seed in (1, 2)]
    for seed, log in enumerate(logs, start=1):
        record(REFERENCE, seed, 200, log)

    assert first_difference(*logs) is not None


def test_the_first_line_that_differs_is_named(tmp_path):
    ours, theirs = tmp_path / "ours.log", tmp_path / "theirs.log"
    ours.write_text("a\nb\nc\n")
    theirs.write_text("a\nB\nC\n")

    assert first_difference(ours, theirs) == "line 2: b on the host, B in theirs.log"


def test_a_log_that_ends_early_differs(tmp_path):
    ours, theirs = tmp_path / "ours.log", tmp_path / "theirs.log"
    ours.write_text("a\nb\n")
    theirs.write_text("a\n")

    assert first_difference(ours, theirs) == "line 2: b on the host, (end) in theirs.log"


def test_the_log_of_an_image_that_differs_is_left(tmp_path, monkeypatch):
    module = "tests.runs.equality"
    monkeypatch.setattr(f"{module}.record", lambda where, _seed, _ticks, log: log.write_text(f"{where}\n"))

    verdicts = list(compare([5], 10, tmp_path, ["qemu"]))

    assert [verdict.difference for verdict in verdicts] == ["line 1: host on the host, qemu in qemu-5.log"]
    assert (tmp_path / "qemu-5.log").exists()


@pytest.mark.parametrize("board", BOARDS)
def test_the_slcan_image_does_the_same_on_an_emulated_serial_line(board, tmp_path):
    logs = [tmp_path / "host.log", tmp_path / "serial.log"]
    record(REFERENCE, 4, 300, logs[0])
    emulated = start_board(board, link="slcan")

    run_robot(Connection(emulated, board, emulated.status), 4, 300, logs[1])

    assert first_difference(*logs) is None


TICKS_OF_PROFILES = 150
QEMU, BOARD = IMAGES[:2]
# One of each kind of memory, since an emulated board is slow.
CASES = [
    *((QEMU, profile) for profile in PROFILES),
    *((BOARD, profile) for profile in ("article", "searcher", "five")),
]


@pytest.mark.parametrize(("image", "profile"), CASES)
def test_the_image_does_what_the_host_build_does_with_each_profile(image, profile, tmp_path):
    logs = {where: tmp_path / f"{where}.log" for where in (REFERENCE, image)}
    for where, log in logs.items():
        record(where, 2, TICKS_OF_PROFILES, log, profile)

    assert first_difference(*logs.values()) is None
