"""The study of robots that teach each other: what it counts, and what it prints."""

import math

from host_sim.study.sharing import Crowd, Learner, line, run_crowd


def test_who_shares_knows_sooner_than_who_does_not():
    shared, alone = (run_crowd(Crowd(4, share, "adaptive", 2)) for share in (1, 0))

    assert max(learner.known_s for learner in shared) < max(learner.known_s for learner in alone)
    assert all(learner.is_right for learner in shared)


def test_a_line_has_the_figures_of_the_learners():
    learners = [Learner(5.0, True), Learner(7.0, True), Learner(30.0, False), Learner(math.inf)]

    assert line(4, 1, learners).split() == ["4", "yes", "18", "s", "inf", "s", "50.0", "%"]
