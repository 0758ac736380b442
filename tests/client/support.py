"""A robot in this process behind a link with faults, in a time that passes only while somebody waits."""

import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from host_sim.client.commands import handshake, start, stop
from host_sim.client.connection import DEADLINE_S, Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.pacing import Lockstep, RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame, Protocol, counter_of
from host_sim.protocol.forgery import forgers
from host_sim.protocol.generated import NOTHING_SENSED, Drive, Opcode, Senses
from host_sim.sim.in_process_link import InProcessLink
from host_sim.transport.faulty_link import FaultyLink, Schedule
from host_sim.transport.link import Link, VirtualClock
from host_sim.transport.rule import Rule

PROTOCOL = Protocol()
PATTERNS = (0, 0, 0, 4, 4, 2, 0, 6, 4, 0, 8, 14, 0, 0, 2)
"""What the sensors of a robot feel that learns a lot in little time."""


ODOMETERS: dict[int, tuple[int, int]] = {}
"""The odometers of each client's robot, by the id of the client."""


class Diary:
    """A log that keeps its frames."""

    def __init__(self) -> None:
        self.frames: list[Frame] = []

    def add(self, frame: Frame) -> None:
        self.frames.append(frame)


@contextmanager
def connected(
    link: Link | None = None, faults: Sequence[str] = (), *, seed: int = 1, deadline_s: float = DEADLINE_S, **options
) -> Iterator[RobotClient]:
    """A client whose robot has answered; its log is a `Diary`."""
    clock = VirtualClock()
    schedule = Schedule([Rule.parse(rule) for rule in faults], seed, forgers(PROTOCOL))
    faulty = FaultyLink(link or InProcessLink(), schedule, clock)
    connection = Connection(faulty, deadline_s=deadline_s, now=clock.now)
    client = RobotClient(connection, PROTOCOL, FrameLog(), **options)
    client.log.close()
    client.log = Diary()
    client.inbox.record = client.log.add
    ODOMETERS[id(client)] = (0, 0)
    yield client


def senses(tick: int, odometer: tuple[int, int] = (0, 0)) -> Senses:
    """What a robot senses that turns to and fro among obstacles."""
    left, right = (count % 4096 for count in odometer)
    feel = PATTERNS[tick // 20 % len(PATTERNS)]
    return NOTHING_SENSED._replace(tick=tick % 256, feel=feel, odometer_left=left, odometer_right=right)


def rolled(odometer: tuple[int, int], drive: Drive) -> tuple[int, int]:
    """The odometers of wheels that do what they are told for a tick of 20 ms, in 0.1 mm."""
    left, right = odometer
    return left + drive.left_mm_s // 5, right + drive.right_mm_s // 5


def drive_for(client: RobotClient, ticks: int, first: int = 0) -> list[Drive]:
    """Takes a started robot through some ticks in lockstep."""
    pace, drives = Lockstep([client]), []
    for tick in range(first, first + ticks):
        (drive,) = pace.exchange([senses(tick, ODOMETERS.get(id(client), (0, 0)))])
        ODOMETERS[id(client)] = rolled(ODOMETERS.get(id(client), (0, 0)), drive)
        drives.append(drive)
    return drives


def run(client: RobotClient, ticks: int) -> list[Drive]:
    """A whole run: handshake, start, ticks, stop."""
    handshake(client, client.connection.deadline_s)
    start(client, Session(1, settings={"turn_deg": 20}), (0, 0, 0, 0, 0, 0, 0, 1))
    drives = drive_for(client, ticks)
    settle(client)
    stop(client)
    return drives


def drives_in(frames: Sequence[Frame]) -> list[Frame]:
    """The frames that are answers to senses."""
    decoded = ((frame, PROTOCOL.decode_drive(frame)) for frame in frames)
    return [frame for frame, drive in decoded if drive is not None and drive.reason != 0]


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


def altered(name: str, change: Callable[[dict[str, int]], dict[str, int]]) -> Callable[[Frame], list[Frame]]:
    """Gives other signals to each message of that name, and lets the others pass."""

    def alter(frame: Frame) -> list[Frame]:
        decoded = PROTOCOL.decode(frame)
        if decoded is None or decoded.name != name:
            return [frame]
        return [PROTOCOL.encode(name, {**decoded.signals, **change(decoded.signals)})]

    return alter


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
