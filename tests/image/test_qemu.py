"""The slcan image in QEMU, joined to the simulator."""

import errno
import gc
import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import ExitStack

import pytest

from host_sim.base.errors import OctetError, RobotError, UsageError
from host_sim.base.paths import image_path
from host_sim.protocol.codec import Frame
from host_sim.sim.access import Access
from host_sim.sim.connect import Connector
from host_sim.sim.qemu import Qemu
from host_sim.transport.slcan_link import SlcanLink
from tests.image.support import run_robot

ROBOT = "import time, host_sim.sim.qemu as q; robot = q.Qemu(); print(robot.pid, flush=True); time.sleep(60)"


@pytest.fixture
def qemu():
    robot = Qemu()
    yield robot
    robot.close()


@pytest.fixture
def line():
    ours, theirs = socket.socketpair()
    link = SlcanLink(ours)
    yield link, theirs
    link.close()
    theirs.close()


def is_running(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_robot_in_qemu_learns_and_its_process_ends(tmp_path):
    with ExitStack() as stack:
        connection = Connector(stack, Access("fd", "qemu")).connection(1)
        session = run_robot(connection, 1, 1000, tmp_path / "run.log")

    assert any(session.memory)
    assert set(session.faults.values()) == {0}
    assert (session.frames.lost, session.frames.refused) == (0, 0)
    assert not is_running(connection.pid)


def test_failed_start_of_qemu_is_reported_and_leaks_nothing(monkeypatch):
    def fail(*_: object, **__: object) -> None:
        raise FileNotFoundError(errno.ENOENT, "No such file or directory", "setpriv")

    monkeypatch.setattr(subprocess, "Popen", fail)

    with pytest.raises(OctetError, match=r"cannot start qemu-system-arm: .*'setpriv'"):
        Qemu()
    gc.collect()  # a socket that is left open is a warning, and that an error


def test_death_of_qemu_is_reported(qemu):
    os.kill(qemu.pid, signal.SIGKILL)

    with pytest.raises(RobotError, match="closed"):
        qemu.link.receive(5.0)
    os.waitid(os.P_PID, qemu.pid, os.WEXITED | os.WNOWAIT)
    with pytest.raises(RobotError, match="QEMU ended with exit code -9"):
        qemu.status()


def test_qemu_ends_with_the_process_that_started_it():
    starter = subprocess.Popen([sys.executable, "-c", ROBOT], stdout=subprocess.PIPE, text=True)
    pid = int(starter.stdout.readline())
    starter.kill()
    starter.communicate()

    give_up = time.monotonic() + 600
    while is_running(pid) and time.monotonic() < give_up:
        time.sleep(0.01)
    assert not is_running(pid)


def test_missing_qemu_is_reported_with_the_setup_command(monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")

    with pytest.raises(OctetError, match="tools/setup images"):
        Qemu()


def test_missing_image_is_reported_with_the_setup_command(monkeypatch, tmp_path):
    monkeypatch.setattr("host_sim.base.paths.BUILD", tmp_path)

    with pytest.raises(OctetError, match="tools/setup images"):
        image_path("feather_stm32f405", "slcan")


def test_invalid_image_ends_qemu_with_its_reason(tmp_path):
    with pytest.raises(RobotError, match=r"QEMU ended with exit code 1 and printed: .*nothing\.elf"):
        Qemu(tmp_path / "nothing.elf")


def test_silent_image_times_out(monkeypatch):
    monkeypatch.setattr("host_sim.sim.qemu._READY_S", 0.001)

    with pytest.raises(RobotError, match=r"sent nothing for 0\.001 s; it is running in QEMU"):
        Qemu()


def test_image_that_never_pauses_becomes_ready(monkeypatch):
    monkeypatch.setattr("host_sim.sim.qemu._PAUSE_S", 5.0)  # heartbeats come each second
    monkeypatch.setattr("host_sim.sim.qemu._READY_S", 1.0)

    qemu = Qemu()

    assert qemu.status() == "is running in QEMU"
    qemu.close()


@pytest.mark.parametrize("robot", ["qemu", "emulated"])
def test_emulator_refuses_another_bus_or_node(robot):
    with pytest.raises(UsageError, match="its own bus"):
        Access("socketcan:vcan0", robot)
    with pytest.raises(UsageError, match="is node 1, not 2"):
        Access("fd", robot, [2])


def test_unknown_board_is_reported_with_the_known_ones():
    with ExitStack() as stack, pytest.raises(UsageError, match="no board 'stm32f999'; there are feather_stm32f405,"):
        Connector(stack, Access("fd", "emulated", board="stm32f999")).connection(1)


def test_serial_line_carries_frames_as_slcan_text(line):
    link, far = line

    link.send(Frame(0x41, b"\x01\xab"))
    far.sendall(b"t0812FF00\rt7FF0\r")

    assert far.recv(100) == b"t041201AB\r"
    assert [link.receive(1.0), link.receive(1.0)] == [Frame(0x81, b"\xff\x00"), Frame(0x7FF, b"")]
    assert link.receive(0.0) is None


@pytest.mark.parametrize("text", [b"t0812FF\r", b"t0811FF00\r", b"T000000810\r", b"nonsense\r", b"t0819\r"])
def test_line_without_a_data_frame_has_no_identifier(line, text):
    link, far = line

    far.sendall(text)

    assert link.receive(1.0) == Frame(-1, b"")


def test_closed_far_end_raises_an_error(line):
    link, far = line
    far.close()

    with pytest.raises(RobotError, match="closed"):
        link.receive(1.0)
    with pytest.raises(RobotError, match="cannot send"):
        link.send(Frame(1, b""))
