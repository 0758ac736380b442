"""Opening buses of python-can, and programs of one's own on them."""

import errno
import os
import sys
from contextlib import closing
from unittest.mock import Mock

import can
import pytest

from host_sim.base.errors import LinkDownError, OctetError, UsageError
from host_sim.protocol.codec import Frame
from host_sim.transport.bus_process import BusProcess, start_on_socket_pair
from host_sim.transport.buses import open_bus, open_bus_link, receive
from host_sim.transport.link import LineStats


@pytest.fixture
def opened(monkeypatch) -> list[dict]:
    """What python-can was asked to open."""
    calls: list[dict] = []
    monkeypatch.setattr(can, "Bus", lambda **options: calls.append(options))
    return calls


@pytest.mark.parametrize(
    ("bus", "option", "value"),
    [
        ("pcan:PCAN_USBBUS1", "bitrate", 125_000),
        ("socketcan:can0", "bitrate", None),  # the kernel has it
        ("slcan:/dev/ttyACM0", "sleep_after_open", 0.0),
    ],
)
def test_bus_is_opened_with_the_options_of_its_kind(opened, bus, option, value):
    open_bus(bus, bitrate=125_000)

    assert opened[0].get(option) == value


@pytest.mark.parametrize("bus", ["", "vcan0", "socketcan:", ":vcan0"])
def test_malformed_bus_name_is_answered_with_an_example(bus):
    with pytest.raises(UsageError, match="socketcan:vcan0, not"):
        open_bus(bus)


def test_interface_options_follow_a_question_mark(opened):
    open_bus("socketcand:can0?host=10.0.0.7&port=29536&tcp_tune=true")

    assert opened[0]["interface"], opened[0]["channel"] == ("socketcand", "can0")
    assert {name: opened[0][name] for name in ("host", "port", "tcp_tune")} == {
        "host": "10.0.0.7",
        "port": 29536,
        "tcp_tune": True,
    }


@pytest.mark.parametrize(
    ("bus", "told"),
    [
        ("kvaser:0", "CANlib|canlib|driver"),
        ("gs_usb:0", "needs the package gs-usb: .* -m pip install 'python-can\\[gs-usb\\]'"),
        ("udp_multicast:239.0.0.1", "needs the package msgpack: .*'python-can\\[multicast\\]'"),
        (
            "socketcand:can0",
            "'host' and 'port'; its options follow a question mark, as in --bus 'socketcand:can0[?]host",
        ),
        ("nosuch:0", "name an interface that python-can has"),
    ],
)
def test_missing_requirement_of_an_interface_is_reported(bus, told):
    for _ in range(2):  # what python-can logs once, when it is loaded, is not needed
        with pytest.raises(UsageError, match=f"^cannot open the bus {bus}: [^\n]*({told})"):
            open_bus(bus)


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (OSError("no such\nthing"), "no such"),
        (can.CanInterfaceNotImplementedError(), "CanInterf"),
        (TypeError("2 required arguments are missing"), "2 required"),  # an interface that wants more than a channel
    ],
)
def test_unopenable_bus_is_reported_in_one_line(monkeypatch, error, told):
    monkeypatch.setattr(can, "Bus", Mock(side_effect=error))

    with pytest.raises(UsageError, match=f"^cannot open the bus pcan:X: {told}[^\n]*$"):
        open_bus("pcan:X")


class Bus:
    """A bus on which frames came before it had its filters."""

    def __init__(self, frames: int) -> None:
        self.frames = frames

    def recv(self, _timeout: float) -> can.Message | None:
        self.frames -= 1
        return can.Message() if self.frames >= 0 else None


@pytest.mark.parametrize("error", [can.CanOperationError("Network is down", 100), OSError(100, "Network is down")])
def test_bus_that_is_down_raises_link_down(monkeypatch, error):
    monkeypatch.setattr(can, "Bus", Mock(side_effect=error))

    with pytest.raises(LinkDownError, match="the bus socketcan:can0 is down: "):
        open_bus("socketcan:can0")


def test_frames_before_the_filters_are_set_are_discarded(monkeypatch):
    monkeypatch.setattr(can, "Bus", lambda **_: Bus(frames=3))

    assert open_bus("socketcan:can0", [0x41]).recv(0.0) is None


def test_bus_that_goes_down_during_open_is_shut_down(monkeypatch):
    class GoingBus(Bus):
        def recv(self, _timeout: float) -> None:
            raise can.CanOperationError("network is down")

        def shutdown(self) -> None:
            self.is_down = True

    bus = GoingBus(frames=0)
    monkeypatch.setattr(can, "Bus", lambda **_: bus)

    with pytest.raises(UsageError, match="network is down"):
        open_bus("socketcan:can0", [0x41])
    assert bus.is_down


class FailingBus(Bus):
    """A bus that raises an error instead of receiving."""

    def __init__(self, error: Exception) -> None:
        super().__init__(frames=0)
        self.error = error

    def recv(self, _timeout: float) -> None:
        raise self.error


