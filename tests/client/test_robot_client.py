"""A conversation with a robot that is not as it should be: a link that tampers with what a healthy one says."""

import time
from collections.abc import Callable

import pytest

from host_sim.base.errors import RefusedError, RobotError
from host_sim.client.commands import handshake, start
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.pacing import HOLD_TICKS, Lockstep, Pace, RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import Frame, Protocol, crc8
from host_sim.protocol.generated import NOTHING_SENSED, Drive, Reason, Senses
from host_sim.sim.in_process_link import InProcessLink

PROTOCOL = Protocol()
Tamper = Callable[[Frame], list[Frame]]


class TamperedLink(InProcessLink):
    """Hands each frame from the robot through a function that may change, double or drop it."""

    def __init__(self, tamper: Tamper) -> None:
        super().__init__()
        self.tamper = tamper
        self._waiting: list[Frame] = []

    def receive(self, timeout_s: float) -> Frame | None:
        while not self._waiting and (frame := super().receive(0.0)) is not None:
            self._waiting += self.tamper(frame)
        if self._waiting:
            return self._waiting.pop(0)
        time.sleep(timeout_s)
        return None


@pytest.fixture
def client_with(tmp_path):
    """Opens a client with a robot whose frames are tampered with."""
    log = FrameLog(tmp_path / "run.log")

    def connect(tamper: Tamper = lambda frame: [frame], deadline_s: float = 0.3, **kwargs) -> RobotClient:
        return RobotClient(Connection(TamperedLink(tamper), deadline_s=deadline_s), PROTOCOL, log, **kwargs)

    yield connect
    log.close()


def started(client: RobotClient) -> RobotClient:
    handshake(client, 1.0)
    start(client, Session(1))
    return client


def senses(tick: int, feel: int = 0) -> Senses:
    return NOTHING_SENSED._replace(tick=tick, feel=feel)


def exchange(pace: Pace, sensed: Senses) -> Drive:
    """One tick of one robot."""
    (drive,) = pace.exchange([sensed])
    return drive


def resealed(frame: Frame, data: bytes) -> Frame:
    """The frame with other data, and the CRC that belongs to it."""
    return Frame(frame.id, bytes((crc8(frame.id, data),)) + data[1:])


def is_a(name: str) -> Callable[[Frame], bool]:
    return lambda frame: frame.id == PROTOCOL.id_of(name)


def test_robot_answers_every_tick(client_with):
    pace = Lockstep([started(client_with())])

    drives = [exchange(pace, senses(tick)) for tick in range(5)]

    assert [drive.tick for drive in drives] == list(range(5))


def test_robot_with_another_dbc_is_refused(client_with):
    def older(frame: Frame) -> list[Frame]:
        return [resealed(frame, frame.data[:6] + b"\x00\x00")] if is_a("HEARTBEAT")(frame) else [frame]

    with pytest.raises(RobotError, match=r"another octet.dbc \(hash 0000, ours"):
        handshake(client_with(older), 1.0)


def test_missing_robot_is_named(client_with):
    with pytest.raises(RobotError, match="no robot answered as node 1"):
        handshake(client_with(lambda _: []), 0.5)


def test_handshake_waits_for_a_late_robot(client_with):
    deaf_until = time.monotonic() + 0.7
    client = client_with(lambda frame: [frame] if time.monotonic() > deaf_until else [])

    handshake(client, 5.0)

    assert client.frames.received >= 4


def test_missing_drive_is_reported_with_tick_and_last_frame(client_with):
    client = started(client_with())
    pace = Lockstep([client])
    exchange(pace, senses(0))
    client.connection.link.tamper = lambda frame: [] if is_a("DRIVE")(frame) else [frame]

    with pytest.raises(RobotError, match=r"did not answer tick 1 within 0.3 s; last frame from it: HEALTH"):
        exchange(pace, senses(1))


def test_damaged_drive_is_refused_and_counted(client_with):
    client = started(client_with())
    client.connection.link.tamper = lambda frame: [
        frame._replace(data=frame.data[:-1] + bytes([frame.data[-1] ^ 1])),
        frame,
    ]

    drive = exchange(Lockstep([client]), senses(0))

    assert drive.tick == 0
    assert client.frames.refused == 1


