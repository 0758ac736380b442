"""New, repeated, late and foreign messages are told apart by their alive counters."""

import pytest

from host_sim.client.freshness import Arrival, Freshness
from host_sim.protocol.codec import Frame


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
