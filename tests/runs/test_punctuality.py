"""A run in real time that heard almost nothing, or was not in real time, is not called right."""

import pytest

REAL_TIME = ("--environments", "1", "--limit-s", "4", "--bus", "fd", "--real-time")
DEAF = {
    "senses are lost": ("drop:90%@20-/to",),
    "answers are late": ("delay:0-250ms@20-",),
    "bits flip": ("corrupt:50%:3@20-/from",),
}


@pytest.mark.faulty
@pytest.mark.parametrize("name", DEAF)
def test_where_most_ticks_have_no_answer_the_result_is_doubtful(run, name):
    done = run(*REAL_TIME, *(word for rule in DEAF[name] for word in ("--fault", rule)))

    real_time = done.summary["robots"][0]["real_time"]
    assert real_time["unanswered_percent"] > 10.0
    assert done.code == 1
    assert "of the 200 ticks had no answer; the limit is 10 %" in " ".join(done.summary["incidents"])


@pytest.mark.faulty
def test_the_limits_are_options(run):
    done = run(*REAL_TIME, "--fault", "drop:30%@20-/to", "--unanswered-max", "100", "--late-max", "100")

    assert (done.code, done.errors) == (0, "")
    assert done.summary["robots"][0]["real_time"]["unanswered_percent"] > 10.0


@pytest.mark.faulty
def test_a_gap_beyond_its_limit_is_doubtful(run):
    loose = ("--unanswered-max", "100", "--late-max", "100", "--gap-max-s", "0.4")

    done = run(*REAL_TIME, "--fault", "drop@80-105/to", *loose)

    assert done.code == 1
    assert "the robot did not answer for 0.4 s" in done.errors
    assert done.summary["robots"][0]["real_time"]["longest_gap_ms"] >= 400


def test_in_lockstep_nothing_is_late(run):
    done = run("--environments", "1", "--limit-s", "2", "--bus", "none")

    assert done.summary["robots"][0]["real_time"] is None
