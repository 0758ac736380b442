"""A robot that somebody meddles with: what the tests of restarts and of rivals share."""

import time
from collections import deque
from collections.abc import Callable

from host_sim.backends.in_process_link import InProcessLink
from host_sim.client.commands import start
from host_sim.client.handshake import handshake
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import Frame
from host_sim.protocol.generated import Opcode
from tests.client.support import PROTOCOL, connected, drive_for, rolled

LEARNED = 300
"""A tick by which the robot has learned something."""


class MeddledLink:
    """A robot, and somebody who meddles with it."""

    def __init__(self) -> None:
        self.robot = InProcessLink()
        self.sent: list[Frame] = []
        self.waiting: deque[Frame] = deque()
        self.change: Callable[[Frame], list[Frame]] = lambda frame: [frame]

    def send(self, frame: Frame) -> None:
        self.sent.append(frame)
        self.put(frame)

    def put(self, frame: Frame) -> None:
        """Somebody sends the robot a frame; its answers are on the bus for all to hear."""
        self.robot.send(frame)
        while (answer := self.robot.receive(0.0)) is not None:
            self.waiting.extend(self.change(answer))

    def reboot(self, memory: tuple[int, ...] = (0,) * 8) -> None:
        """The robot loses its power and comes back with a memory."""
        self.robot = InProcessLink(memory=memory)

    def receive(self, timeout_s: float) -> Frame | None:
        if self.waiting:
            return self.waiting.popleft()
        time.sleep(timeout_s)
        return None

    def close(self) -> None:
        self.robot.close()


class ObeyedLink(MeddledLink):
    """A robot whose wheels do what it says, whether or not the simulator hears it."""

    def __init__(self) -> None:
        super().__init__()
        self.odometer = (0, 0)
        self.change = self.obey

    def obey(self, frame: Frame) -> list[Frame]:
        drive = PROTOCOL.decode_drive(frame)
        if drive is not None:
            self.odometer = rolled(self.odometer, drive)
        return [frame]


def learned(link: MeddledLink, ticks: int = LEARNED, **options) -> RobotClient:
    """A client whose robot has been running for some time."""
    with connected(link, **options) as client:
        handshake(client, client.connection.deadline_s)
        start(client, Session(1, settings={"turn_deg": 20}))
        drive_for(client, ticks)
    return client


def command(opcode: Opcode, owner: int, **signals: int) -> Frame:
    return PROTOCOL.encode("COMMAND", {"counter": 9, "opcode": opcode, "owner": owner, **signals})


def is_stopped(link: MeddledLink) -> bool:
    """Whether the last thing that the robot was told is to stop."""
    last = PROTOCOL.decode(link.sent[-1])
    return last is not None and last.name == "COMMAND" and last.signals["opcode"] == Opcode.STOP