def test_drive_with_an_unknown_reason_is_refused_and_counted(client_with):
    client = started(client_with())

    def altered(frame: Frame) -> Frame:
        return PROTOCOL.encode("DRIVE", {**PROTOCOL.decode(frame).signals, "reason": len(Reason)})

    client.connection.link.tamper = lambda frame: [*([altered(frame)] if is_a("DRIVE")(frame) else []), frame]

    drive = exchange(Lockstep([client]), senses(0))

    assert drive.reason < len(Reason)
    assert (client.frames.refused, client.incidents) == (1, [])


def test_duplicate_drive_is_used_once(client_with):
    client = started(client_with())
    client.connection.link.tamper = lambda frame: [frame, frame] if is_a("DRIVE")(frame) else [frame]
    pace = Lockstep([client])

    for tick in range(10):
        assert exchange(pace, senses(tick)).tick == tick

    assert (client.frames.duplicate, client.frames.refused) == (9, 0)


def test_foreign_and_invalid_frames_are_refused(client_with):
    strange = [Frame(-1, b""), Frame(0x7FF, bytes(8)), Frame(PROTOCOL.id_of("SENSES"), bytes(8)), Frame(0x41, b"")]
    client = started(client_with())
    client.connection.link.tamper = lambda frame: [*strange, frame]

    exchange(Lockstep([client]), senses(0))

    assert client.frames.refused == 4


def test_invalid_memory_frame_is_refused(client_with):
    halves = [{"counter": 0, "half": half, **{f"cell_{4 * half + i}": 3 for i in range(4)}} for half in range(2)]
    forged = [PROTOCOL.encode("MEMORY", signals) for signals in halves]
    client = started(client_with())
    client.connection.link.tamper = lambda frame: [*forged, frame]

    exchange(Lockstep([client]), senses(0))

    assert client.memory == (0,) * 8
    assert client.frames.refused > 0


def test_refused_command_names_opcode_and_result(client_with):
    with pytest.raises(RefusedError, match=r"opcode=set result=out_of_range"):
        started(client_with()).dialogue.command("set", parameter=0, value=0)


def test_written_memory_is_reported_back(client_with):
    client = client_with()
    handshake(client, 1.0)

    start(client, Session(1), (0, 1, 2, 1, 2, 0, 2, 1))

    assert client.memory == (0, 1, 2, 1, 2, 0, 2, 1)


def test_real_time_drive_holds_for_100_ms_and_then_stops(client_with):
    client = started(client_with(lockstep=False, deadline_s=5.0))
    pace = RealTime([client], 0.02)
    moving = exchange(pace, senses(0))
    client.connection.link.tamper = lambda frame: [] if is_a("DRIVE")(frame) else [frame]

    held = [exchange(pace, senses(tick)) for tick in range(1, HOLD_TICKS + 3)]

    assert moving.left_mm_s > 0
    assert [drive.left_mm_s for drive in held] == [moving.left_mm_s] * HOLD_TICKS + [0, 0]
    assert client.frames.lost == HOLD_TICKS + 2


def test_real_time_drive_after_a_gap_is_applied(client_with):
    client = started(client_with(lockstep=False, deadline_s=5.0))
    pace = RealTime([client], 0.02)
    client.connection.link.tamper = lambda frame: [] if is_a("DRIVE")(frame) else [frame]
    resting = [exchange(pace, senses(tick)) for tick in range(8)][-1]
    client.connection.link.tamper = lambda frame: [frame]

    back = exchange(pace, senses(8))

    assert resting.left_mm_s == 0
    assert back.tick == 8
    assert back.left_mm_s > 0


def test_real_time_drive_that_is_too_late_is_not_applied(client_with):
    client = started(client_with(lockstep=False, deadline_s=5.0))
    pace, late = RealTime([client], 0.02), []

    def hold_up(frame: Frame) -> list[Frame]:
        late.append(frame)
        return []

    client.connection.link.tamper = hold_up
    for tick in range(HOLD_TICKS + 3):
        exchange(pace, senses(tick))
    first = next(frame for frame in late if is_a("DRIVE")(frame))
    client.connection.link.tamper = lambda _: [first]

    drive = exchange(pace, senses(HOLD_TICKS + 3))

    assert PROTOCOL.decode_drive(first).left_mm_s > 0
    assert (drive.left_mm_s, drive.right_mm_s) == (0, 0)
