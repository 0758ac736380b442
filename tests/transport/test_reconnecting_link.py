"""A line that goes away and comes back, and one that stays away."""

from collections import deque

import pytest

from host_sim.base.errors import LinkDownError, RobotError, UsageError
from host_sim.protocol.codec import Frame
from host_sim.transport.link import LineStats
from host_sim.transport.reconnecting_link import ReconnectingLink

FRAME = Frame(0x123, b"\x01")


class Line:
    """A line in the hands of a test: whether it is there, and what was sent over it."""

    def __init__(self) -> None:
        self.is_there = True
        self.opened = 0
        self.sent: list[Frame] = []
        self.waiting: deque[Frame] = deque()

    def open(self) -> "Line":
        self._check(UsageError)
        self.opened += 1
        return self

    def send(self, frame: Frame) -> None:
        self._check(LinkDownError)
        self.sent.append(frame)

    def receive(self, timeout_s: float) -> Frame | None:  # noqa: ARG002 - as in `Link`
        self._check(LinkDownError)
        return self.waiting.popleft() if self.waiting else None

    def close(self) -> None:
        pass

    def _check(self, error: type[Exception]) -> None:
        if not self.is_there:
            raise error("no such device")


@pytest.fixture
def line() -> Line:
    return Line()


@pytest.fixture
def stats() -> LineStats:
    return LineStats()


@pytest.fixture
def link(line, stats) -> ReconnectingLink:
    return ReconnectingLink("the bus x", line.open, stats, 5.0)


def test_frames_pass_over_a_working_line(line, link):
    line.waiting.append(FRAME)

    link.send(FRAME)

    assert line.sent == [FRAME]
    assert link.receive(0.0) == FRAME


def test_frames_sent_during_an_outage_are_counted(line, link, stats):
    line.is_there = False

    link.send(FRAME)
    link.send(FRAME)

    assert (stats.unsent, stats.outages, stats.reason) == (2, 1, "no such device")


def test_returned_line_is_reopened(line, link):
    line.is_there = False
    link.send(FRAME)
    line.is_there = True
    line.waiting.append(FRAME)

    assert link.receive(0.0) is None  # something must be sent first
    link.send(FRAME)

    assert line.opened == 2
    assert line.sent == [FRAME]
    assert link.receive(0.0) == FRAME


def test_line_that_is_down_at_the_start_is_retried(line, stats):
    ups = iter([False, False, True])

    def open_link() -> Line:
        if not next(ups):
            raise LinkDownError("the bus x is down")
        return line.open()

    link = ReconnectingLink("the bus x", open_link, stats, 5.0)
    link.send(FRAME)
    line.waiting.append(FRAME)

    assert link.receive(0.0) is None
    link.send(FRAME)

    assert link.receive(0.0) == FRAME
    assert (stats.outages, stats.unsent, line.opened) == (1, 1, 1)


def test_lasting_outage_raises_an_error(line, stats):
    link = ReconnectingLink("the bus x", line.open, stats, 0.3)
    line.is_there = False

    with pytest.raises(RobotError, match=r"the bus x has been gone for 0.3 s: no such device"):
        link.receive(0.0)


def test_repeated_outages_are_counted_separately(line, link, stats):
    for _ in range(3):
        line.is_there = False
        link.send(FRAME)
        line.is_there = True
        link.receive(0.0)
        link.send(FRAME)

    assert stats.outages == 3
    assert len(line.sent) == 3


def test_reopened_line_that_fails_continues_the_same_outage(line, link, stats):
    line.is_there = False
    link.send(FRAME)
    line.is_there = True
    link.receive(0.0)
    line.is_there = False

    link.send(FRAME)

    assert (stats.outages, stats.unsent) == (1, 2)


def test_reopened_line_is_not_opened_again_before_a_send(line, link):
    line.is_there = False
    link.send(FRAME)
    line.is_there = True

    assert [link.receive(0.0), link.receive(0.0)] == [None, None]
    assert line.opened == 2


def test_returned_line_outlives_the_patience_without_a_send(line, stats):
    link = ReconnectingLink("the bus x", line.open, stats, 0.2)
    line.is_there = False
    link.send(FRAME)
    line.is_there = True

    for _ in range(4):  # of 0.1 s
        assert link.receive(0.0) is None
    link.send(FRAME)

    assert line.sent == [FRAME]


def test_closed_link_can_be_closed_again_and_sends_nothing(line, link):
    link.close()
    link.close()
    link.send(FRAME)

    assert line.sent == []


class SocketLine(Line):
    """A line with a socket, for which the line itself stands."""

    def open(self) -> "SocketLine":
        super().open()
        return self

    def frame_socket(self) -> "SocketLine":
        return self


def test_link_has_a_frame_socket_only_while_the_line_works(link, stats):
    assert link.frame_socket() is None
    with_socket = SocketLine()
    link = ReconnectingLink("the bus x", with_socket.open, stats, 5.0)
    assert link.frame_socket() is with_socket

    with_socket.is_there = False
    link.send(FRAME)
    assert link.frame_socket() is None

    with_socket.is_there = True
    link.receive(0.0)
    assert link.frame_socket() is None, "nobody knows yet whether it works again"
    link.send(FRAME)
    assert link.frame_socket() is with_socket
