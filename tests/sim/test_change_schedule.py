"""When changes are due."""

from host_sim.sim.simulation import ChangeSchedule
from host_sim.world.changes import Change


def schedule(*texts: str) -> ChangeSchedule:
    return ChangeSchedule([Change.parse(text) for text in texts], 0.02)


def due(coming: ChangeSchedule, tick: int) -> list[str]:
    return [str(change) for change in coming.due(tick)]


def test_a_change_is_due_once_from_its_tick_on():
    coming = schedule("plant@2s")
    coming.enter(1, 0)

    assert [due(coming, tick) for tick in (99, 100, 101)] == [[], ["plant@2s"], []]


def test_seconds_count_from_the_start_of_the_run_also_in_a_later_environment():
    coming = schedule("plant@2s")
    coming.enter(1, 0)
    coming.enter(2, 60)

    assert coming.next_tick == 100


def test_an_environment_counts_from_its_own_start():
    coming = schedule("grow@env2+2s", "plant@env2")
    coming.enter(1, 0)
    assert coming.next_tick > 1_000_000
    coming.enter(2, 60)

    assert due(coming, 60) == ["plant@env2"]
    assert coming.next_tick == 160


def test_what_an_environment_did_not_last_for_comes_no_more():
    coming = schedule("plant@env1+2s")
    coming.enter(1, 0)
    coming.enter(2, 60)

    assert due(coming, 1000) == []


def test_changes_of_one_tick_keep_their_order():
    coming = schedule("grow@2s", "plant@2s", "mirror@1s")
    coming.enter(1, 0)

    assert due(coming, 500) == ["mirror@1s", "grow@2s", "plant@2s"]


def test_a_run_that_begins_anew_meets_everything_again():
    coming = schedule("plant@2s", "mirror@env1")
    coming.enter(1, 0)
    assert len(due(coming, 200)) == 2
    coming.enter(1, 300)

    assert due(coming, 300) == ["mirror@env1"]
    assert coming.next_tick == 400
