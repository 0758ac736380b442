"""Serial lines: opened, shared by several robots, and what is said of them."""

import os
import pty
import select
import threading
import time
import tty
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path

import pytest
import serial

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.protocol.codec import Frame, node_of
from host_sim.transport.buses import open_bus_link
from host_sim.transport.cable import Cable, Socket
from host_sim.transport.link import LineStats
from host_sim.transport.shared_line import SharedLine
from host_sim.transport.slcan_link import SlcanLink
from tests.runs.slcan_adapter import Adapter


@pytest.fixture
def port() -> Iterator[tuple[int, str]]:
    """The adapter's end, and the name of ours."""
    adapter, ours = pty.openpty()
    tty.setraw(ours)
    yield adapter, os.ttyname(ours)
    os.close(adapter)
    os.close(ours)


@pytest.mark.parametrize(("speed", "bitrate", "order"), [("", 500_000, b"S6"), ("@9600", 125_000, b"S4")])
def test_slcan_adapter_is_set_to_the_bit_rate_of_the_bus(port, speed, bitrate, order):
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
def test_unopenable_port_is_named(channel, told):
    with pytest.raises(UsageError, match=told):
        open_bus_link(f"slcan:{channel}", [], LineStats())


def test_unsupported_baud_rate_is_refused(port):
    _, name = port

    with pytest.raises(UsageError, match="cannot open the bus slcan:"):
        open_bus_link(f"slcan:{name}@99999999999", [], LineStats())


def test_port_that_fails_during_open_is_closed(port, monkeypatch):
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


def test_shared_line_delivers_frames_by_robot_and_in_order():
    later = Frame(0x101, b"3")
    shared = SharedLine(Line(SECOND, FIRST, SECOND, later), IDS)
    one, two = shared.share(1), shared.share(2)

    assert [one.receive(1.0), one.receive(1.0), one.receive(0.0)] == [FIRST, later, None]
    assert [two.receive(0.0), two.receive(0.0), two.receive(0.0)] == [SECOND, SECOND, None]


def test_noise_is_delivered_to_the_receiving_share():
    assert SharedLine(Line(SECOND, NOISE), IDS).share(1).receive(1.0) == NOISE


def test_share_receives_no_frames_from_before_it_was_made():
    shared = SharedLine(Line(SECOND, FIRST), IDS)
    assert shared.share(1).receive(1.0) == FIRST

    assert shared.share(2).receive(0.0) is None


def test_share_finds_its_frame_behind_others_without_waiting():
    assert SharedLine(Line(SECOND, SECOND, FIRST), IDS).share(1).receive(0.0) == FIRST


def test_share_times_out_during_a_flood_for_another_robot():
    line = Line(*[SECOND] * 10_000)

    assert SharedLine(line, IDS).share(1).receive(0.0) is None

    assert 0 < len(line.timeouts) < 1000


def test_closed_share_leaves_the_line_open():
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
def test_line_stats_account_for_nonzero_counts_only(stats, told):
    assert stats.account() == told


SOON_S = 30.0
TO_NODE_1, TO_NODE_2, FROM_NODE_1 = b"t0210\r", b"t0220\r", b"t0410\r"


@pytest.fixture
def open_tty() -> Iterator[Callable[[str], int]]:
    """Opens ttys, and closes them in the end."""
    opened: list[int] = []

    def open_one(name: str) -> int:
        opened.append(os.open(name, os.O_RDWR | os.O_NOCTTY))
        return opened[-1]

    yield open_one
    for fd in opened:
        os.close(fd)


@pytest.fixture
def cable() -> Iterator[Cable]:
    laid = Cable()
    yield laid
    laid.close()


def heard(fd: int, count: int) -> bytes:
    """So many bytes that come; fewer if the line has ended."""
    text = b""
    while len(text) < count and select.select([fd], [], [], SOON_S)[0]:
        more = os.read(fd, count - len(text))
        if not more:
            break
        text += more
    return text


