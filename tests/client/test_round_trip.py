"""How long the client waits before it repeats."""

from host_sim.client.round_trip import RoundTrip


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
