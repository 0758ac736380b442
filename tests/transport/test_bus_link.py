"""A link over a python-can bus, and the time in which links wait."""

import errno
import socket
import time
from collections.abc import Iterator
from threading import Timer

import can
import pytest

from host_sim.base.errors import LinkDownError
from host_sim.protocol.codec import Frame
from host_sim.transport.bus_link import BusLink
from host_sim.transport.link import LineStats, VirtualClock, WallClock
from host_sim.transport.socket_pair_bus import SocketPairBus

_LATE_S = 30.0
FRAME = Frame(0x41, b"\1\2")


class Bus:
    """A bus of python-can that does what a test wants, and is no socket."""

    def __init__(self, *does: object) -> None:
        self.does = iter(does)

    def send(self, message: can.Message, timeout: float) -> None:
        del message, timeout
        self._do()

    def recv(self, timeout: float) -> object:
        del timeout
        return self._do()

    def _do(self) -> object:
        done = next(self.does)
        if isinstance(done, Exception):
            raise done
        return done


@pytest.fixture
def ends() -> Iterator[tuple[BusLink, BusLink]]:
    pair = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    links = [BusLink(SocketPairBus(end.detach()), is_socket=True) for end in pair]
    yield links[0], links[1]
    for link in links:
        link.close()


def test_frame_sent_at_one_end_arrives_at_the_other(ends):
    ends[0].send(Frame(0x41, b"\1\2"))

    assert ends[1].receive(1.0) == Frame(0x41, b"\1\2")
    assert ends[1].receive(0.0) is None


def returned(frame: Frame, **how: bool) -> can.Message:
    return can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=False, **how)


def test_frame_marked_as_own_by_the_adapter_is_skipped():
    link = BusLink(Bus(returned(FRAME, is_rx=False), returned(FRAME)))

    assert link.receive(1.0) == FRAME
    with pytest.raises(StopIteration):
        link.receive(1.0)


def test_socketcan_link_receives_other_programs_of_this_host():
    """The kernel flags all that any program of this host sends, and python-can then says that it was not received."""
    link = BusLink(Bus(returned(FRAME, is_rx=False)), is_socket=True)
    link._heard = lambda _: returned(FRAME, is_rx=False)

    assert link.receive(1.0) == FRAME


def test_unmarked_echo_is_skipped_if_the_adapter_echoes():
    other = FRAME._replace(data=b"others")
    does = (None, returned(FRAME), returned(other), returned(FRAME))
    careful, trusting = BusLink(Bus(*does), echoes=True), BusLink(Bus(*does))

    for link in (careful, trusting):
        link.send(FRAME)

    assert careful.receive(1.0) == other
    assert trusting.receive(1.0) == FRAME


def test_receive_timeout_ignores_a_wall_clock_set_back(ends, monkeypatch):
    readings = iter([7200.0])
    monkeypatch.setattr("can.bus.time", lambda: next(readings, 3600.0))
    late = Timer(_LATE_S, ends[0].send, [Frame(0x41, b"")])
    late.start()

    frame = ends[1].receive(0.01)

    late.cancel()
    assert frame is None


def test_closed_far_end_raises_link_down(ends):
    ends[0].close()

    with pytest.raises(LinkDownError, match="cannot hear the robot"):
        ends[1].receive(1.0)
    with pytest.raises(LinkDownError, match="cannot send to the robot"):
        ends[1].send(FRAME)


def test_receive_continues_after_a_spurious_wakeup(ends, monkeypatch):
    nothing, receive = [None], ends[1]._bus.recv
    monkeypatch.setattr(ends[1]._bus, "recv", lambda timeout: nothing.pop() if nothing else receive(timeout))
    ends[0].send(FRAME)

    assert ends[1].receive(1.0) == FRAME
    assert nothing == []


def test_fileno_is_that_of_the_socket(ends):
    assert ends[0].fileno() == ends[0]._bus.fileno()


@pytest.mark.parametrize(
    "error",
    [can.CanOperationError("full", errno.ENOBUFS), OSError(errno.ENOBUFS, "x"), can.CanOperationError("full")],
)
def test_frame_without_room_is_counted(error):
    stats = LineStats()

    BusLink(Bus(error), stats).send(FRAME)

    assert stats.unsent == 1


@pytest.mark.parametrize("error", [can.CanOperationError("gone", errno.ENODEV), OSError(errno.ENETDOWN, "down")])
def test_bus_error_raises_link_down(error):
    link = BusLink(Bus(error, error))

    with pytest.raises(LinkDownError, match="cannot send"):
        link.send(FRAME)
    with pytest.raises(LinkDownError, match="cannot hear"):
        link.receive(0.0)


@pytest.mark.parametrize(
    "heard",
    [
        can.Message(is_extended_id=True),
        can.Message(is_extended_id=False, is_remote_frame=True),
        can.Message(is_extended_id=False, is_error_frame=True),
        can.Message(is_extended_id=False, is_fd=True),
        ValueError("noise"),
        IndexError("noise"),
    ],
)
def test_unusable_frame_has_no_identifier(heard):
    assert BusLink(Bus(heard)).receive(0.0) == Frame(-1, b"")


class Line:
    """A link that has some frames, and notes how long it was waited for."""

    def __init__(self, *frames: Frame) -> None:
        self.frames, self.waits_s = list(frames), []

    def receive(self, timeout_s: float) -> Frame | None:
        self.waits_s.append(timeout_s)
        return self.frames.pop() if self.frames else None


def test_wall_clock_waits_for_the_link_and_never_goes_back():
    clock, line = WallClock(), Line(FRAME)

    before = clock.now()

    assert clock.receive(line, 1.5) == FRAME
    assert line.waits_s == [1.5]
    assert before <= clock.now() <= time.monotonic()


def test_virtual_clock_advances_by_frame_time_or_timeout():
    clock, line = VirtualClock(), Line(FRAME)

    assert clock.receive(line, 1.5) == FRAME
    assert clock.now() == clock.FRAME_S
    assert clock.receive(line, 1.5) is None
    assert clock.now() == clock.FRAME_S + 1.5
    assert line.waits_s == [0.0, 0.0]
