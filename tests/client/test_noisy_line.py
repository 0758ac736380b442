"""A serial line on which noise damages many frames: they are sent more often, not more slowly."""

from collections import deque
from random import Random

import pytest

from host_sim.client.commands import handshake, start
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame
from host_sim.sim.in_process_link import InProcessLink
from host_sim.transport.link import LineStats
from tests.client.support import PROTOCOL, Diary, drive_for

CHANCE = 0.95**22
"""That all 22 characters of a frame come through where 5 % are damaged."""

FRAME_S, TICK_S, TICKS = 0.00001, 0.02, 3000
NO_FRAME = Frame(-1, b"")


class NoisyLine:
    """A link in a virtual time, in which a frame takes 10 us, to a robot that answers at once."""

    def __init__(self, chance: float) -> None:
        self.line, self.chance, self.now_s = LineStats(), chance, 0.0
        self.robot, self.dice, self.heard = InProcessLink(), Random(1), deque[Frame]()

    def now(self) -> float:
        return self.now_s

    def is_whole(self) -> bool:
        return self.dice.random() < self.chance

    def send(self, frame: Frame) -> None:
        for _ in range(self.line.copies):
            self.now_s += FRAME_S
            if self.is_whole():
                self.robot.send(frame)
                while (answer := self.robot.receive(0.0)) is not None:
                    self.heard.append(answer)

    def receive(self, timeout_s: float) -> Frame | None:
        if not self.heard:
            self.now_s += timeout_s
            return None
        self.now_s += FRAME_S
        frame = self.heard.popleft()
        if self.is_whole():
            return frame
        self.line.garbled += 1
        return NO_FRAME

    def close(self) -> None:
        self.robot.close()


def started(link: NoisyLine) -> RobotClient:
    client = RobotClient(Connection(link, line=link.line, now=link.now), PROTOCOL, FrameLog())
    client.log.close()
    client.log = Diary()
    client.inbox.record = client.log.add
    handshake(client, client.connection.deadline_s)
    start(client, Session(1))
    return client


@pytest.mark.parametrize("seed", range(3))
def test_with_5_percent_of_the_bytes_damaged_an_environment_is_20_times_as_fast_as_real_time(seed):
    link = NoisyLine(CHANCE)
    link.dice.seed(seed)

    client = started(link)
    start_s = link.now_s
    drive_for(client, TICKS)
    settle(client)

    assert client.incidents == []
    assert link.now_s - start_s < TICKS * TICK_S / 20
    assert start_s < 10
    assert client.frames.repeated > 0


def test_when_the_noise_ends_each_frame_is_sent_once_again():
    link = NoisyLine(CHANCE)
    client = started(link)
    drive_for(client, 100)

    link.chance = 1.0
    drive_for(client, 20, first=100)
    repeated = client.frames.repeated
    drive_for(client, 20, first=120)

    assert not link.line.noisy
    assert client.frames.repeated == repeated


def test_a_line_on_which_nothing_is_damaged_is_not_taken_for_noisy():
    link = NoisyLine(1.0)

    drive_for(started(link), 100)

    assert link.line == LineStats()
