"""Opening an slcan adapter on a serial port."""

import os
import pty
import tty
from collections.abc import Iterator

import pytest

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.transport.buses import open_bus_link
from host_sim.transport.line_stats import LineStats
from host_sim.transport.slcan_link import SlcanLink


@pytest.fixture
def port() -> Iterator[tuple[int, str]]:
    """The adapter's end, and the name of ours."""
    adapter, ours = pty.openpty()
    tty.setraw(ours)
    yield adapter, os.ttyname(ours)
    os.close(adapter)
    os.close(ours)


@pytest.mark.parametrize(("speed", "bitrate", "order"), [("", 500_000, b"S6"), ("@9600", 125_000, b"S4")])
def test_the_adapter_is_told_the_bit_rate_of_the_bus(port, speed, bitrate, order):
    adapter, name = port

    link = open_bus_link(f"slcan:{name}{speed}", [], LineStats(), bitrate)

    assert os.read(adapter, 100) == b"\rC\r" + order + b"\rO\r"
    link.close()


@pytest.mark.parametrize(
    ("channel", "told"),
    [
        ("/dev/null@fast", "a serial port's speed is a number of baud, not 'fast'"),
        ("/nowhere", "cannot open the bus slcan:/nowhere: .*No such file"),
    ],
)
def test_a_port_that_cannot_be_opened_is_named(channel, told):
    with pytest.raises(UsageError, match=told):
        open_bus_link(f"slcan:{channel}", [], LineStats())


def test_a_speed_that_no_port_has_is_refused(port):
    _, name = port

    with pytest.raises(UsageError, match="cannot open the bus slcan:"):
        open_bus_link(f"slcan:{name}@99999999999", [], LineStats())


def test_a_port_that_is_gone_at_once_is_closed(port, monkeypatch):
    _, name = port
    closed = []

    def fail(_link: SlcanLink, _text: bytes) -> None:
        raise LinkDownError("unplugged")

    monkeypatch.setattr(SlcanLink, "write", fail)
    monkeypatch.setattr(SlcanLink, "close", lambda _link: closed.append("closed"))

    with pytest.raises(LinkDownError):
        open_bus_link(f"slcan:{name}", [], LineStats())
    assert closed == ["closed"]
