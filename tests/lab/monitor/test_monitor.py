"""`tools/octet monitor` as a command, on a bus of python-can within this process and on vcan0."""

import contextlib
import io
import itertools
import json
import os
import pty
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import can
import pytest

from host_sim.cli.main import main
from host_sim.lab.monitor.bus_watch import BusWatch
from host_sim.lab.monitor.kernel_queue import dropped, lengthen
from host_sim.lab.monitor.monitor import filter_robots, watch_lines
from host_sim.protocol.codec import NODE_MAX, Protocol
from host_sim.protocol.every_node import IDS
from host_sim.transport.buses import open_bus
from tests.runs.support import DEADLINE_S, octet

MONITOR = (sys.executable, "-m", "host_sim", "monitor")
STOPPED = Protocol().encode("COMMAND", {"counter": 1, "opcode": 1, "owner": 3})


@contextlib.contextmanager
def talking(channel: str) -> Iterator[None]:
    """A command and a frame that is no robot's, on a virtual bus, again and again."""
    stop = threading.Event()

    def talk() -> None:
        with can.Bus(interface="virtual", channel=channel) as bus:
            while not stop.wait(0.01):
                bus.send(can.Message(arbitration_id=STOPPED.id, data=STOPPED.data, is_extended_id=False))
                bus.send(can.Message(arbitration_id=0x7FF, data=b"\x01\x02", is_extended_id=False))

    thread = threading.Thread(target=talk)
    thread.start()
    try:
        yield
    finally:
        stop.set()
        thread.join()


def monitored(capsys, channel: str, *words: str) -> list[str]:
    with talking(channel):
        assert main(["monitor", f"virtual:{channel}", "--limit-s", "0.5", *words]) == 0
    output = capsys.readouterr()
    assert output.err == ""
    return output.out.splitlines()


def test_off_a_terminal_each_frame_is_a_line(capsys):
    lines = monitored(capsys, "lines")

    assert lines
    assert all(re.fullmatch(r"\d+\.\d{6}   1  COMMAND counter=1 opcode=stop owner=3", line) for line in lines)


def test_other_frames_are_shown_when_asked_for(capsys):
    lines = monitored(capsys, "all", "--all")

    assert any(re.fullmatch(r"\d+\.\d{6}   -  7FF#0102", line) for line in lines)


def test_the_filter_lets_every_robot_through_and_little_else():
    with can.Bus(interface="virtual", channel="filter") as bus:
        filter_robots(bus)

        through = {it for it in range(0x800) if any((it ^ f["can_id"]) & f["can_mask"] == 0 for f in bus.filters)}

    assert through >= IDS
    assert len(through) == len(IDS) // NODE_MAX * (NODE_MAX + 1)


@pytest.mark.parametrize("bus", ["socketcan:nothere", "nothing", "slcan:/dev/nothere"])
def test_a_bus_that_is_not_there_is_one_line(capsys, bus):
    assert main(["monitor", bus]) == 2

    assert re.fullmatch(r"octet: .*\n", capsys.readouterr().err)


class FullBus:
    """A bus on which frames wait: so many, or without end."""

    def __init__(self, frames: int | None = None) -> None:
        self.left = itertools.count() if frames is None else iter(range(frames))

    def recv(self, _timeout_s: float) -> can.Message | None:
        waits = next(self.left, None) is not None
        return can.Message(arbitration_id=STOPPED.id, data=STOPPED.data, is_extended_id=False) if waits else None


@pytest.mark.parametrize(("frames", "shown"), [(30, 30), (None, 19)])
def test_at_its_end_it_shows_all_that_waits_however_long_that_takes_on_a_held_up_host(monkeypatch, frames, shown):
    late, busy = itertools.count(step=5.0), itertools.count(step=0.1 if frames is None else 0.0)
    held_up = SimpleNamespace(monotonic=lambda: next(late), process_time=lambda: next(busy))
    monkeypatch.setattr("host_sim.lab.monitor.monitor.time", held_up)
    out = io.StringIO()

    watch_lines(FullBus(frames), BusWatch(500_000), out, goes_on=lambda: False)

    assert out.getvalue().count("COMMAND") == shown


@pytest.fixture
def on_vcan():
    """Starts monitors of vcan0, and ends them."""
    processes = []

    def start(*words: str, **streams: object) -> subprocess.Popen:
        processes.append(subprocess.Popen([*MONITOR, "socketcan:vcan0", *words], **streams))
        return processes[-1]

    yield start
    for process in processes:
        process.kill()
        process.wait()
        for stream in (process.stdout, process.stderr):
            if stream is not None:
                stream.close()


