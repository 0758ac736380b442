"""The curves of a class: how each robot's trials, blocked time, known cells and meals grow."""

import pytest

from host_sim.live import curves as curves_module
from host_sim.live.curves import NAMES, Curves
from host_sim.live.page_commands import FULL_SPEED, NewSeed, Play, WriteCell
from host_sim.protocol.generated import Reason
from tests.live.support import order, play

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
