"""Serial lines made of ptys: what goes in at one end comes out at the other, until somebody meddles with it."""

import os
import select
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path

import pytest

from host_sim.protocol.codec import node_of
from host_sim.transport.cable import Cable, Socket
from tests.runs.slcan_adapter import Adapter

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


def test_what_goes_into_one_end_comes_out_of_the_other(cable, open_tty):
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


def test_an_end_that_is_unplugged_is_gone_and_comes_back_as_another_tty(cable, open_tty, tmp_path):
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


def test_a_cable_that_is_unplugged_can_be_taken_away():
    cable = Cable()
    cable.unplug()

    cable.close()


def test_a_cable_that_does_not_obey_says_so(cable, monkeypatch):
    monkeypatch.setattr("host_sim.transport.cable._ORDER_S", 0.01)
    monkeypatch.setattr(Cable, "_obey", lambda *_: None)

    with pytest.raises(OSError, match="thread has ended"):
        cable.plug()


def test_an_adapter_passes_frames_to_the_robots_whose_they_are_and_to_the_host(open_tty):
    with closing(Adapter(1, 2, node_of=node_of)) as adapter:
        host, first, second = (open_tty(name) for name in (adapter.host, *adapter.robots.values()))

        os.write(host, b"S6\rO\r\r" + TO_NODE_2 + TO_NODE_1[:3])
        os.write(host, TO_NODE_1[3:])
        os.write(first, FROM_NODE_1)

        assert heard(second, len(TO_NODE_2)) == TO_NODE_2
        assert heard(first, len(TO_NODE_1)) == TO_NODE_1
        assert heard(host, len(FROM_NODE_1)) == FROM_NODE_1
        assert adapter.orders == [b"S6", b"O"]


def test_what_nobody_reads_is_lost_and_holds_nobody_up(open_tty):
    with closing(Adapter(1, node_of=node_of)) as adapter:
        host, robot = open_tty(adapter.host), open_tty(adapter.robots[1])
        for _ in range(100):
            os.write(robot, FROM_NODE_1 * 20)

        os.write(host, TO_NODE_1)

        assert heard(robot, len(TO_NODE_1)) == TO_NODE_1


def test_a_cable_whose_far_end_nobody_reads_can_be_taken_away(open_tty):
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


def test_an_adapter_loses_what_is_no_frame_and_goes_on(open_tty):
    with closing(Adapter(1, node_of=node_of)) as adapter:
        host, robot = open_tty(adapter.host), open_tty(adapter.robots[1])

        os.write(host, b"t\rtXYZ0\r" + TO_NODE_1)  # a host that was killed in the middle of a line

        assert heard(robot, len(TO_NODE_1)) == TO_NODE_1
