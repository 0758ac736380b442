"""A conversation with a robot that is not as it should be: a link that tampers with what a healthy one says."""

import time
from collections.abc import Callable

import pytest

from host_sim.client.frame_log import Recorder
from host_sim.client.pacing import HOLD_TICKS, Lockstep, RealTime
from host_sim.client.session import Session
from host_sim.errors import RefusedError, RobotError
from host_sim.protocol.codec import Frame, Protocol
from host_sim.robot_io import Senses
from host_sim.transport.in_process_link import InProcessLink

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
def session_with(tmp_path):
    """Opens a session with a robot whose frames are tampered with."""
    recorder = Recorder(tmp_path / "run.log")

    def start(tamper: Tamper = lambda frame: [frame], **kwargs) -> Session:
        return Session(TamperedLink(tamper), PROTOCOL, recorder, **{"deadline_s": 0.3, **kwargs})

    yield start
    recorder.close()


def started(session: Session) -> Session:
    session.handshake(1.0)
    session.start(1, 0, {}, None)
    return session


def senses(tick: int, feel: int = 0) -> Senses:
    return Senses(tick, feel, False, False, 0, 0, 0)


def is_a(name: str) -> Callable[[Frame], bool]:
    return lambda frame: frame.id == PROTOCOL.id_of(name)


def test_a_robot_answers_each_tick(session_with):
    pace = Lockstep(started(session_with()))

    drives = [pace.exchange(senses(tick)) for tick in range(5)]

    assert [drive.tick for drive in drives] == list(range(5))


def test_a_robot_of_another_dbc_is_refused(session_with):
    def older(frame: Frame) -> list[Frame]:
        return [frame._replace(data=frame.data[:6] + b"\x00\x00")] if is_a("HEARTBEAT")(frame) else [frame]

    with pytest.raises(RobotError, match=r"another octet.dbc \(hash 0000, ours"):
        session_with(older).handshake(1.0)


def test_no_robot_at_all_is_named(session_with):
    with pytest.raises(RobotError, match="no robot of node 1 answered"):
        session_with(lambda _: []).handshake(0.5)


def test_a_robot_that_is_not_there_yet_is_waited_for(session_with):
    deaf_until = time.monotonic() + 0.7
    session = session_with(lambda frame: [frame] if time.monotonic() > deaf_until else [])

    session.handshake(5.0, again_s=0.3)

    assert session.frames.received >= 4


def test_a_drive_that_never_comes_is_named_with_tick_and_last_frame(session_with):
    session = started(session_with())
    pace = Lockstep(session)
    pace.exchange(senses(0))
    session.link.tamper = lambda frame: [] if is_a("DRIVE")(frame) else [frame]

    with pytest.raises(RobotError, match=r"did not answer tick 1 within 0.3 s; last frame from it: DRIVE tick=0"):
        pace.exchange(senses(1))


def test_a_damaged_drive_is_refused_and_counted(session_with):
    session = started(session_with())
    session.link.tamper = lambda frame: [frame._replace(data=frame.data[:-1] + bytes([frame.data[-1] ^ 1])), frame]

    drive = Lockstep(session).exchange(senses(0))

    assert drive.tick == 0
    assert session.frames.refused == 1


def test_a_drive_that_comes_twice_counts_once(session_with):
    session = started(session_with(lambda frame: [frame, frame] if is_a("DRIVE")(frame) else [frame]))
    pace = Lockstep(session)

    for tick in range(10):
        assert pace.exchange(senses(tick)).tick == tick

    assert session.frames.refused == 9


def test_frames_of_nobody_are_refused_and_not_recorded(session_with):
    strange = [Frame(-1, b""), Frame(0x7FF, bytes(8)), Frame(PROTOCOL.id_of("SENSES"), bytes(8)), Frame(0x81, b"")]
    session = started(session_with())
    session.link.tamper = lambda frame: [*strange, frame]

    Lockstep(session).exchange(senses(0))

    assert session.frames.refused == 4


def test_a_memory_frame_that_is_no_memory_is_refused(session_with):
    forged = Frame(PROTOCOL.id_of("MEMORY"), bytes([0, 3, 0, 0, 0, 0, 0, 0]))
    session = started(session_with())
    session.link.tamper = lambda frame: [forged, frame]

    Lockstep(session).exchange(senses(0))

    assert session.memory == (0,) * 8
    assert session.frames.refused == 1


def test_a_refused_command_says_which_and_why(session_with):
    with pytest.raises(RefusedError, match=r"opcode=set result=out_of_range"):
        started(session_with()).command("set", parameter=0, value=0)


def test_a_memory_that_is_written_comes_back(session_with):
    session = session_with()
    session.handshake(1.0)

    session.start(1, 0, {}, (0, 1, 2, 1, 2, 0, 2, 1))

    assert session.memory == (0, 1, 2, 1, 2, 0, 2, 1)


def test_in_real_time_the_last_drive_holds_for_100_ms_and_then_the_wheels_stop(session_with):
    session = started(session_with(lockstep=False, deadline_s=5.0))
    pace = RealTime(session, 0.02)
    moving = pace.exchange(senses(0))
    session.link.tamper = lambda frame: [] if is_a("DRIVE")(frame) else [frame]

    held = [pace.exchange(senses(tick)) for tick in range(1, HOLD_TICKS + 3)]

    assert moving.left_mm_s > 0
    assert [drive.left_mm_s for drive in held] == [moving.left_mm_s] * HOLD_TICKS + [0, 0]
    assert session.frames.lost == HOLD_TICKS + 2


def test_in_real_time_a_robot_that_is_back_is_obeyed_again(session_with):
    session = started(session_with(lockstep=False, deadline_s=5.0))
    pace = RealTime(session, 0.02)
    session.link.tamper = lambda frame: [] if is_a("DRIVE")(frame) else [frame]
    resting = [pace.exchange(senses(tick)) for tick in range(8)][-1]
    session.link.tamper = lambda frame: [frame]

    back = pace.exchange(senses(8))

    assert resting.left_mm_s == 0
    assert back.tick == 8
    assert back.left_mm_s > 0
