"""What the client counts and waits for: what is new or late, round trips, whole reports."""

import pytest

from host_sim.client.connection import RoundTrip
from host_sim.client.deadlines import Deadlines, Limits
from host_sim.client.robot_reports import Arrival, Freshness
from host_sim.protocol.codec import Frame
from tests.client.support import PROTOCOL, connected, run

TICK_S = 0.02


def counted(late: int, unanswered: int, ticks: int = 100) -> Deadlines:
    counts = Deadlines(Limits(unanswered_percent=10.0, gap_s=1.0, behind_percent=5.0))
    for tick in range(ticks):
        counts.begin(0.021 if tick < late else 0.02, TICK_S)
    for _ in range(unanswered):
        counts.miss(TICK_S, TICK_S)
    return counts


def test_within_the_limits_nothing_is_said():
    assert counted(late=5, unanswered=10).doubts() == []


def test_beyond_them_each_is_said():
    assert counted(late=6, unanswered=11).doubts() == [
        "11.0 % of the 100 ticks had no answer; the limit is 10 %",
        "this host was too slow for real time: 0.941 x; the limit is 0.95 x",
    ]


def test_of_a_few_ticks_nothing_is_said():
    assert counted(late=49, unanswered=49, ticks=49).doubts() == []


def test_a_gap_is_said_once():
    counts = Deadlines(Limits(gap_s=0.1))

    assert [counts.miss(round(waited * TICK_S, 6), TICK_S) for waited in range(1, 9)].count(True) == 1
    assert counts.gap_s == 0.16


def test_without_tolerance_the_first_tick_without_an_answer_is_too_many():
    counts = Deadlines(Limits(gap_s=0.0))

    assert [counts.miss(round(waited * TICK_S, 6), TICK_S) for waited in (1, 2)] == [True, False]


def test_the_summary_has_the_worst():
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


def test_messages_that_count_up_are_new():
    assert set(judged(*(message(counter % 15) for counter in range(40)))) == {Arrival.NEW}


@pytest.mark.parametrize("ahead", range(1, 8))
def test_some_may_be_missing_in_between(ahead):
    assert judged(message(12), message((12 + ahead) % 15)) == [Arrival.NEW, Arrival.NEW]


@pytest.mark.parametrize("behind", range(1, 8))
def test_an_earlier_one_is_late(behind):
    assert judged(message(3), message((3 - behind) % 15)) == [Arrival.NEW, Arrival.LATE]


def test_the_same_one_again_is_known():
    assert judged(message(3), message(3)) == [Arrival.NEW, Arrival.AGAIN]


def test_the_same_counter_with_other_content_is_somebody_elses():
    assert judged(message(3), message(3, content=1)) == [Arrival.NEW, Arrival.OTHER]


def test_two_that_follow_each_other_elsewhere_are_those_of_another_count():
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


def test_the_timeout_follows_the_answers():
    slow, fast = after(*[0.05] * 50), after(*[0.0001] * 50)

    assert 0.05 < slow.timeout_s < 0.06
    assert fast.timeout_s == 0.01


def test_answers_that_vary_are_waited_for_longer():
    assert after(*[0.02, 0.08] * 20).timeout_s > 0.1 > after(*[0.05] * 40).timeout_s


def test_each_answer_that_is_late_doubles_the_timeout_up_to_a_bound():
    trip = after(*[0.02] * 50)
    before = trip.timeout_s

    trip.back_off()
    doubled = trip.timeout_s
    for _ in range(9):
        trip.back_off()

    assert doubled == 2 * before
    assert trip.timeout_s == 0.25
    assert not trip.is_sure


def test_the_next_prompt_answer_takes_it_back():
    trip = after(*[0.02] * 50)
    before = trip.timeout_s
    trip.back_off()

    trip.sample(0.02)

    assert trip.timeout_s <= before
    assert trip.is_sure


STOP = PROTOCOL.choices("COMMAND", "opcode")["stop"]


@pytest.mark.parametrize("ticks", range(48, 58))  # in ticks 50 to 55 the robot says its parts of the second's report
def test_a_stop_during_a_report_is_sent_once(ticks):
    with connected() as client:
        run(client, ticks)

    said = [decoded for frame in client.log.frames if (decoded := PROTOCOL.decode(frame)) is not None]
    at = max(i for i, decoded in enumerate(said) if decoded.name == "ANSWER")
    stops = [it for it in said if it.name == "COMMAND" and it.signals["opcode"] == STOP]
    assert len(stops) == 2  # that of the handshake, and the last one
    assert [it.signals["page"] for it in said[at:] if it.name == "FAULTS"] == [0, 1]
