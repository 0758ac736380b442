"""One line for several robots."""

from collections import deque

from host_sim.protocol.codec import Frame
from host_sim.transport.shared_line import SharedLine

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