def test_receive_returns_a_frame_or_none():
    bus = Bus(frames=1)

    assert receive(bus, 0.0) is not None
    assert receive(bus, 0.0) is None


def test_malformed_text_counts_as_an_error_frame():
    message = receive(FailingBus(ValueError("not hexadecimal")), 0.0)

    assert message is not None
    assert message.is_error_frame


@pytest.mark.parametrize("error", [can.CanOperationError("network is down"), OSError("no such device")])
def test_failed_receive_is_reported_in_one_line(error):
    with pytest.raises(OctetError, match=f"^the bus is gone: {error}$"):
        receive(FailingBus(error), 0.0)


def test_frames_are_kept_without_filters(monkeypatch):
    monkeypatch.setattr(can, "Bus", lambda **_: Bus(frames=3))

    assert open_bus("socketcan:can0").recv(0.0) is not None


def test_continuously_busy_bus_is_opened(monkeypatch):
    monkeypatch.setattr(can, "Bus", lambda **_: Bus(frames=10**9))

    assert open_bus("socketcan:can0", [0x41]).recv(0.0) is not None


def test_only_socketcan_has_a_frame_socket(monkeypatch):
    monkeypatch.setattr(can, "Bus", lambda **_: Bus(frames=0))

    on_the_kernel, on_an_adapter = (open_bus_link(bus, [], LineStats()) for bus in ("socketcan:can0", "pcan:X"))

    assert on_the_kernel.frame_socket() is on_the_kernel
    assert on_an_adapter.frame_socket() is None


def test_put_back_frame_is_received_before_the_socket_is_lent(monkeypatch):
    monkeypatch.setattr(can, "Bus", lambda **_: Bus(frames=0))
    link = open_bus_link("socketcan:can0", [], LineStats())

    link.put_back(Frame(0x41, b"1"))

    assert link.frame_socket() is None
    assert link.receive(0.0) == Frame(0x41, b"1")
    assert link.frame_socket() is link


@pytest.mark.parametrize(
    ("number", "hint"), [(errno.EAFNOSUPPORT, "tools/with-vcan COMMAND"), (errno.ENODEV, "`ip link` lists")]
)
def test_bus_error_names_its_remedy_where_known(monkeypatch, number, hint):
    monkeypatch.setattr(can, "Bus", Mock(side_effect=OSError(number, "so it is")))

    with pytest.raises(UsageError, match=f"cannot open the bus socketcan:can0: .*so it is; .*{hint}"):
        open_bus("socketcan:can0")


ECHO = """\
import os, socket
bus = socket.socket(fileno=int(os.environ['CAN_CHANNEL']))
while frame := bus.recv(16):
    bus.send(frame)"""


def test_program_gets_its_socket_through_the_environment():
    link, process = start_on_socket_pair(f'{sys.executable} -c "{ECHO}"', {})
    with closing(link), closing(process):
        link.send(Frame(0x123, b"abc"))

        assert link.receive(10.0) == Frame(0x123, b"abc")
        assert process.status() == "is running"


def test_program_gets_bus_and_extra_variables_in_its_environment(tmp_path):
    told = tmp_path / "told"
    process = BusProcess(f"sh -c 'env > {told}'", "socketcan:vcan9", {"OCTET_NODE": "3"})
    with closing(process), pytest.raises(LinkDownError):
        process.account_for_silence()

    assert {"CAN_INTERFACE=socketcan", "CAN_CHANNEL=vcan9", "OCTET_NODE=3"} <= set(told.read_text().split("\n"))


def test_link_reports_exit_code_and_output_of_its_program():
    link, process = start_on_socket_pair("sh -c 'echo no brakes; exit 3'", {})
    with closing(link), closing(process), pytest.raises(LinkDownError, match=r"ended with exit code 3 .* no brakes"):
        link.receive(10.0)


def test_link_reports_the_signal_that_killed_its_program():
    link, process = start_on_socket_pair("sh -c 'kill -9 $$'", {})
    with closing(link), closing(process), pytest.raises(LinkDownError, match="by signal 9 and printed nothing"):
        link.receive(10.0)


def test_children_of_a_program_end_with_it(tmp_path):
    ready = tmp_path / "ready"
    os.mkfifo(ready)
    link, process = start_on_socket_pair(f"sh -c '(echo > {ready}; exec sleep 60) & wait'", {})
    with closing(link), ready.open():
        process.close()

        with pytest.raises(LinkDownError):  # the last who has the other end open is gone
            link.receive(10.0)


CANNOT = {"no-such": "No such file", " ": "it is empty", "'": "quotation"}


@pytest.mark.parametrize(("command", "reason"), CANNOT.items())
def test_unstartable_program_is_reported(command, reason):
    with pytest.raises(UsageError, match=reason):
        start_on_socket_pair(command, {})
