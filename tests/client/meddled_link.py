"""A robot that somebody meddles with: what the tests of restarts and of rivals share."""

import time
from collections import deque
from collections.abc import Callable

from host_sim.client.commands import handshake, start
from host_sim.client.pacing import Lockstep, RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import Frame, counter_of
from host_sim.protocol.generated import Opcode
from host_sim.sim.in_process_link import InProcessLink
from tests.client.support import PROTOCOL, connected, drive_for, rolled, senses

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


OBEYED = {
    "write": {"mask": 15, "half": 1, "byte_0": 1, "byte_1": 2, "byte_2": 1, "byte_3": 2},
    "erase": {},
    "freeze": {"freeze": 1},
    "set": {"parameter": 0, "value": 90},
    "start": {"profile": 0, "seed": 7, "lockstep": 1},
    "the same start": {"profile": 0, "seed": 1, "lockstep": 1},
    "resume": {},
}


class Listener(ObeyedLink):
    """A robot on a bus, and somebody who has listened to all that it was told."""

    def forged(self, name: str, *, lockstep: bool) -> Frame:
        """The command that the robot expects next, as far as anybody can tell."""
        told = [frame for frame in self.sent if frame.id == PROTOCOL.id_of("COMMAND")][-1]
        signals = {**OBEYED.get(name, {})}
        if "lockstep" in signals:
            signals["lockstep"] = int(lockstep)
        opcode = Opcode[name.rsplit(maxsplit=1)[-1].upper()]
        owner, counter = told.data[2], (counter_of(told) + 1) % 15
        return PROTOCOL.encode("COMMAND", {"counter": counter, "opcode": opcode, "owner": owner, **signals})

    swap: Callable[[Frame], Frame] = staticmethod(lambda frame: frame)

    def send(self, frame: Frame) -> None:
        self.sent.append(frame)
        self.put(self.swap(frame))

    def put_unheard(self, frame: Frame) -> None:
        """The frame reaches the robot; what it answers is kept from the simulator, but for its new memory."""
        heard, self.waiting = self.waiting, type(self.waiting)()
        self.put(frame)
        memory = PROTOCOL.id_of("MEMORY")
        self.waiting = type(self.waiting)([*heard, *(each for each in self.waiting if each.id == memory)])


def begun(link: Listener, *, lockstep: bool) -> RobotClient:
    with connected(link, lockstep=lockstep) as client:
        handshake(client, client.connection.deadline_s)
        start(client, Session(1))
    return client


def run_for(client: RobotClient, link: Listener, ticks: range) -> None:
    pace = Lockstep([client]) if client.inbox.lockstep else RealTime([client], 0.02)
    for tick in ticks:
        pace.exchange([senses(tick, link.odometer)])


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
