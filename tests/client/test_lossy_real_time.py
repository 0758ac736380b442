"""Real time over a line that damages frames: late answers are lost, and the world does not wait."""

from collections.abc import Iterator

import pytest

from host_sim.client.commands import start
from host_sim.client.handshake import handshake
from host_sim.client.pacing import RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import Frame
from tests.client.meddled_link import ObeyedLink
from tests.client.support import PROTOCOL, connected, senses

TICK_S = 0.02


@pytest.fixture
def link() -> ObeyedLink:
    return ObeyedLink()


@pytest.fixture
def started(link) -> Iterator[RobotClient]:
    """A client whose robot has been started; from then on, most of what it says is damaged on its way."""
    with connected(link, faults=("corrupt:68%@20-/from",), lockstep=False) as client:
        handshake(client, client.connection.deadline_s)
        start(client, Session(1))
        yield client


def run_for(client: RobotClient, link: ObeyedLink, ticks: int) -> None:
    pace = RealTime([client], TICK_S)
    for tick in range(ticks):
        pace.exchange([senses(tick, link.odometer)])


def test_reports_that_jump_after_a_gap_are_no_alarm(started, link):
    sent = started.frames.sent

    run_for(started, link, 3000)

    assert started.frames.sent == sent + 3000
    assert "counts" not in str(started.incidents)


def test_robot_time_goes_as_the_clock_does(started, link):
    began = started.connection.now()

    run_for(started, link, 3000)

    assert started.connection.now() - began == pytest.approx(3000 * TICK_S, rel=0.01)


def silent_drive() -> Frame:
    """What a robot says while it hears nothing."""
    nothing = {"left": 0, "right": 0, "repeat_count": 0, "eat": 0, "action": 0, "tick": 0, "counter": 0}
    return PROTOCOL.encode("DRIVE", {**nothing, "reason": PROTOCOL.choices("DRIVE", "reason")["silence"]})


def test_what_a_waiting_robot_has_not_reported_is_known_to_be_lost(link):
    lost = ["HEALTH", "FAULTS", "HEALTH", "BOOT"]

    def lose_one(frame: Frame) -> list[Frame]:
        decoded = PROTOCOL.decode(frame)
        return [] if lost and decoded and decoded.name == lost[0] else [frame]

    with connected(link, lockstep=False) as client:
        handshake(client, client.connection.deadline_s)
        link.change = lose_one
        put = link.put

        def put_and_wait(frame: Frame) -> None:
            put(frame)
            link.waiting.append(silent_drive())
            del lost[:1]

        link.put = put_and_wait
        began = client.connection.now()
        client.dialogue.demand_reports("report")

    assert client.reports.complete
    assert client.connection.now() - began < 0.1


def test_a_robot_whose_drives_get_lost_is_started_again_when_it_stops(link):
    with connected(link, lockstep=False) as client:
        handshake(client, client.connection.deadline_s)
        start(client, Session(1))
        link.change = lambda frame: [] if is_lost(frame) else [frame]
        run_for(client, link, 600)

    assert "too many of its drives were lost, and was started again" in str(client.incidents)
    assert client.inbox.session is not None
    assert not client.inbox.session.halted


def is_lost(frame: Frame) -> bool:
    """Whether a frame is a drive of a robot that moves; now and then, one of them comes through."""
    drive = PROTOCOL.decode_drive(frame)
    return drive is not None and (drive.left_mm_s, drive.right_mm_s) != (0, 0) and drive.tick % 64 != 0
