"""Programs of one's own on a bus."""

import os
import sys
from contextlib import closing

import pytest

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.base.frame import Frame
from host_sim.transport.bus_process import BusProcess, start_on_socket_pair

ECHO = """\
import os, socket
bus = socket.socket(fileno=int(os.environ['CAN_CHANNEL']))
while frame := bus.recv(16):
    bus.send(frame)"""


def test_a_program_finds_its_socket_in_its_environment():
    link, process = start_on_socket_pair(f'{sys.executable} -c "{ECHO}"', {})
    with closing(link), closing(process):
        link.send(Frame(0x123, b"abc"))

        assert link.receive(10.0) == Frame(0x123, b"abc")
        assert process.status() == "is running"


def test_a_program_is_told_more_and_where_another_bus_is(tmp_path):
    told = tmp_path / "told"
    process = BusProcess(f"sh -c 'env > {told}'", "socketcan:vcan9", {"OCTET_NODE": "3"})
    with closing(process), pytest.raises(LinkDownError):
        process.account_for_silence()

    assert {"CAN_INTERFACE=socketcan", "CAN_CHANNEL=vcan9", "OCTET_NODE=3"} <= set(told.read_text().split("\n"))


def test_a_link_tells_how_its_program_ended():
    link, process = start_on_socket_pair("sh -c 'echo no brakes; exit 3'", {})
    with closing(link), closing(process), pytest.raises(LinkDownError, match=r"ended with exit code 3 .* no brakes"):
        link.receive(10.0)


def test_a_program_that_was_killed_printed_nothing():
    link, process = start_on_socket_pair("sh -c 'kill -9 $$'", {})
    with closing(link), closing(process), pytest.raises(LinkDownError, match="by signal 9 and printed nothing"):
        link.receive(10.0)


def test_what_a_program_has_started_ends_with_it(tmp_path):
    ready = tmp_path / "ready"
    os.mkfifo(ready)
    link, process = start_on_socket_pair(f"sh -c '(echo > {ready}; exec sleep 60) & wait'", {})
    with closing(link), ready.open():
        process.close()

        with pytest.raises(LinkDownError):  # the last who has the other end open is gone
            link.receive(10.0)


CANNOT = {"no-such": "No such file", " ": "it is empty", "'": "quotation"}


@pytest.mark.parametrize(("command", "reason"), CANNOT.items())
def test_what_cannot_be_started_is_told(command, reason):
    with pytest.raises(UsageError, match=reason):
        start_on_socket_pair(command, {})
