"""A storm of frames into both sides: every identifier, every opcode, random data, with true and with wrong CRCs.

By name: `.venv/bin/python -m tests.runs.endurance.storm 1000000`; a sample is among the tests.
"""

import sys
from collections import Counter
from collections.abc import Callable
from random import Random

from host_sim.base.errors import RobotError
from host_sim.client.commands import handshake, start
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import Frame, Protocol, crc8
from host_sim.protocol.forgery import forge
from host_sim.protocol.generated import MESSAGES, NOTHING_SENSED
from host_sim.sim.in_process_link import InProcessLink
from host_sim.transport.faulty_link import random_frame
from host_sim.transport.link import VirtualClock

PROTOCOL = Protocol()
BURST = 500
IDS = 0x800


class StormyLink:
    """A robot, and frames of nobody that come before its own."""

    def __init__(self, clock: VirtualClock) -> None:
        self.robot, self._clock, self.storm = InProcessLink(), clock, []

    def send(self, frame: Frame) -> None:
        self.robot.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        self._clock.wait(VirtualClock.FRAME_S)
        if self.storm:
            return self.storm.pop()
        frame = self.robot.receive(0.0)
        if frame is None:
            self._clock.wait(timeout_s)
        return frame

    def close(self) -> None:
        self.robot.close()


def frames(seed: int) -> Callable[[], Frame]:
    """Makes frames: of each kind, every identifier comes in turn, and every opcode with any data."""
    dice, numbers, names = Random(seed), iter(range(10**9)), list(MESSAGES)

    def next_frame() -> Frame:
        number = next(numbers)
        if number % 4 == 0:
            return random_frame(dice)
        if number % 4 == 1:
            return Frame(number // 4 % IDS, dice.randbytes(8))
        if number % 4 == 2:
            return forge(PROTOCOL, names[number // 4 % len(names)], dice)
        data = bytes([0, number // 4 % 256]) + dice.randbytes(6)
        frame_id = PROTOCOL.id_of(names[number // 1024 % len(names)])
        return Frame(frame_id, bytes([crc8(frame_id, data)]) + data[1:])

    return next_frame


def storm_at_robot(count: int, seed: int) -> Counter[str]:
    """Sends frames to a robot; what it answered, by message."""
    robot, next_frame, said = InProcessLink(), frames(seed), Counter()
    for _ in range(count):
        robot.send(next_frame())
        for answer in robot.taken():
            decoded = PROTOCOL.decode(answer)
            assert decoded is not None, f"the robot said what it must not say: {answer}"
            said[decoded.name] += 1
    return said


def storm_at_simulator(count: int, seed: int) -> Counter[str]:
    """Sends frames to a simulator in lockstep; how often its runs went on, and with which errors they ended."""
    next_frame, outcomes = frames(seed), Counter()
    client, tick = _started(), 0
    for _ in range(0, count, BURST):
        before = _frames_counted(client)
        client.connection.link.storm = [next_frame() for _ in range(BURST)]
        try:
            client.send_senses(NOTHING_SENSED._replace(tick=tick % 256))
            client.await_drive()
            outcomes["went on"] += 1
        except RobotError as error:
            outcomes[type(error).__name__] += 1
        taken = BURST - len(client.connection.link.storm)
        assert _frames_counted(client) >= before + taken, "a frame was not counted"
        client, tick = (client, tick + 1) if client.inbox.session and tick < 200 else (_started(), 0)
    return outcomes


def _frames_counted(client: RobotClient) -> int:
    counts = client.frames
    return counts.received + counts.refused + counts.duplicate


def _started() -> RobotClient:
    clock = VirtualClock()
    client = RobotClient(Connection(StormyLink(clock), now=clock.now), PROTOCOL, FrameLog())
    handshake(client, client.connection.deadline_s)
    start(client, Session(1))
    client.log.close()
    client.inbox.record = lambda _: None
    return client


if __name__ == "__main__":
    total = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    sys.stdout.write(f"robot      {total} frames, said {dict(storm_at_robot(total, 1))}\n")
    sys.stdout.write(f"simulator  {total} frames, {dict(storm_at_simulator(total, 1))}\n")
