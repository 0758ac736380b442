"""Lockstep and real time over a bus that loses, doubles, reorders, delays and damages frames."""

from collections import deque
from collections.abc import Iterator
from random import Random

import pytest

from host_sim.client.commands import handshake, start
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.pacing import RealTime
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame
from host_sim.sim.in_process_link import InProcessLink
from host_sim.transport.link import LineStats
from tests.client.support import PROTOCOL, Diary, ObeyedLink, connected, drive_for, drives_in, run, senses

TICKS = 250
BAD_BUS = ("drop:30%", "duplicate:10%", "reorder:10%", "delay:0-300ms")
FAULTS = {
    "a third is lost": ("drop:30%",),
    "everything comes twice": ("duplicate",),
    "frames overtake each other": ("reorder:30%:2",),
    "frames are late": ("delay:0-300ms",),
    "bits flip": ("corrupt:20%",),
    "two in three are damaged": ("corrupt:68%",),
    "frames end early": ("truncate:20%",),
    "others talk": ("flood:5%:20",),
    "one way only is bad": ("drop:50%/to",),
    "the other way only is bad": ("drop:50%/from",),
    "a cut": ("drop@200-230",),
    "all of it": (*BAD_BUS, "corrupt:5%", "truncate:5%", "flood:2%"),
}


def run_over(faults: tuple[str, ...], ticks: int, seed: int = 1) -> RobotClient:
    with connected(faults=faults, seed=seed) as client:
        run(client, ticks)
    return client


@pytest.fixture(scope="module")
def clean() -> RobotClient:
    return run_over((), TICKS)


def test_clean_run_repeats_no_frame(clean):
    assert (clean.frames.repeated, clean.frames.duplicate, clean.frames.lost, clean.frames.refused) == (0, 0, 0, 0)
    assert clean.memory != (0,) * 8
    assert len(drives_in(clean.log.frames)) == TICKS


@pytest.mark.parametrize("faults", FAULTS.values(), ids=FAULTS)
@pytest.mark.parametrize("seed", [1, 2])
def test_drives_over_a_faulty_bus_equal_those_of_a_clean_run(clean, faults, seed):
    client = run_over(faults, TICKS, seed)

    assert drives_in(client.log.frames) == drives_in(clean.log.frames)
    assert (client.memory, client.incidents) == (clean.memory, [])


def test_repeated_frames_are_counted(clean):
    client = run_over(("drop:30%",), TICKS)

    assert client.frames.repeated > TICKS / 3
    assert client.frames.sent < clean.frames.sent + 40
    assert client.frames.lost == 0


def test_duplicate_frames_are_counted_and_not_recorded(clean):
    client = run_over(("duplicate",), TICKS)

    assert client.frames.duplicate > TICKS
    assert client.log.frames == clean.log.frames


SHORT = 30
FRAMES = 58
"""More frames than a run of `SHORT` ticks has in either direction."""


@pytest.mark.parametrize("way", ["to", "from"])
@pytest.mark.parametrize("fault", ["drop", "delay:300ms"])
def test_fault_at_any_single_frame_changes_no_result(way, fault):
    clean = run_over((), SHORT)

    for number in range(1, FRAMES):
        client = run_over((f"{fault}@{number}/{way}",), SHORT)

        assert drives_in(client.log.frames) == drives_in(clean.log.frames), number
        assert client.memory == clean.memory, number
    assert len(clean.log.frames) < FRAMES * 2


def test_unresponsive_robot_ends_the_run_and_names_the_tick():
    with (
        connected(faults=("drop@100-/from",)) as client,
        pytest.raises(Exception, match="did not answer tick") as ended,
    ):
        run(client, TICKS)

    assert "within 5 s" in str(ended.value)


def test_slow_bus_is_waited_for_and_not_flooded():
    client = run_over(("delay:150ms",), 100)

    assert client.round_trip.mean_s == pytest.approx(0.3, rel=0.1)
    assert client.frames.repeated < 4 * 100


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


def test_report_counters_that_jump_after_a_gap_cause_no_incident(started, link):
    sent = started.frames.sent

    run_for(started, link, 3000)

    assert started.frames.sent == sent + 3000
    assert "counts" not in str(started.incidents)


def test_real_time_run_follows_the_clock(started, link):
    began = started.connection.now()

    run_for(started, link, 3000)

    assert started.connection.now() - began == pytest.approx(3000 * TICK_S, rel=0.01)


def silent_drive() -> Frame:
    """What a robot says while it hears nothing."""
    nothing = {"left": 0, "right": 0, "repeat_count": 0, "eat": 0, "action": 0, "tick": 0, "counter": 0}
    return PROTOCOL.encode("DRIVE", {**nothing, "reason": PROTOCOL.choices("DRIVE", "reason")["silence"]})


def test_lost_reports_of_a_silent_robot_are_requested_again_at_once(link):
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


def test_robot_with_lost_drives_is_restarted_when_it_stops(link):
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


CHANCE = 0.95**22
"""That all 22 characters of a frame come through where 5 % are damaged."""

FRAME_S, NOISY_TICK_S, NOISY_TICKS = 0.00001, 0.02, 3000
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


def started_on_noise(link: NoisyLine) -> RobotClient:
    client = RobotClient(Connection(link, line=link.line, now=link.now), PROTOCOL, FrameLog())
    client.log.close()
    client.log = Diary()
    client.inbox.record = client.log.add
    handshake(client, client.connection.deadline_s)
    start(client, Session(1))
    return client


@pytest.mark.parametrize("seed", range(3))
def test_environment_on_a_noisy_line_runs_20_times_real_time(seed):
    link = NoisyLine(CHANCE)
    link.dice.seed(seed)

    client = started_on_noise(link)
    start_s = link.now_s
    drive_for(client, NOISY_TICKS)
    settle(client)

    assert client.incidents == []
    assert link.now_s - start_s < NOISY_TICKS * NOISY_TICK_S / 20
    assert start_s < 10
    assert client.frames.repeated > 0


def test_frames_are_sent_once_when_the_noise_ends():
    link = NoisyLine(CHANCE)
    client = started_on_noise(link)
    drive_for(client, 100)

    link.chance = 1.0
    drive_for(client, 20, first=100)
    repeated = client.frames.repeated
    drive_for(client, 20, first=120)

    assert not link.line.noisy
    assert client.frames.repeated == repeated


def test_clean_line_is_not_taken_for_noisy():
    link = NoisyLine(1.0)

    drive_for(started_on_noise(link), 100)

    assert link.line == LineStats()
