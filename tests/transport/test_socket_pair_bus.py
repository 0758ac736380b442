"""Back to back: what one end sends, the other receives, in python-can's manners.

A link over a socket pair: what one end sends, the other receives, and no wait is unbounded.
"""

import contextlib
import select
import socket
import struct
import threading
import time
from collections.abc import Iterator
from typing import NamedTuple

import can
import pytest

from host_sim.base.errors import LinkDownError
from host_sim.protocol.codec import Frame
from host_sim.transport.link import LineStats
from host_sim.transport.socket_pair import ERROR, EXTENDED, REMOTE, SocketPairLink
from host_sim.transport.socket_pair_bus import SocketPairBus

SOON_S = 2.0


class Pair(NamedTuple):
    """Two buses, each the far end of the other."""

    left: can.BusABC
    right: can.BusABC


@pytest.fixture
def pair() -> Iterator[Pair]:
    ends = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    buses = Pair(*(can.Bus(interface="octet", channel=end.detach()) for end in ends))
    yield buses
    for bus in buses:
        bus.shutdown()


@pytest.fixture
def raw() -> Iterator[tuple[SocketPairBus, socket.socket]]:
    """A bus, and the bare socket at its far end."""
    near, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    bus = SocketPairBus(near.detach())
    yield bus, far
    far.close()
    bus.shutdown()


MESSAGES = {
    "standard": can.Message(arbitration_id=0x1AB, is_extended_id=False, data=[1, 2, 3, 4, 5, 6, 7, 8]),
    "extended": can.Message(arbitration_id=0x1FFFFFFF, is_extended_id=True, data=[0xFF] * 8),
    "extended with a small identifier": can.Message(arbitration_id=1, is_extended_id=True, data=[1]),
    "remote": can.Message(arbitration_id=0x123, is_extended_id=False, is_remote_frame=True, dlc=4),
    "extended remote": can.Message(arbitration_id=0x12345, is_extended_id=True, is_remote_frame=True, dlc=8),
    **{f"{n} bytes": can.Message(arbitration_id=0x7FF, is_extended_id=False, data=range(n)) for n in range(8)},
}


@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES)
def test_messages_arrive_unchanged_both_ways(pair, message):
    for sender, receiver in (pair, reversed(pair)):
        sender.send(message)

        got = receiver.recv(SOON_S)

        assert got is not None
        assert got.equals(message, timestamp_delta=None, check_channel=False, check_direction=False)
        assert got.is_rx


def test_messages_keep_their_order(pair):
    for number in range(100):
        pair.left.send(can.Message(arbitration_id=number, is_extended_id=False))

    assert [pair.right.recv(SOON_S).arbitration_id for _ in range(100)] == list(range(100))


def test_link_does_not_receive_its_own_frames(pair):
    pair.left.send(MESSAGES["standard"])

    assert pair.left.recv(0.05) is None


def test_timestamps_are_the_time_of_day_and_rise(pair):
    before = time.time()
    for _ in range(2):
        pair.left.send(MESSAGES["standard"])
    first, second = pair.right.recv(SOON_S), pair.right.recv(SOON_S)

    assert before <= first.timestamp <= second.timestamp <= time.time()


def test_bus_receives_only_messages_that_pass_its_filters(pair):
    pair.right.set_filters([{"can_id": 0x100, "can_mask": 0x7F0, "extended": False}])
    for number in (0x0FF, 0x100, 0x10F, 0x110):
        pair.left.send(can.Message(arbitration_id=number, is_extended_id=False))
    pair.left.send(can.Message(arbitration_id=0x100, is_extended_id=True))

    got = [pair.right.recv(SOON_S).arbitration_id for _ in range(2)]

    assert got == [0x100, 0x10F]
    assert pair.right.recv(0.05) is None


def test_select_reports_a_readable_bus(pair):
    assert select.select([pair.right], [], [], 0)[0] == []
    pair.left.send(MESSAGES["standard"])
    assert select.select([pair.right], [], [], SOON_S)[0] == [pair.right]


def test_recv_returns_none_after_its_timeout(pair):
    start = time.monotonic()

    assert pair.left.recv(0.1) is None
    assert 0.1 <= time.monotonic() - start < SOON_S


def test_recv_without_a_timeout_waits_for_a_message(pair):
    later = threading.Timer(0.2, pair.right.send, [MESSAGES["standard"]])
    later.start()

    assert pair.left.recv(None) is not None
    later.join()


def test_threads_may_share_a_bus():
    ends = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    left, right = (can.ThreadSafeBus(interface="octet", channel=end.detach()) for end in ends)
    senders = [threading.Thread(target=left.send, args=[MESSAGES["standard"]]) for _ in range(10)]
    for sender in senders:
        sender.start()

    assert all(right.recv(SOON_S) for _ in senders)
    for sender in senders:
        sender.join()
    left.shutdown()
    right.shutdown()


def test_bus_can_be_shut_down_twice(pair):
    pair.left.shutdown()
    pair.left.shutdown()


def test_bus_after_shutdown_neither_sends_nor_receives(pair):
    pair.left.shutdown()

    with pytest.raises(can.CanOperationError):
        pair.left.send(MESSAGES["standard"])
    with pytest.raises(can.CanOperationError):
        pair.left.recv(0)


@pytest.mark.parametrize("channel", [None, "x", -1, 987_654])
def test_channel_without_an_open_socket_is_refused(channel):
    with pytest.raises(can.CanInitializationError, match=repr(channel)):
        SocketPairBus(channel)


def has_room(bus: can.BusABC) -> bool:
    try:
        bus.send(MESSAGES["standard"], timeout=0)
    except can.CanOperationError:
        return False
    return True


