"""An emulated board on a python-can bus: the command that puts it there, and as a device of the pytest plug-in.

The same firmware does the same everywhere: host and images, byte for byte, with every profile.
"""

import signal
import subprocess
import sys
import time
from itertools import pairwise

import can
import pytest

from host_sim.base.paths import image_path
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.emulator.__main__ import JoinedBoard, main
from host_sim.emulator.board import start_board
from host_sim.emulator.chips import CHIPS
from host_sim.lab.bench.short_run import run_ticks
from host_sim.protocol.codec import DBC, Frame, Protocol
from host_sim.protocol.generated import PROFILES, Senses
from host_sim.sim.access import BOARDS
from host_sim.sim.run_config import RunConfig
from tests.image.support import run_robot
from tests.runs.support import IMAGES, REFERENCE, compare, first_difference, record
from tools.pytest_canbench.bench import Bench, Setup
from tools.pytest_canbench.devices import open_device
from tools.pytest_canbench.messages import Messages

PROTOCOL = Protocol()
STOP = PROTOCOL.encode("COMMAND", {"counter": 1, "opcode": 1, "owner": 1})


@pytest.fixture
def joined():
    with (
        can.Bus(interface="virtual", channel="octet-test") as near,
        can.Bus(interface="virtual", channel="octet-test") as far,
    ):
        yield JoinedBoard(start_board("blue_pill"), near), far


def send(bus, frame, **kind):
    bus.send(can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=False, **kind))


def heard(joined, bus, wanted):
    """What comes until a message of that name does."""
    names = []
    give_up = time.monotonic() + 600
    while wanted not in names and time.monotonic() < give_up:
        joined.step()
        while (message := bus.recv(0)) is not None:
            names.append(PROTOCOL.decode(Frame(message.arbitration_id, bytes(message.data))).name)
    return names


def test_joined_board_answers_on_the_bus(joined):
    board, bus = joined

    send(bus, STOP)

    assert [name for name in heard(board, bus, "HEALTH") if name not in ("BOOT", "DRIVE")][:2] == [
        "ANSWER",
        "HEARTBEAT",
    ]


def test_joined_board_ignores_remote_and_extended_frames(joined):
    board, bus = joined
    senses = PROTOCOL.encode_senses(Senses(0, 0, False, False, 0, 0, 0), 0)
    bus.send(can.Message(arbitration_id=senses.id, is_remote_frame=True, dlc=8, is_extended_id=False))
    bus.send(can.Message(arbitration_id=senses.id, data=senses.data, is_extended_id=True))

    send(bus, senses)

    assert "DRIVE" in heard(board, bus, "DRIVE")


def test_emulated_board_does_not_run_ahead_of_wall_clock_time(joined):
    board, _ = joined
    clock = board._board.hardware.clock
    began, board_began = time.monotonic(), clock.now

    for _ in range(50):
        board.step()

    assert (clock.now - board_began) / 1e15 <= time.monotonic() - began + 0.001


def test_command_serves_until_the_bus_is_gone(monkeypatch, capsys):
    def step(_self):
        raise can.CanError("it broke")

    monkeypatch.setattr(JoinedBoard, "step", step)

    assert main(["--bus", "virtual:octet-test"]) == 1
    output = capsys.readouterr()
    assert output.out == "octet: an emulated feather_stm32f405 listens on virtual:octet-test\n"
    assert output.err == "octet: the bus virtual:octet-test is gone: it broke\n"


def test_unopenable_bus_is_reported_in_one_line(capsys):
    assert main(["--bus", "nonsense"]) == 2

    assert capsys.readouterr().err.count("\n") == 1


WITHOUT_UNICORN = """
import runpy, sys
sys.modules["unicorn"] = None
sys.argv[1:] = sys.argv[2:]
runpy.run_module(sys.argv[0], run_name="__main__")
"""


@pytest.mark.parametrize(
    "words", ["host_sim.emulator --bus virtual:octet-test", "host_sim run --robot emulated --environments 1"]
)
def test_missing_unicorn_is_reported_with_the_setup_command(words, tmp_path):
    module, *arguments = words.split()
    command = [sys.executable, "-c", WITHOUT_UNICORN.replace("sys.argv[0]", repr(module)), "", *arguments]

    result = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)

    assert result.returncode == 1
    assert result.stderr == "octet: this needs unicorn, which is not installed: run tools/setup emulator\n"


