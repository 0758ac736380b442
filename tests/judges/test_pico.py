"""The image for a Raspberry Pi Pico in rp2040js, a third-party emulator."""

import os
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from pathlib import Path

import pytest

from host_sim.base.errors import RobotError, UsageError
from host_sim.base.paths import ROOT, image_path
from host_sim.client.frame_log import FrameLog
from host_sim.lab.bench.short_run import run_ticks
from host_sim.protocol.generated import Reason, Side
from host_sim.sim.pico import command_line
from host_sim.sim.run_config import RunConfig
from tests.image.support import Talk
from tests.judges.labwired_board import PicoBoard, flash_of
from tests.judges.test_starts import PROTOCOL, SENSES, differences, exchanges, first, page
from tests.judges.test_starts import store_record as stored
from tests.runs.support import REFERENCE, first_difference, record

__all__ = ["exchanges"]

TICKS = 4000
SECTOR = 4096
COUNT = SECTOR // 16 - 1
KEPT = (0, 2, 0, 0, 0, 0, 0, 0)
FULL = page(COUNT) + page(0) + b"".join(stored(COUNT + 1 + number, bytes(KEPT)) for number in range(COUNT))
"""A store whose two sectors are full, so that the next record needs the first one erased."""
Start = Callable[..., PicoBoard]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts boards, which end with the test."""
    with ExitStack() as stack:
        yield lambda *options, flash=None: stack.enter_context(closing(PicoBoard(tmp_path, *options, flash=flash)))


def talk_to(board: PicoBoard) -> Talk:
    """A talk with a board that has started."""
    talk = Talk(board, 0)
    boot(talk)
    return talk


def boot(talk: Talk) -> None:
    """Lets the board start."""
    talk.heard += map(PROTOCOL.decode, talk.board.boot())


def test_4000_ticks_of_a_run_have_the_frames_of_the_host(tmp_path):
    host, pico = tmp_path / "host.log", tmp_path / "pico.log"
    record(REFERENCE, 1, TICKS, host)

    run_ticks(RunConfig(seed=1, robot="emulated", board="pico"), TICKS, FrameLog(pico))

    assert first_difference(host, pico) is None


def test_pico_at_line_speed_answers_and_stops_when_the_senses_end(start, exchanges):
    board = start("paced")
    board.boot()

    moving = list(differences(board, first(exchanges, 15), "20ms"))
    said = [PROTOCOL.decode(frame) for frame in board.listen("150ms")]

    drives = [it.signals for it in said if it is not None and it.name == "DRIVE"]
    assert moving == []
    assert [(it["reason"], it["left"], it["right"]) for it in drives[:1]] == [(Reason.SILENCE, 0, 0)]


def test_changed_byte_of_the_log_is_reported_as_a_difference(start, exchanges):
    board = start()
    board.boot()
    *same, (asked, (answer, *more)) = first(exchanges, 5)
    changed = answer._replace(data=bytes([answer.data[0] ^ 1]) + answer.data[1:])

    found = list(differences(board, [*same, (asked, [changed, *more])]))

    assert asked.id == SENSES
    assert found == [(asked, [answer, *more], [changed, *more])]


def crc32_of_the_boot_rom(data: bytes) -> int:
    """By the data sheet, 2.8.1.3.1: polynomial 0x04C11DB7, all ones first, nothing reflected."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ (0x04C11DB7 if crc >> 31 else 0)) & 0xFFFFFFFF
    return crc


def test_second_stage_has_its_checksum():
    stage = flash_of()[:256]

    assert struct.unpack("<I", stage[252:]) == (crc32_of_the_boot_rom(stage[:252]),)


def test_second_stage_with_a_wrong_checksum_is_not_started(start):
    flash = bytearray(flash_of())
    flash[8] ^= 1

    with pytest.raises(RobotError, match="the second stage has a wrong checksum"):
        start(flash=bytes(flash)).order("run", 1)


