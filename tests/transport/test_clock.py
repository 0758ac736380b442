"""The time in which links wait."""

import time

from host_sim.protocol.codec import Frame
from host_sim.transport.clock import VirtualClock, WallClock

FRAME = Frame(0x41, b"")


class Line:
    """A link that has some frames, and notes how long it was waited for."""

    def __init__(self, *frames: Frame) -> None:
        self.frames, self.waits_s = list(frames), []

    def receive(self, timeout_s: float) -> Frame | None:
        self.waits_s.append(timeout_s)
        return self.frames.pop() if self.frames else None


def test_the_wall_clock_waits_for_the_link_and_never_goes_back():
    clock, line = WallClock(), Line(FRAME)

    before = clock.now()

    assert clock.receive(line, 1.5) == FRAME
    assert line.waits_s == [1.5]
    assert before <= clock.now() <= time.monotonic()


def test_waiting_in_virtual_time_takes_none_and_a_frame_its_time_on_the_bus():
    clock, line = VirtualClock(), Line(FRAME)

    assert clock.receive(line, 1.5) == FRAME
    assert clock.now() == clock.FRAME_S
    assert clock.receive(line, 1.5) is None
    assert clock.now() == clock.FRAME_S + 1.5
    assert line.waits_s == [0.0, 0.0]
