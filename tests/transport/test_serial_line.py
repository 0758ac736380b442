"""Serial lines: opened, shared by several robots, and what is said of them."""

import os
import pty
import tty
from collections import deque
from collections.abc import Iterator

import pytest
import serial

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.protocol.codec import Frame
from host_sim.transport.buses import open_bus_link
from host_sim.transport.link import LineStats
from host_sim.transport.shared_line import SharedLine
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

    assert os.read(adapter, 100) == b"\rC\rZ0\r" + order + b"\rO\r"
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
    monkeypatch.setattr(serial.Serial, "close", lambda _port: closed.append("closed"))

    with pytest.raises(LinkDownError):
        open_bus_link(f"slcan:{name}", [], LineStats())
    assert "closed" in closed


IDS = {1: (0x41, 0x101), 2: (0x42, 0x102)}
FIRST, SECOND = Frame(0x41, b"1"), Frame(0x42, b"2")
NOISE = Frame(-1, b"")


class Line:
    """A line with frames on it; it notes what is asked of it."""

    def __init__(self, *frames: Frame) -> None:
        self.frames = deque(frames)
        self.sent: list[Frame] = []
        self.timeouts: list[float] = []
        self.closed = False

    def send(self, frame: Frame) -> None:
        self.sent.append(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        self.timeouts.append(timeout_s)
        return self.frames.popleft() if self.frames else None

    def close(self) -> None:
        self.closed = True


def test_each_robot_hears_its_own_frames_in_order():
    later = Frame(0x101, b"3")
    shared = SharedLine(Line(SECOND, FIRST, SECOND, later), IDS)
    one, two = shared.share(1), shared.share(2)

    assert [one.receive(1.0), one.receive(1.0), one.receive(0.0)] == [FIRST, later, None]
    assert [two.receive(0.0), two.receive(0.0), two.receive(0.0)] == [SECOND, SECOND, None]


def test_noise_is_for_whoever_listens():
    assert SharedLine(Line(SECOND, NOISE), IDS).share(1).receive(1.0) == NOISE


def test_what_came_before_a_robot_is_listened_for_is_old_news():
    shared = SharedLine(Line(SECOND, FIRST), IDS)
    assert shared.share(1).receive(1.0) == FIRST

    assert shared.share(2).receive(0.0) is None


def test_frames_that_wait_behind_those_of_others_are_found_without_waiting():
    assert SharedLine(Line(SECOND, SECOND, FIRST), IDS).share(1).receive(0.0) == FIRST


def test_an_endless_flood_for_another_does_not_keep_a_robot_from_its_time():
    line = Line(*[SECOND] * 10_000)

    assert SharedLine(line, IDS).share(1).receive(0.0) is None

    assert 0 < len(line.timeouts) < 1000


def test_one_that_is_closed_leaves_the_line_open_for_the_others():
    line = Line()
    shared = SharedLine(line, IDS)
    one, two = shared.share(1), shared.share(2)

    one.close()
    two.send(FIRST)

    assert line.sent == [FIRST]
    assert not line.closed


@pytest.mark.parametrize(
    ("stats", "told"),
    [
        (LineStats(), ""),
        (LineStats(outages=2, reason="no such device"), "; the line was gone 2 times, last: no such device"),
        (LineStats(heard=0), "; nothing came over the line"),
        (LineStats(heard=9), "; only acknowledgements came from the adapter"),
        (LineStats(heard=9, frames=1, errors=2), "; the adapter refused a command or a frame 2 times (BELL)"),
        (LineStats(heard=9, frames=1, garbled=2, strange="'x'"), "; 2 lines were no frames, the last one 'x'"),
        (LineStats(unsent=3), "; 3 frames could not be sent"),
        (
            LineStats(outages=1, unsent=4, reason="x"),
            "; the line was gone 1 times, last: x; 4 frames could not be sent",
        ),
    ],
)
def test_only_what_happened_is_told(stats, told):
    assert stats.account() == told
