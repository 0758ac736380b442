"""What the client counts and waits for: what is new or late, round trips, whole reports.

A robot that takes its time for each frame, as in an emulator on a busy machine: the client must not swamp it.
"""

from collections import deque
from collections.abc import Iterator

import pytest

from host_sim.base.errors import RobotError
from host_sim.client.commands import handshake, start, stop
from host_sim.client.connection import Connection, RoundTrip
from host_sim.client.deadlines import Deadlines, Limits
from host_sim.client.robot_client import RobotClient
from host_sim.client.robot_reports import Arrival, Freshness
from host_sim.client.session import Session
from host_sim.client.supervision import settle
from host_sim.protocol.codec import Frame
from host_sim.sim.in_process_link import InProcessLink
from tests.client.support import PROTOCOL, Diary, connected, drive_for, run

TICK_S = 0.02


def counted(late: int, unanswered: int, ticks: int = 100) -> Deadlines:
    counts = Deadlines(Limits(unanswered_percent=10.0, gap_s=1.0, behind_percent=5.0))
    for tick in range(ticks):
        counts.begin(0.021 if tick < late else 0.02, TICK_S)
    for _ in range(unanswered):
        counts.miss(TICK_S, TICK_S)
    return counts


def test_deadlines_within_limits_raise_no_doubt():
    assert counted(late=5, unanswered=10).doubts() == []


def test_deadlines_beyond_limits_raise_a_doubt_for_each():
    assert counted(late=6, unanswered=11).doubts() == [
        "11.0 % of the 100 ticks had no answer; the limit is 10 %",
        "this host was too slow for real time: 0.941 x; the limit is 0.95 x",
    ]


def test_deadlines_of_few_ticks_raise_no_doubt():
    assert counted(late=49, unanswered=49, ticks=49).doubts() == []


def test_gap_is_reported_once():
    counts = Deadlines(Limits(gap_s=0.1))

    assert [counts.miss(round(waited * TICK_S, 6), TICK_S) for waited in range(1, 9)].count(True) == 1
    assert counts.gap_s == 0.16


def test_gap_limit_of_zero_reports_the_first_unanswered_tick():
    counts = Deadlines(Limits(gap_s=0.0))

    assert [counts.miss(round(waited * TICK_S, 6), TICK_S) for waited in (1, 2)] == [True, False]


def test_summary_has_the_worst_values():
    counts = counted(late=0, unanswered=0, ticks=50)
    counts.begin(0.03, TICK_S)
    counts.miss(0.5, TICK_S)

    assert counts.summary() == {
        "ticks": 51,
        "speed": 0.9714,
        "unanswered_percent": 1.96,
        "longest_gap_ms": 500,
        "late_percent": 1.96,
        "latest_ms": 30.0,
    }
    assert Deadlines().summary() is None


def message(counter: int, content: int = 0) -> Frame:
    return Frame(0x6A1, bytes([content, counter]))


def judged(*frames: Frame) -> list[Arrival]:
    freshness = Freshness()
    return [freshness.judge(frame) for frame in frames]


def test_consecutive_counters_are_new():
    assert set(judged(*(message(counter % 15) for counter in range(40)))) == {Arrival.NEW}


@pytest.mark.parametrize("ahead", range(1, 8))
def test_counter_may_skip_up_to_seven(ahead):
    assert judged(message(12), message((12 + ahead) % 15)) == [Arrival.NEW, Arrival.NEW]


@pytest.mark.parametrize("behind", range(1, 8))
def test_earlier_counter_is_late(behind):
    assert judged(message(3), message((3 - behind) % 15)) == [Arrival.NEW, Arrival.LATE]


def test_repeated_message_is_known():
    assert judged(message(3), message(3)) == [Arrival.NEW, Arrival.AGAIN]


def test_same_counter_with_other_content_is_foreign():
    assert judged(message(3), message(3, content=1)) == [Arrival.NEW, Arrival.OTHER]


def test_consecutive_late_counters_start_another_count():
    assert judged(message(9), message(4), message(5), message(6)) == [
        Arrival.NEW,
        Arrival.LATE,
        Arrival.ELSEWHERE,
        Arrival.NEW,
    ]


def after(*samples: float) -> RoundTrip:
    trip = RoundTrip()
    for seconds in samples:
        trip.sample(seconds)
    return trip


def test_timeout_follows_the_round_trip_time():
    slow, fast = after(*[0.05] * 50), after(*[0.0001] * 50)

    assert 0.05 < slow.timeout_s < 0.06
    assert fast.timeout_s == 0.01


def test_varying_round_trip_time_raises_the_timeout():
    assert after(*[0.02, 0.08] * 20).timeout_s > 0.1 > after(*[0.05] * 40).timeout_s


def test_back_off_doubles_the_timeout_up_to_a_limit():
    trip = after(*[0.02] * 50)
    before = trip.timeout_s

    trip.back_off()
    doubled = trip.timeout_s
    for _ in range(9):
        trip.back_off()

    assert doubled == 2 * before
    assert trip.timeout_s == 0.25
    assert not trip.is_sure


