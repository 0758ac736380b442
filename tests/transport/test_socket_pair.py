"""A link over a socket pair: what one end sends, the other receives, and no wait is unbounded."""

import socket
import struct
from collections.abc import Iterator

import pytest

from host_sim.base.errors import LinkDownError
from host_sim.protocol.codec import Frame
from host_sim.transport.link import LineStats
from host_sim.transport.socket_pair import ERROR, EXTENDED, REMOTE, SocketPairLink

FRAME = Frame(0x41, b"\1\2")
Ends = tuple[SocketPairLink, SocketPairLink]


@pytest.fixture
def ends() -> Iterator[Ends]:
    pair = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    links = SocketPairLink(pair[0]), SocketPairLink(pair[1])
    yield links
    for link in links:
        link.close()


def test_what_is_sent_at_one_end_comes_out_of_the_other(ends):
    ends[0].send(FRAME)

    assert ends[1].receive(1.0) == FRAME
    assert ends[1].receive(0.0) is None


def test_a_frame_that_is_put_back_comes_first_and_until_then_nobody_else_may_receive(ends):
    ends[0].send(Frame(0x42, b""))

    ends[1].put_back(FRAME)

    assert ends[1].frame_socket() is None
    assert [ends[1].receive(1.0), ends[1].receive(1.0)] == [FRAME, Frame(0x42, b"")]
    assert ends[1].frame_socket() is ends[1]


@pytest.mark.parametrize("flag", [EXTENDED, REMOTE, ERROR])
def test_a_frame_of_another_kind_has_no_identifier(ends, flag):
    ends[0]._socket.send(struct.pack("=IB3x8s", 0x41 | flag, 1, b"\1"))

    assert ends[1].receive(1.0) == Frame(-1, b"")


def test_frames_for_which_there_is_no_room_are_counted(monkeypatch):
    monkeypatch.setattr("host_sim.transport.socket_pair._SEND_S", 0.001)
    near, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    stats = LineStats()
    link = SocketPairLink(near, stats)
    with far:
        while not stats.unsent:
            link.send(FRAME)
        link.send(FRAME)
    link.close()

    assert stats.unsent == 2


def test_a_far_end_that_is_closed_is_a_line_that_is_gone(ends):
    ends[0].close()

    with pytest.raises(LinkDownError, match="cannot hear the robot: the far end is closed"):
        ends[1].receive(1.0)
    with pytest.raises(LinkDownError, match="cannot send to the robot: the far end is closed"):
        ends[1].send(FRAME)


def test_why_a_far_end_is_closed_may_be_known_elsewhere(ends):
    def explain() -> None:
        raise LinkDownError("the robot was killed")

    ends[1].explain = explain
    ends[0].close()

    with pytest.raises(LinkDownError, match="the robot was killed"):
        ends[1].receive(0.0)


def test_who_uses_the_socket_is_told_before_it_closes(ends):
    open_then = []
    ends[0].closing = lambda: open_then.append(ends[0].fileno() >= 0)

    ends[0].close()

    assert open_then == [True]
    with pytest.raises(LinkDownError):
        ends[0].receive(0.0)
