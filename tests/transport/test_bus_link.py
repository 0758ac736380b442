"""A link over a python-can bus."""

import socket
from collections.abc import Iterator
from threading import Timer

import pytest

from host_sim.protocol.codec import Frame
from host_sim.transport.bus_link import BusLink
from host_sim.transport.socket_pair_bus import SocketPairBus

_LATE_S = 30.0


@pytest.fixture
def ends() -> Iterator[tuple[BusLink, BusLink]]:
    pair = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    links = [BusLink(SocketPairBus(end.detach()), is_socket=True) for end in pair]
    yield links[0], links[1]
    for link in links:
        link.close()


def test_what_is_sent_at_one_end_comes_out_of_the_other(ends):
    ends[0].send(Frame(0x41, b"\1\2"))

    assert ends[1].receive(1.0) == Frame(0x41, b"\1\2")
    assert ends[1].receive(0.0) is None


def test_a_wait_is_no_longer_when_the_wall_clock_is_set_back_meanwhile(ends, monkeypatch):
    readings = iter([7200.0])
    monkeypatch.setattr("can.bus.time", lambda: next(readings, 3600.0))
    late = Timer(_LATE_S, ends[0].send, [Frame(0x41, b"")])
    late.start()

    frame = ends[1].receive(0.01)

    late.cancel()
    assert frame is None