def test_bytes_pass_the_cable_both_ways(cable, open_tty):
    ends = [open_tty(name) for name in cable.ends]

    os.write(ends[0], b"to and ")
    os.write(ends[1], b"fro")

    assert heard(ends[1], 7) == b"to and "
    assert heard(ends[0], 3) == b"fro"
    assert cable.passed == 10


def test_noise_changes_bytes_and_loses_none(cable, open_tty):
    ends = [open_tty(name) for name in cable.ends]
    cable.noise = 0.5

    os.write(ends[0], b"x" * 200)

    text = heard(ends[1], 200)
    assert len(text) == 200
    assert 50 < sum(byte != ord("x") for byte in text) < 150


def test_replugged_end_comes_back_as_another_tty(cable, open_tty, tmp_path):
    near, far = (open_tty(name) for name in cable.ends)
    socket = Socket(tmp_path / "tty")
    socket.plug(cable.ends[1])

    socket.unplug()
    cable.unplug()
    os.write(near, b"nobody hears that")
    while not cable.passed:
        time.sleep(0.001)
    assert heard(far, 1) == b""
    assert not socket.path.exists()

    cable.plug()
    socket.plug(cable.ends[1])
    again = open_tty(str(socket.path))
    os.write(again, b"here")
    assert heard(near, 4) == b"here"
    assert Path(socket.path).readlink() == Path(cable.ends[1])


def test_unplugged_cable_can_be_closed():
    cable = Cable()
    cable.unplug()

    cable.close()


def test_unresponsive_cable_raises_an_error(cable, monkeypatch):
    monkeypatch.setattr("host_sim.transport.cable._ORDER_S", 0.01)
    monkeypatch.setattr(Cable, "_obey", lambda *_: None)

    with pytest.raises(OSError, match="thread has ended"):
        cable.plug()


def test_adapter_routes_frames_by_node_and_to_the_host(open_tty):
    with closing(Adapter(1, 2, node_of=node_of)) as adapter:
        host, first, second = (open_tty(name) for name in (adapter.host, *adapter.robots.values()))

        os.write(host, b"S6\rO\r\r" + TO_NODE_2 + TO_NODE_1[:3])
        os.write(host, TO_NODE_1[3:])
        os.write(first, FROM_NODE_1)

        assert heard(second, len(TO_NODE_2)) == TO_NODE_2
        assert heard(first, len(TO_NODE_1)) == TO_NODE_1
        assert heard(host, len(FROM_NODE_1)) == FROM_NODE_1
        assert adapter.orders == [b"S6", b"O"]


def test_unread_bytes_are_lost_without_blocking_the_sender(open_tty):
    with closing(Adapter(1, node_of=node_of)) as adapter:
        host, robot = open_tty(adapter.host), open_tty(adapter.robots[1])
        for _ in range(100):
            os.write(robot, FROM_NODE_1 * 20)

        os.write(host, TO_NODE_1)

        assert heard(robot, len(TO_NODE_1)) == TO_NODE_1


def test_cable_with_an_unread_far_end_can_be_closed(open_tty):
    cable = Cable()
    near, sent = open_tty(cable.ends[0]), 100_000
    os.set_blocking(near, False)
    give_up = time.monotonic() + SOON_S
    while sent > 0 and time.monotonic() < give_up:
        with suppress(BlockingIOError):
            sent -= os.write(near, b"x" * 1000)
    closing = threading.Thread(target=cable.close, daemon=True)

    closing.start()
    closing.join(SOON_S)

    assert not closing.is_alive()
    assert sent <= 0


def test_adapter_drops_malformed_lines_and_continues(open_tty):
    with closing(Adapter(1, node_of=node_of)) as adapter:
        host, robot = open_tty(adapter.host), open_tty(adapter.robots[1])

        os.write(host, b"t\rtXYZ0\r" + TO_NODE_1)  # a host that was killed in the middle of a line

        assert heard(robot, len(TO_NODE_1)) == TO_NODE_1