def wait_until_it_listens(process: subprocess.Popen) -> None:
    """Until its socket has its filters: the kernel lists it among the receivers of vcan0."""
    give_up = time.monotonic() + DEADLINE_S
    while f"{STOPPED.id & ~NODE_MAX:03x}" not in Path("/proc/net/can/rcvlist_fil").read_text():
        assert process.poll() is None
        assert time.monotonic() < give_up
        time.sleep(0.05)


@pytest.mark.vcan
def test_on_vcan_it_shows_the_frames_of_a_run_and_the_kernel_keeps_others_away(on_vcan, tmp_path):
    process = on_vcan(stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    wait_until_it_listens(process)
    subprocess.run(["cansend", "vcan0", "7FF#0102"], check=True)

    run = octet(
        "run", "--environments", "1", "--limit-s", "2", "--out", tmp_path, "--bus", "socketcan:vcan0", "--quiet"
    )
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=DEADLINE_S)

    assert run.returncode == 0
    assert (process.returncode, errors) == (0, "")
    names = [line.split()[2] for line in output.splitlines() if not line.startswith("!")]
    frames = json.loads((tmp_path / "summary.json").read_text())["robots"][0]["frames"]
    assert names.count("SENSES") + names.count("COMMAND") == frames["sent"] + frames["repeated"] > 100
    assert "-" not in [line.split()[1] for line in output.splitlines()]


@pytest.mark.vcan
def test_it_shows_what_came_before_it_was_asked_to_end(on_vcan):
    process = on_vcan(stdout=subprocess.PIPE, text=True)
    wait_until_it_listens(process)
    process.send_signal(signal.SIGSTOP)
    subprocess.run(["cangen", "vcan0", "-g", "0", "-n", "400", "-I", f"{STOPPED.id:03X}"], check=True)

    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGCONT)
    output, _ = process.communicate(timeout=DEADLINE_S)

    assert len([line for line in output.splitlines() if not line.startswith("!")]) == 400


@pytest.mark.vcan
def test_the_kernel_tells_what_it_had_no_room_for():
    with open_bus("socketcan:vcan0") as bus, open_bus("socketcan:vcan0") as talker:
        bus.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 0)
        for _ in range(100):
            talker.send(can.Message(arbitration_id=1, is_extended_id=False))
        heard = sum(1 for _ in iter(lambda: bus.recv(0.0), None))

        assert 0 < dropped(bus) == 100 - heard


@pytest.mark.vcan
def test_it_has_the_kernel_keep_more():
    with open_bus("socketcan:vcan0") as bus:
        before = bus.socket.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF)

        lengthen(bus)

        assert bus.socket.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) > before


def test_a_bus_that_is_no_socket_has_no_such_queue():
    with can.Bus(interface="virtual", channel="queue") as bus:
        lengthen(bus)

        assert dropped(bus) == 0


@pytest.mark.vcan
def test_a_reader_that_goes_ends_it_quietly(on_vcan):
    process = on_vcan("--all", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    noise = subprocess.Popen(["cangen", "vcan0", "-g", "1"])
    try:
        assert process.stdout.readline()
        process.stdout.close()
        assert process.wait(timeout=DEADLINE_S) == 1
    finally:
        noise.kill()
        noise.wait()
    assert process.stderr.read() == b""


@pytest.mark.vcan
def test_on_a_terminal_it_is_a_table_and_restores_the_screen(on_vcan):
    ours, theirs = pty.openpty()
    process = on_vcan(stdin=theirs, stdout=theirs, stderr=theirs, env={**os.environ, "TERM": "xterm"})
    os.close(theirs)
    seen = b""
    while b"vcan0" not in seen:
        seen += os.read(ours, 4096)

    process.send_signal(signal.SIGINT)
    with contextlib.suppress(OSError):  # the far end of a pty is closed when the process has ended
        while chunk := os.read(ours, 4096):
            seen += chunk
    os.close(ours)

    assert process.wait(timeout=DEADLINE_S) == 0
    assert seen.startswith(b"\x1b[?1049h")
    assert seen.endswith(b"\x1b[?1049l")
    assert b"no robot is heard" in seen
    assert b"Traceback" not in seen