def fill(bus: can.BusABC) -> None:
    """Sends until the far end has no more room."""
    while has_room(bus):
        pass


def test_send_to_a_full_bus_times_out(raw):
    bus, _ = raw
    fill(bus)
    start = time.monotonic()

    with pytest.raises(can.CanOperationError, match="no room"):
        bus.send(MESSAGES["standard"], timeout=0.1)

    assert 0.1 <= time.monotonic() - start < SOON_S


def test_send_without_a_timeout_waits_for_room(raw):
    bus, far = raw
    fill(bus)
    far.setblocking(False)

    def drain() -> None:
        with contextlib.suppress(BlockingIOError):
            while far.recv(16):
                pass

    later = threading.Timer(1.5, drain)
    later.start()
    start = time.monotonic()
    bus.send(MESSAGES["standard"])

    assert time.monotonic() - start > 1.0
    later.join()


@pytest.mark.parametrize(("name", "nothing"), [("_try_send", False), ("_try_receive", None)])
def test_send_and_recv_continue_after_spurious_wakeups(raw, monkeypatch, name, nothing):
    bus, far = raw
    bus.send(MESSAGES["standard"])
    far.send(far.recv(16))
    at_first, before = [nothing] * 2, getattr(bus._pair, name)
    monkeypatch.setattr(bus._pair, name, lambda *packed: at_first.pop() if at_first else before(*packed))

    bus.send(MESSAGES["standard"], timeout=SOON_S)

    assert bus.recv(SOON_S).arbitration_id == MESSAGES["standard"].arbitration_id
    assert at_first == []


def test_far_end_closing_during_a_send_raises_a_bus_error(raw):
    bus, far = raw
    fill(bus)
    later = threading.Timer(0.2, far.close)
    later.start()

    with pytest.raises(can.CanOperationError, match="closed"):
        bus.send(MESSAGES["standard"], timeout=SOON_S)
    later.join()


def test_far_end_closing_with_unread_messages_raises_a_bus_error(raw):
    bus, far = raw
    bus.send(MESSAGES["standard"])
    later = threading.Timer(0.2, far.close)
    later.start()

    with pytest.raises(can.CanOperationError, match="closed"):
        bus.recv(SOON_S)
    later.join()
    with pytest.raises(can.CanOperationError, match="closed"):
        bus.send(MESSAGES["standard"])


def test_messages_sent_before_the_far_end_closed_still_arrive(raw):
    bus, far = raw
    far.send(frame(0x123))
    far.close()

    assert bus.recv(SOON_S).arbitration_id == 0x123
    with pytest.raises(can.CanOperationError, match="closed"):
        bus.recv(SOON_S)


def frame(can_id: int, length: int = 0) -> bytes:
    return struct.pack("=IB3x8s", can_id, length, b"")


JUNK = {"nothing": b"", "a byte": b"x", "15 bytes": bytes(15), "17 bytes": bytes(17), "72 bytes": bytes(72)}
JUNK |= {"a length of 9": frame(0x123, 9), "a length of 255": frame(0x123, 255)}


@pytest.mark.parametrize("junk", JUNK.values(), ids=JUNK)
@pytest.mark.parametrize("timeout", [0, SOON_S, None])
def test_malformed_packets_are_counted_and_skipped(raw, junk, timeout):
    bus, far = raw
    far.send(junk)
    far.send(junk)
    far.send(frame(0x123))

    assert bus.recv(timeout).arbitration_id == 0x123
    assert bus._pair.garbled == 2
    assert bus.recv(0) is None


FRAME = Frame(0x41, b"\1\2")
Ends = tuple[SocketPairLink, SocketPairLink]


@pytest.fixture
def ends() -> Iterator[Ends]:
    pair = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    links = SocketPairLink(pair[0]), SocketPairLink(pair[1])
    yield links
    for link in links:
        link.close()


def test_frame_sent_at_one_end_arrives_at_the_other(ends):
    ends[0].send(FRAME)

    assert ends[1].receive(1.0) == FRAME
    assert ends[1].receive(0.0) is None


def test_put_back_frame_is_received_before_the_socket_is_lent(ends):
    ends[0].send(Frame(0x42, b""))

    ends[1].put_back(FRAME)

    assert ends[1].frame_socket() is None
    assert [ends[1].receive(1.0), ends[1].receive(1.0)] == [FRAME, Frame(0x42, b"")]
    assert ends[1].frame_socket() is ends[1]


@pytest.mark.parametrize("flag", [EXTENDED, REMOTE, ERROR])
def test_extended_remote_or_error_frame_has_no_identifier(ends, flag):
    ends[0]._socket.send(struct.pack("=IB3x8s", 0x41 | flag, 1, b"\1"))

    assert ends[1].receive(1.0) == Frame(-1, b"")


def test_frames_without_room_are_counted(monkeypatch):
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


def test_closed_far_end_raises_link_down(ends):
    ends[0].close()

    with pytest.raises(LinkDownError, match="cannot hear the robot: the far end is closed"):
        ends[1].receive(1.0)
    with pytest.raises(LinkDownError, match="cannot send to the robot: the far end is closed"):
        ends[1].send(FRAME)


def test_explain_callback_names_why_the_far_end_closed(ends):
    def explain() -> None:
        raise LinkDownError("the robot was killed")

    ends[1].explain = explain
    ends[0].close()

    with pytest.raises(LinkDownError, match="the robot was killed"):
        ends[1].receive(0.0)


def test_closing_callback_is_called_before_a_socket_closes(ends):
    open_then = []
    ends[0].closing = lambda: open_then.append(ends[0].fileno() >= 0)

    ends[0].close()

    assert open_then == [True]
    with pytest.raises(LinkDownError):
        ends[0].receive(0.0)