def test_uf2_file_has_the_bytes_of_the_image():
    image = image_path("pico", "slcan").with_suffix(".bin").read_bytes()
    uf2 = image_path("pico", "slcan").with_suffix(".uf2").read_bytes()
    blocks = [struct.unpack("<8I476sI", uf2[at : at + 512]) for at in range(0, len(uf2), 512)]

    assert b"".join(block[8][:256] for block in blocks)[: len(image)] == image
    assert {block[:3] + block[4:5] + block[6:8] + block[9:] for block in blocks} == {
        (0x0A324655, 0x9E5D5157, 0x2000, 256, len(blocks), 0xE48BFF56, 0x0AB16F30)
    }
    assert [block[3] for block in blocks] == [0x10000000 + 256 * number for number in range(len(blocks))]


def test_crash_is_reported_with_its_address(start):
    talk = talk_to(start())

    at = int(talk.board.order("crash"))
    boot(talk)
    for _ in range(3):
        talk.ask()

    assert talk.last("BOOT")["reset_cause"] == PROTOCOL.choices("BOOT", "reset_cause")["crash"]
    names = {number: register for register, number in PROTOCOL.choices("CRASH", "name").items()}
    told = {names[it.signals["name"]]: it.signals["value"] for it in talk.heard if it.name == "CRASH"}
    assert told["pc"] == at


def test_watchdog_resets_a_hung_core_after_2_s(start):
    talk = talk_to(start())

    talk.board.order("hang")
    assert talk.wait(1.9) == []
    talk.wait(0.1)
    boot(talk)

    assert talk.last("BOOT")["reset_cause"] == PROTOCOL.choices("BOOT", "reset_cause")["watchdog"]


def learn(talk: Talk, side: int) -> None:
    """Writes cell 1, and empties the others of its half."""
    talk.order("write", mask=0b1111, half=0, byte_0=0, byte_1=side, byte_2=0, byte_3=0)


def memory_after_power_up(talk: Talk) -> tuple[int, ...]:
    talk.board.order("power")
    boot(talk)
    talk.order("stop")
    talk.wait(0.005)
    return talk.memory


def test_memory_survives_a_power_loss(start):
    talk = talk_to(start())
    learn(talk, Side.LEFT)

    assert memory_after_power_up(talk) == (0, 1, 0, 0, 0, 0, 0, 0)


@pytest.mark.parametrize(("operation", "part"), [*((operation, 0.4) for operation in range(1, 7)), (2, 1)])
def test_power_loss_in_any_flash_operation_leaves_a_stored_memory(start, operation, part):
    """The older sector's mark is overwritten, it is erased and marked, and three records are written."""
    board = start(flash=flash_of(FULL))
    board.order("cut", operation, part)
    talk = talk_to(board)
    possible = [KEPT]
    for side in (Side.LEFT, Side.RIGHT, Side.LEFT):
        learn(talk, side)
        possible.append((0, side, *[0] * 6))

    assert board.order("cuts") == "1"
    assert memory_after_power_up(talk) in possible
    learn(talk, Side.RIGHT)
    assert memory_after_power_up(talk) == (0, Side.RIGHT, *[0] * 6)


def test_missing_node_is_reported_in_a_sentence(monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")

    with pytest.raises(UsageError, match="runs in Node, which is not installed: run tools/setup pico"):
        command_line(image_path("pico", "slcan").with_suffix(".bin"))


def test_missing_rp2040js_is_reported_in_a_sentence(monkeypatch, tmp_path):
    monkeypatch.setattr("host_sim.sim.pico.BUILD", tmp_path)

    with pytest.raises(UsageError, match="runs in rp2040js, which is not installed: run tools/setup pico"):
        command_line(image_path("pico", "slcan").with_suffix(".bin"))


def test_run_without_node_ends_with_exit_code_2(tmp_path):
    command = [sys.executable, "-m", "host_sim", "run", "--robot", "emulated", "--board", "pico", "--out", tmp_path]
    done = subprocess.run(command, cwd=ROOT, env={**os.environ, "PATH": "/nowhere"}, capture_output=True, check=False)

    assert done.returncode == 2
    assert done.stderr.count(b"\n") == 1
    assert b"Node" in done.stderr
