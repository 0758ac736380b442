"""Whole runs over real SocketCAN."""

import re
import signal
import subprocess
import time
from collections import deque
from pathlib import Path

import can
import pytest

from tests.runs.support import octet, robot_of, start_octet, wait_for_lines, wait_until

pytestmark = pytest.mark.vcan
VCAN = ("--bus", "socketcan:vcan0")
WAITS = re.compile("041#.{6}0{6}.{4}|6A1#.*")
"""What a robot says while it waits, and no log holds: each 100 ms a DRIVE without speed, each second a HEARTBEAT."""


@pytest.fixture
def candump(tmp_path):
    """candump, once it hears what is on the bus, and the file that it writes."""
    heard = tmp_path / "candump.log"
    with heard.open("w") as file:
        # Room for a run's frames, for when others have the processor.
        process = subprocess.Popen(["candump", "-L", "-r", "8000000", "vcan0"], stdout=file)
    with can.Bus(interface="socketcan", channel="vcan0") as sender:
        wait_until(lambda: listens(process, sender), "candump")
    yield process, heard
    process.kill()
    process.wait()


def listens(candump: subprocess.Popen, sender: can.BusABC) -> bool:
    sender.send(can.Message(arbitration_id=0x7FF, is_extended_id=False))
    time.sleep(0.05)
    return any("socket:" in str(fd.readlink()) for fd in Path(f"/proc/{candump.pid}/fd").iterdir())


def frames_in(text: str) -> list[str]:
    whole_lines = text.rpartition("\n")[0]  # the last one may still be being written
    return [line.split()[2] for line in whole_lines.splitlines() if "7FF#" not in line]


def test_candump_sees_the_frames_of_the_log_and_otherwise_only_repeats(run, candump):
    process, heard = candump

    done = run("--environments", "1", "--limit-s", "20", *VCAN)
    sent = frames_in(done.log.decode())
    wait_until(lambda: len(frames_in(heard.read_text())) > len(sent), "all frames in candump")
    process.send_signal(signal.SIGINT)
    process.wait()

    assert (done.code, done.errors) == (0, "")
    frames = frames_in(heard.read_text())
    frames.remove(next(frame for frame in frames if frame.startswith("6C1#")))  # of the robot's power-up
    assert [frame for frame in beside(sent, frames) if frame not in sent and not WAITS.fullmatch(frame)] == []


def beside(sent: list[str], heard: list[str]) -> list[str]:
    """What was heard beside the frames that were sent, all of which were heard, in their order."""
    left = deque(sent)
    others = [frame for frame in heard if not (left and frame == left[0] and left.popleft())]
    assert not left
    return others


def test_run_over_vcan_leaves_the_same_bytes_as_in_process(run):
    words = ("--environments", "1", "--limit-s", "20", "--seed", "3")

    on_the_bus, within = run(*words, *VCAN), run(*words, "--bus", "none")

    assert on_the_bus.log == within.log
    assert octet("replay", on_the_bus.out / "run.log").returncode == 0


def test_auto_bus_chooses_vcan_where_there_is_one_and_says_so(run):
    done = run("--environments", "1", "--limit-s", "2", "--bus", "auto", process=True)

    assert done.code == 0
    assert "socketcan:vcan0" in done.output


def test_killed_robot_ends_the_run_with_one_line(tmp_path):
    process = start_octet("run", "--out", tmp_path, "--environments", "20", "--quiet", *VCAN)
    robot = robot_of(process)
    wait_for_lines(process, tmp_path / "run.log", 1000)

    subprocess.run(["kill", "-KILL", str(robot)], check=True)

    _, errors = process.communicate()
    assert process.returncode == 1
    assert errors.count("\n") == 1
    assert "killed by signal 9" in errors


@pytest.mark.faulty
def test_garbage_on_the_bus_is_refused_and_changes_no_drive(run):
    words = ("--environments", "1", "--limit-s", "20", "--seed", "3")
    quiet = run(*words, "--bus", "none")
    # Random frames of every kind and identifier, and frames with that of SENSES that are a byte too short.
    everywhere = subprocess.Popen(["cangen", "vcan0", "-g", "2", "-I", "i", "-L", "i", "-m"])
    cut_short = subprocess.Popen(["cangen", "vcan0", "-g", "5", "-I", "101", "-L", "7"])

    done = run(*words, *VCAN)
    for garbage in (everywhere, cut_short):
        garbage.kill()
        garbage.wait()

    assert (done.code, done.errors) == (0, "")
    frames = done.summary["robots"][0]["frames"]
    assert frames["refused"] > 0
    assert frames["lost"] == 0
    assert drives_in(done.log) == drives_in(quiet.log)
    assert done.memory == quiet.memory


def drives_in(log: bytes) -> list[bytes]:
    return re.findall(rb" (041#\w+)", log)


def test_vanished_interface_ends_the_run_with_one_line(tmp_path):
    subprocess.run(["ip", "link", "add", "dev", "vcan9", "type", "vcan"], check=True)
    subprocess.run(["ip", "link", "set", "vcan9", "up"], check=True)
    words = ("--environments", "20", "--quiet", "--bus", "socketcan:vcan9", "--reconnect-s", "0.5")
    process = start_octet("run", "--out", tmp_path, *words)
    wait_for_lines(process, tmp_path / "run.log", 1000)

    subprocess.run(["ip", "link", "del", "vcan9"], check=True)

    _, errors = process.communicate()
    assert process.returncode == 1
    assert errors.startswith("octet: ")
    assert errors.count("\n") == 1


def test_several_robots_on_vcan_leave_the_same_log_as_in_process(run):
    words = ("--robots", "4", "--environments", "1", "--limit-s", "10", "--seed", "4")

    assert run(*words, *VCAN).log == run(*words, "--bus", "none").log