@pytest.fixture
def board_on_vcan():
    command = [sys.executable, "-m", "host_sim.emulator", "--board", "blue_pill", "--bus", "socketcan:vcan0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert "listens" in process.stdout.readline()
    yield process
    process.kill()
    process.communicate()


@pytest.mark.vcan
@pytest.mark.usefixtures("board_on_vcan")
def test_board_on_socketcan_equals_the_host_build(tmp_path):
    logs = [tmp_path / "host.log", tmp_path / "vcan.log"]
    record(REFERENCE, 3, 500, logs[0])

    run_ticks(RunConfig(seed=3, bus="socketcan:vcan0", robot="external", owner=1), 500, FrameLog(logs[1]))

    assert first_difference(*logs) is None


@pytest.mark.vcan
def test_sigint_ends_the_emulator(board_on_vcan):
    board_on_vcan.send_signal(signal.SIGINT)

    assert board_on_vcan.wait() == 130


@pytest.fixture
def bench(name):
    image = image_path(name, CHIPS[name].link)
    opened = Bench(Setup(Messages(DBC, "e2e1"), lambda: open_device(f"image:{name}:{image.name}", image.parent)))
    yield opened
    opened.close()


def test_image_sends_at_simulated_times(bench):
    bench.run(ms=1000)

    silences = [at_ms for at_ms, reason in bench.history("DRIVE.reason") if reason == 8]
    gaps = {later - sooner for sooner, later in pairwise(silences[-8:])}
    assert gaps <= {99, 100, 101}
    assert bench.damaged == 0


def test_shorted_bus_causes_bus_off_and_recovery(bench):
    bench.device.short_bus(True)
    for _ in range(300):
        bench.run(ms=1)
        if bench.device.is_bus_off:
            break
    assert bench.device.is_bus_off
    assert bench.device.error_counters[0] > 255

    bench.device.short_bus(False)
    before = len(bench.heard)
    bench.run(ms=1000)
    assert not bench.device.is_bus_off
    assert len(bench.heard) > before


TICKS = 700
MEMORY = b" 681#"


@pytest.mark.parametrize("seed", [1, 2])
def test_images_equal_the_host_build(seed, tmp_path):
    verdicts = list(compare([seed], TICKS, tmp_path))

    assert [(verdict.where, verdict.difference) for verdict in verdicts] == [(image, None) for image in IMAGES]
    log = (tmp_path / f"{REFERENCE}-{seed}.log").read_bytes()
    memories = {line.split(b"#")[1][4:] for line in log.splitlines() if MEMORY in line}  # without CRC and counter
    assert len(memories) > 1, "it learned while it was watched"


def test_different_seeds_give_different_logs(tmp_path):
    logs = [tmp_path / f"{seed}.log" for seed in (1, 2)]
    for seed, log in enumerate(logs, start=1):
        record(REFERENCE, seed, 200, log)

    assert first_difference(*logs) is not None


@pytest.mark.parametrize(("other", "there"), [("a\nB\nC\n", "B"), ("a\n", "(end)")])
def test_first_different_line_is_named(tmp_path, other, there):
    ours, theirs = tmp_path / "ours.log", tmp_path / "theirs.log"
    ours.write_text("a\nb\nc\n")
    theirs.write_text(other)

    assert first_difference(ours, theirs) == f"line 2: b on the host, {there} in theirs.log"


def test_log_of_a_different_image_is_kept(tmp_path, monkeypatch):
    module = "tests.runs.support"
    monkeypatch.setattr(f"{module}.record", lambda where, _seed, _ticks, log: log.write_text(f"{where}\n"))

    verdicts = list(compare([5], 10, tmp_path, ["qemu"]))

    assert [verdict.difference for verdict in verdicts] == ["line 1: host on the host, qemu in qemu-5.log"]
    assert (tmp_path / "qemu-5.log").exists()


@pytest.mark.parametrize("board", BOARDS)
def test_slcan_image_equals_the_host_build(board, tmp_path):
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
def test_image_equals_the_host_build_with_every_profile(image, profile, tmp_path):
    logs = {where: tmp_path / f"{where}.log" for where in (REFERENCE, image)}
    for where, log in logs.items():
        record(where, 2, TICKS_OF_PROFILES, log, profile)

    assert first_difference(*logs.values()) is None
