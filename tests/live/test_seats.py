"""A class: each page has a robot of its own, and the curves of all of them grow."""

import pytest

from host_sim.live import curves as curves_module
from host_sim.live.curves import NAMES, Curves
from host_sim.live.page_commands import (
    FULL_SPEED,
    EraseMemory,
    Freeze,
    MoveRobot,
    NewSeed,
    NextEnvironment,
    Play,
    WriteCell,
)
from host_sim.live.seats import NAME_MAX, Seats, name_from
from host_sim.live.visitor import NotYoursError, Rights
from host_sim.protocol.generated import Reason
from host_sim.world.edits import Edit
from tests.live.support import order, play

A, B, C = (f"{i:032x}" for i in (10, 11, 12))


@pytest.fixture
def seats() -> Seats:
    return Seats([1, 2])


def test_who_comes_gets_the_next_free_robot(seats):
    assert [seats.take(key).node for key in (A, B)] == [1, 2]
    assert seats.take(C) is None


def test_a_page_that_is_loaded_again_gets_its_robot_and_its_name_tag_back(seats):
    seat = seats.take(A)
    seats.rename(seat, "Ada")
    seats.leave(seat)
    seats.take(B)

    again = seats.take(A)

    assert (again.node, again.name, again.pages) == (1, "Ada", 1)


def test_two_pages_of_one_tab_share_its_robot(seats):
    assert seats.take(A) is seats.take(A)
    assert seats.take(B).node == 2


def test_the_robot_of_the_page_that_left_first_goes_to_a_newcomer_when_no_other_is_free(seats):
    first, second = seats.take(A), seats.take(B)
    seats.rename(second, "Ben")
    seats.leave(second)
    seats.leave(first)

    newcomer = seats.take(C)

    assert (newcomer.node, newcomer.name) == (2, "")
    assert seats.take(B).node == 1


@pytest.mark.parametrize("key", ["", "1", "x" * 32, A.upper(), A + "0", "../" + A[3:]])
def test_what_is_no_key_gets_no_robot(seats, key):
    assert seats.take(key) is None


@pytest.mark.parametrize(
    ("typed", "tag"),
    [
        ("Ada", "Ada"),
        ("  Ada \n\t Lovelace ", "Ada Lovelace"),
        ("x" * 1000, "x" * NAME_MAX),
        ("\x00\x1b[31m\u202eevil\u200b", "[31m evil"),
        ("<script>", "<script>"),
        ("Zoe\u0308", "Zo\u00eb"),
        ("", ""),
    ],
)
def test_a_name_tag_is_short_and_printable(typed, tag):
    assert name_from(typed) == tag


def test_a_page_changes_its_own_robot_only(seats):
    with Rights.of(seats, A) as first, Rights.of(seats, B) as rights:
        assert first.admit(EraseMemory()) == EraseMemory(1)
        assert rights.admit(WriteCell(3, 1)) == WriteCell(3, 1, 2)
        assert rights.admit(Freeze(on=True, node=2)) == Freeze(on=True, node=2)
        assert rights.admit(MoveRobot(Edit("lift"), 2)) == MoveRobot(Edit("lift"), 2)
        with pytest.raises(NotYoursError, match="robot 1 is not yours: yours is robot 2"):
            rights.admit(MoveRobot(Edit("put", at=(1, 2)), 1))


@pytest.mark.parametrize(
    "command", [Play(on=False), NextEnvironment(), NewSeed(1), Edit("add_bar", a=(0, 0), b=(9, 9))]
)
def test_what_is_for_all_is_for_the_board(seats, command):
    with Rights.of(seats, A) as rights, pytest.raises(NotYoursError, match="the board does that for all"):
        rights.admit(command)
    with Rights.of(None, "") as board:
        assert board.admit(command) is command


def test_a_page_without_a_robot_can_watch(seats):
    with Rights.of(seats, "") as rights:
        with pytest.raises(NotYoursError, match="here you can watch"):
            rights.admit(EraseMemory())
        with pytest.raises(NotYoursError, match="no robot of its own"):
            rights.rename("Ada")


def test_a_robot_is_kept_when_its_page_fails(seats):
    with pytest.raises(ZeroDivisionError), Rights.of(seats, A):
        raise ZeroDivisionError

    assert [(seat.key, seat.pages) for seat in seats.all] == [(A, 0), ("", 0)]


AVOIDING = (Reason.REMEMBERED, Reason.TRIAL, Reason.BOREDOM)


@pytest.fixture
def sampled(live):
    """A run of two robots that was sampled every 500 ticks."""
    run = live(robots=2, speed=FULL_SPEED)
    curves = Curves(run)
    for ticks in range(0, 3000, 500):
        play(run, lambda ticks=ticks: run.simulation.tick >= ticks)
        curves.sample()
    return run, curves


def test_the_last_sample_is_what_the_robots_have_come_to(sampled):
    run, curves = sampled

    for robot, track in enumerate(run.recorder.trajectory.tracks):
        last = dict(zip(NAMES, curves.robots[robot][-1], strict=True))
        reasons = track.column("reason").tolist()
        assert last["trials"] == run.recorder.histories[robot].trials > 0
        assert last["blocked"] == sum(map(reasons.count, AVOIDING)) > 0
        assert last["cells"] == sum(map(bool, run.simulation.clients[robot].memory)) > 0
    meals = [samples[-1][NAMES.index("meals")] for samples in curves.robots]
    episodes = [*run.episodes, run.simulation.episode]
    assert sum(meals) == sum(robot.food_eaten for episode in episodes for robot in episode.robots)


def test_there_is_a_sample_only_where_the_run_has_gone_on(sampled):
    run, curves = sampled
    order(run, Play(on=False))
    curves.sample()
    count = len(curves.ticks)

    curves.sample()

    assert len(curves.ticks) == count
    assert curves.ticks == sorted(set(curves.ticks))


def test_starting_over_begins_new_curves(sampled):
    run, curves = sampled
    version = curves.version
    order(run, NewSeed(5))

    curves.sample()

    assert curves.version == version + 1
    assert (curves.start, curves.ticks) == (run.simulation.tick, [run.simulation.tick])
    assert curves.robots == [[(0, 0, 0, 0)]] * 2


def test_a_long_run_has_fewer_samples_and_they_reach_as_far(live, monkeypatch):
    monkeypatch.setattr(curves_module, "SAMPLES_MAX", 8)
    run = live()
    curves = Curves(run)
    for cell in range(20):
        order(run, WriteCell(1 + cell % 7, 1))
        run.offer(Play(on=True), print)
        play(run, lambda tick=run.simulation.tick: run.simulation.tick > tick)
        curves.sample()

    assert 4 <= len(curves.ticks) <= 8
    assert curves.ticks[-1] == run.simulation.tick
    assert [len(samples) for samples in curves.robots] == [len(curves.ticks)]
    assert curves.version > 1
