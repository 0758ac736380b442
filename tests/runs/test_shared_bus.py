"""A bus that others use too, and that goes down and comes back: real SocketCAN."""

import subprocess
import time

import pytest

from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import Opcode
from tests.runs.support import DEADLINE_S, halted, octet, start_octet, wait_for_lines
from tests.runs.test_slcan import drives_in

pytestmark = [pytest.mark.vcan, pytest.mark.faulty]
VCAN = ("--bus", "socketcan:vcan0")
LONG = ("--environments", "20", "--quiet")


def test_bus_that_goes_down_and_comes_back_changes_no_drive(run, tmp_path):
    subprocess.run(["ip", "link", "add", "dev", "vcan8", "type", "vcan"], check=True)
    subprocess.run(["ip", "link", "set", "vcan8", "up"], check=True)
    words = ("--environments", "1", "--seed", "3", "--limit-s", "60")
    process = start_octet("run", "--out", tmp_path / "shaken", *words, "--bus", "socketcan:vcan8")
    for lines, pause_s in ((500, 0.01), (1000, 0.3)):
        wait_for_lines(process, tmp_path / "shaken/run.log", lines)
        with halted(process):
            subprocess.run(["ip", "link", "set", "vcan8", "down"], check=True)
        time.sleep(pause_s)
        subprocess.run(["ip", "link", "set", "vcan8", "up"], check=True)

    output, errors = process.communicate(timeout=DEADLINE_S)
    subprocess.run(["ip", "link", "del", "vcan8"], check=True)
    quiet = run(*words, "--bus", "none")
    assert errors == ""
    assert process.returncode == 0
    assert drives_in((tmp_path / "shaken/run.log").read_bytes()) == drives_in(quiet.log)
    assert "gone" in output


def test_second_robot_with_the_same_number_ends_the_run(tmp_path, robot_on):
    process = start_octet("run", "--out", tmp_path, *LONG, *VCAN)
    wait_for_lines(process, tmp_path / "run.log", 1000)

    robot_on("socketcan:vcan0")

    _, errors = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert "two robots are node 1 on this bus" in errors
    assert errors.count("\n") == 1


def test_second_simulator_leaves_a_driven_robot_alone(tmp_path):
    first = start_octet("run", "--out", tmp_path / "first", *LONG, *VCAN)
    wait_for_lines(first, tmp_path / "first/run.log", 1000)

    second = octet("run", "--out", tmp_path / "second", *LONG, *VCAN, "--robot", "external", "--owner", "2")

    assert second.returncode == 1
    assert "node 1 is driven by another simulator" in second.stderr
    assert first.poll() is None
    first.kill()
    first.communicate()


def test_forged_stop_ends_the_run(tmp_path):
    frame = Protocol().encode("COMMAND", {"counter": 9, "opcode": Opcode.STOP, "owner": 9})
    process = start_octet("run", "--out", tmp_path, *LONG, *VCAN)
    wait_for_lines(process, tmp_path / "run.log", 1000)

    subprocess.run(["cansend", "vcan0", f"{frame.id:03X}#{frame.data.hex()}"], check=True)

    _, errors = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert "somebody else stopped node 1" in errors


def test_ten_thousand_foreign_frames_a_second_do_no_harm(run):
    words = ("--environments", "1", "--limit-s", "20", "--seed", "3")
    talkers = [subprocess.Popen(["cangen", "vcan0", "-g", "0.2", "-I", "r", "-L", "r"]) for _ in range(2)]

    done = run(*words, *VCAN)
    for talker in talkers:
        talker.kill()
        talker.wait()

    quiet = run(*words, "--bus", "none")
    assert (done.code, done.errors) == (0, "")
    assert drives_in(done.log) == drives_in(quiet.log)
    assert done.memory == quiet.memory