def test_prompt_answer_resets_the_back_off():
    trip = after(*[0.02] * 50)
    before = trip.timeout_s
    trip.back_off()

    trip.sample(0.02)

    assert trip.timeout_s <= before
    assert trip.is_sure


STOP = PROTOCOL.choices("COMMAND", "opcode")["stop"]


@pytest.mark.parametrize("ticks", range(48, 58))  # in ticks 50 to 55 the robot says its parts of the second's report
def test_stop_during_a_report_is_sent_once(ticks):
    with connected() as client:
        run(client, ticks)

    said = [decoded for frame in client.log.frames if (decoded := PROTOCOL.decode(frame)) is not None]
    at = max(i for i, decoded in enumerate(said) if decoded.name == "ANSWER")
    stops = [it for it in said if it.name == "COMMAND" and it.signals["opcode"] == STOP]
    assert len(stops) == 2  # that of the handshake, and the last one
    assert [it.signals["page"] for it in said[at:] if it.name == "FAULTS"] == [0, 1]


FRAME_S = 0.065
"""What the robot needs for a frame: more than the time after which the client repeats one."""
PROMPT_S = 0.001
HELD_UP_S = 4.0
TICKS = 60


class SlowRobot:
    """A link in a virtual time, to a robot that answers frames one after another."""

    def __init__(self) -> None:
        self.frame_s = PROMPT_S
        self.now_s = self.free_s = 0.0
        self.waiting: deque[tuple[float, Frame]] = deque()
        self.robot = InProcessLink()
        self.answers: deque[Frame] = deque()
        self.last = Frame(-1, b"")
        self.stuck = False
        self.rest_s = 0.0  # how late the DRIVE comes that says that it has stopped

    def now(self) -> float:
        return self.now_s

    def hold_up(self, seconds: float) -> None:
        self.free_s = self.now_s + seconds

    def send(self, frame: Frame) -> None:
        self.free_s = max(self.free_s, self.now_s) + self.frame_s
        self.waiting.append((self.free_s, frame))

    def receive(self, timeout_s: float) -> Frame | None:
        give_up_s = self.now_s + timeout_s
        while not self.answers:
            if not self.waiting or self.waiting[0][0] > give_up_s:
                self.now_s = give_up_s
                return None
            done_s, frame = self.waiting.popleft()
            self.now_s = max(self.now_s, done_s)
            self.answers += self.answers_to(frame)
        if self.rest_s and self.answers[0].id == PROTOCOL.id_of("DRIVE"):
            waited_s = min(self.rest_s, give_up_s - self.now_s)
            self.now_s, self.rest_s = self.now_s + waited_s, self.rest_s - waited_s
            if self.rest_s:
                return None
        self.last = self.answers.popleft()
        return self.last

    def answers_to(self, frame: Frame) -> Iterator[Frame]:
        """The robot's, or again and again its last one."""
        if self.stuck:
            yield self.last
            return
        self.robot.send(frame)
        while (answer := self.robot.receive(0.0)) is not None:
            yield answer

    def close(self) -> None:
        self.robot.close()


def running(robot: SlowRobot) -> RobotClient:
    """The client of a robot that was prompt so far, and is slow from now on."""
    client = RobotClient(Connection(robot, now=robot.now), PROTOCOL, Diary())
    handshake(client, client.connection.deadline_s)
    start(client, Session(1, settings={"turn_deg": 20}))
    drive_for(client, TICKS)
    robot.frame_s = FRAME_S
    return client


def test_delayed_robot_catches_up():
    robot = SlowRobot()
    client = running(robot)
    robot.hold_up(HELD_UP_S)

    drive_for(client, TICKS, first=TICKS)

    assert client.incidents == []
    assert robot.now_s < 2 * (HELD_UP_S + TICKS * FRAME_S)


def test_settle_waits_for_answers_that_are_still_due():
    robot = SlowRobot()
    client = running(robot)
    robot.hold_up(1.0)
    drive_for(client, 1, first=TICKS)
    repeated = client.frames.repeated

    settle(client)

    assert client.frames.duplicate == repeated > 0
    assert client.incidents == []


def test_commands_wait_for_a_delayed_robot():
    robot = SlowRobot()
    robot.frame_s = FRAME_S
    robot.hold_up(HELD_UP_S)
    client = RobotClient(Connection(robot, now=robot.now), PROTOCOL, Diary())

    handshake(client, client.connection.deadline_s)
    start(client, Session(1, settings={"turn_deg": 20}), (0, 1, 2, 1, 2, 0, 2, 1))

    assert robot.now_s < 3 * (HELD_UP_S + client.frames.sent * FRAME_S)


def test_robot_that_repeats_its_last_answer_is_given_up():
    robot = SlowRobot()
    client = running(robot)
    robot.stuck = True

    with pytest.raises(RobotError, match=f"did not answer tick {TICKS}"):
        drive_for(client, TICKS, first=TICKS)

    assert robot.now_s < 60


def test_late_rest_of_the_robot_needs_no_second_stop():
    robot = SlowRobot()
    client = running(robot)
    robot.rest_s = 0.8
    client.log.frames.clear()
    stop(client)

    assert [frame.id for frame in client.log.frames].count(PROTOCOL.id_of("COMMAND")) == 1
    assert robot.rest_s == 0.0
