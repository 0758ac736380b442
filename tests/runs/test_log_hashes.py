"""The comparison of logs by their hashes notices what it is there to notice."""

from collections import Counter
from itertools import islice

from host_sim.sim.run_config import RunConfig
from tests.runs.log_hashes import Recorded, differences, digest_of_log, runs


def test_every_run_has_a_name_of_its_own():
    names = Counter(recorded.name for recorded in runs())

    assert len(names) > 190
    assert set(names.values()) == {1}


def test_a_log_is_the_same_again_and_differs_with_the_options():
    one, other = islice(runs(), 2)

    assert digest_of_log(one) == digest_of_log(one) != digest_of_log(other)


def test_edits_and_the_size_of_steps_are_heeded():
    config = RunConfig(environments=1, limit_s=12.0)

    plain, edited, by_tick = (digest_of_log(Recorded("", config, *rest)) for rest in ((), (True,), (True, 1)))

    assert plain != edited == by_tick


def test_what_differs_is_named():
    assert differences({"a": "1", "b": "2", "gone": "3"}, {"a": "1", "b": "4", "new": "5"}) == ["b", "gone", "new"]
