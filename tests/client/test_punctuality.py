"""What is counted of a run in real time, and what is too much."""

from host_sim.client.punctuality import Limits, Punctuality

TICK_S = 0.02


def counted(late: int, unanswered: int, ticks: int = 100) -> Punctuality:
    counts = Punctuality(Limits(unanswered_percent=10.0, gap_s=1.0, behind_percent=5.0))
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
    counts = Punctuality(Limits(gap_s=0.1))

    assert [counts.miss(round(waited * TICK_S, 6), TICK_S) for waited in range(1, 9)].count(True) == 1
    assert counts.gap_s == 0.16


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
    assert Punctuality().summary() is None
