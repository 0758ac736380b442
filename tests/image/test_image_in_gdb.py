"""gdb-multiarch, which nobody here wrote, on the image in QEMU and on the emulated board: the world waits for it."""

import json
import os
import shutil
import socket
from pathlib import Path

import pytest

from host_sim.base.errors import RobotError
from host_sim.emulator.board import start_board
from host_sim.emulator.gdb_stub import GdbStub
from tests.runs.support import octet_process

OPTIONS = ("--environments", "1", "--quiet", "--limit-s")
ROBOTS = ("qemu", "emulated")


@pytest.fixture
def debugged(tmp_path):
    """Does a run in gdb with these words; its files are in tmp_path."""

    def debugged(robot, limit_s, words):
        return octet_process("run", "--robot", robot, *OPTIONS, limit_s, "--gdb", "--out", tmp_path, input=words)

    return debugged


@pytest.mark.parametrize("robot", ROBOTS)
def test_run_waits_while_the_image_is_at_a_breakpoint(robot, debugged, tmp_path):
    done = debugged(robot, "4", "delete\nbreak brain_next\ncontinue\nshell sleep 6\nbacktrace\ndelete\ncontinue\n")

    assert done.returncode == 0, done.stdout + done.stderr
    assert "caution_next" in done.stdout
    (told,) = json.loads((tmp_path / "summary.json").read_text())["robots"]
    assert told["frames"]["lost"] == 0


@pytest.mark.parametrize("robot", ROBOTS)
def test_run_begins_when_the_debugger_is_there(robot, debugged, tmp_path, monkeypatch):
    slow = tmp_path / "gdb-multiarch"
    slow.write_text(f'#!/bin/sh\nsleep 4\nexec {shutil.which(slow.name)} "$@"\n')
    slow.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)

    done = debugged(robot, "1", "delete\ntbreak brain_next\ncontinue\ncontinue\n")

    assert done.returncode == 0, done.stdout + done.stderr
    assert "Temporary breakpoint 2, " in done.stdout


@pytest.mark.parametrize(("robot", "end"), [("qemu", "kill\n"), ("emulated", "kill\n"), ("emulated", "")])
def test_leaving_the_debugger_ends_an_image_run(robot, end, debugged):
    done = debugged(robot, "600", f"continue\n{end}quit\n")

    assert done.returncode == 1
    assert "the debugger was left before the run had ended" in done.stderr


@pytest.mark.parametrize("board", ["feather_stm32f405", "blue_pill", "nucleo_g431rb"])
def test_debugger_leaves_the_log_of_an_emulated_board_unchanged(board, tmp_path):
    words = "continue\n" + "next\nstepi\ncontinue\n" * 20 + "finish\ndetach\n"
    run = ("run", "--robot", "emulated", "--board", board, *OPTIONS, "3")

    done = octet_process(*run, "--gdb", "--out", tmp_path / "with", input=words)
    octet_process(*run, "--out", tmp_path / "without").check_returncode()

    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("Breakpoint 1, ") >= 20
    assert (tmp_path / "with/run.log").read_bytes() == (tmp_path / "without/run.log").read_bytes()


def test_gdb_prints_and_changes_the_memory_of_an_emulated_robot(debugged):
    words = "continue\nprint robot->node\nset var robot->uptime_s = 77\nprint robot->uptime_s\nprint/x $pc\ndetach\n"

    done = debugged("emulated", "1", words)

    assert done.returncode == 0, done.stdout + done.stderr
    assert "= 77" in done.stdout


class Client:
    """A client that knows no manners."""

    def __init__(self, path: Path) -> None:
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(str(path))
        self.socket.settimeout(10.0)

    def send(self, *packets: str) -> None:
        self.socket.sendall(b"".join(f"${it}#{sum(it.encode()) % 256:02x}".encode() for it in packets))

    def answers(self) -> list[str]:
        """All that it has been sent."""
        self.socket.setblocking(False)
        return [part.partition("#")[0] for part in self.socket.recv(1 << 20).decode().split("$")[1:]]


@pytest.fixture
def board():
    return start_board("blue_pill")


@pytest.fixture
def client(board, tmp_path):
    stub = GdbStub(board.hardware.core, tmp_path / "gdb")
    client = Client(tmp_path / "gdb")
    yield client
    stub.close()
    client.socket.close()


WRONG = [
    *("m", "m,", "m0", "m-1,4", "m20000000,0x4", "m 0,4", "m20000000,ffffffffffff", "mffffffff,4", "m40000000,4"),
    *("M20000000,4:00", "M20000000,1:zz", "M8000000,1:00", "M20000000", "P0=00", "P11=00000000"),
    *("Z0,", "Z1,xyz,2", "z0,", "qXfer:features:read:target.xml:x,y", "P", "M", "Z0,-4,2"),
]


def test_malformed_requests_are_answered_with_an_error(board, client):
    client.send(*WRONG, "D")

    board.pass_time(0.02)

    assert client.answers() == ["E01"] * len(WRONG) + ["OK"]


def test_unknown_requests_get_an_empty_answer(board, client):
    unknown = [
        *("", "Z0", "G00", "p1", "vCont?", "vMustReplyEmpty", "qSymbol::", "Z2,20000000,4", "X20000000,0:", "!"),
        "\u00e4",
    ]
    client.send(*unknown, "qSupported:a;b", "?", "Hg0", "qAttached", "D")

    board.pass_time(0.02)

    known = ["PacketSize=1000;qXfer:features:read+", "S05", "OK", "0", "OK"]
    assert client.answers() == [""] * len(unknown) + known


def test_packet_with_a_wrong_checksum_is_requested_again(board, client):
    client.socket.sendall(b"+-\x03$?#00")
    client.send("?", "D")

    board.pass_time(0.02)

    assert client.socket.recv(4) == b"-+$S"


@pytest.mark.parametrize("sent", [b"GET / HTTP/1.1\r\n\r\n", b"$" + b"m" * 9000, b"#", b"$?#zz" + b"$" * 9, b"\xff"])
def test_gdb_stub_drops_a_client_with_another_protocol(board, client, sent):
    client.socket.sendall(sent)
    client.socket.shutdown(socket.SHUT_WR)

    with pytest.raises(RobotError, match="the debugger"):
        board.pass_time(0.02)

    board.pass_time(0.1)  # the board goes on


def test_breakpoints_are_limited_and_second_client_is_refused(board, client, tmp_path):
    client.send(*(f"Z0,{0x8000000 + 2 * n:x},2" for n in range(70)), "D")

    board.pass_time(0.02)

    assert client.answers().count("E01") == 6
    assert not board.hardware.core.breakpoints
    with socket.socket(socket.AF_UNIX) as other, pytest.raises(ConnectionRefusedError):
        other.connect(str(tmp_path / "gdb"))


def test_interrupt_halts_a_running_core(board, client):
    client.send("c")
    board.pass_time(0.02)
    client.socket.sendall(b"\x03")
    client.send("g", "D")

    board.pass_time(0.02)

    halted, registers, _ = client.answers()
    assert halted == "S02"
    assert len(registers) == 17 * 8
