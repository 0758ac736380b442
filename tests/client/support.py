"""A robot in this process behind a link with faults, in a time that passes only while somebody waits."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from host_sim.client.commands import handshake, start, stop
from host_sim.client.connection import DEADLINE_S, Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.pacing import Lockstep
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.forgery import forgers
from host_sim.protocol.generated import NOTHING_SENSED, Drive, Senses
from host_sim.sim.in_process_link import InProcessLink
from host_sim.transport.clock import VirtualClock
from host_sim.transport.faulty_link import FaultyLink, Schedule
from host_sim.transport.link import Link
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
