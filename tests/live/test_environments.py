"""A run goes from one environment to the next, starts over, and comes to its end."""

import asyncio
import json

import pytest

from host_sim.live import paced_run
from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED, Freeze, NewSeed, NextEnvironment, Play, WriteCell
from host_sim.world.edits import Lift
from tests.live.support import Live, order, play


def to_the_end(run: PacedRun) -> None:
    """Goes to the last environment, and to its last tick."""
    order(run, *[NextEnvironment()] * 4)
    run.simulation.record.limit_ticks = run.simulation.episode.ticks + 1
    run.offer(Play(True), print)
    play(run, lambda: run.done)


def test_the_next_environment_and_a_new_seed_are_recorded(live):
    run = live(speed=FULL_SPEED)
    order(run, NextEnvironment(), NewSeed(9))
    assert [begun[:2] for begun in run.simulation.record.begun] == [(1, 1), (1, 2), (9, 1)]
    assert len(run.episodes) == 2


def test_after_the_last_environment_it_waits_for_a_new_seed(live):
    run = live(speed=FULL_SPEED)
    to_the_end(run)
    assert order(run, Lift()) == ["the run is over: start over to see more"]
    order(run, NewSeed(2))
    assert not run.done
    assert run.simulation.record.begun[-1][:2] == (2, 1)


def test_it_ends_by_itself_where_nobody_stays(live):
    run = live(speed=FULL_SPEED, stays=False)
    to_the_end(run)
    asyncio.run(run.play())
    assert len(run.episodes) == 5


def over_soon(live: Live, monkeypatch: pytest.MonkeyPatch, pause_s: float) -> PacedRun:
    """A run whose first environment has just ended."""
    monkeypatch.setattr(paced_run, "PAUSE_S", pause_s)
    run = live()
    run.simulation.record.limit_ticks = 3
    play(run, lambda: run.ended_at is not None)
    return run


def test_the_end_of_an_environment_stays_in_view_for_a_while(live, monkeypatch):
    run = over_soon(live, monkeypatch, pause_s=1000.0)
    turns = iter(range(20))
    play(run, lambda: next(turns, None) is None)

    assert (run.simulation.tick, run.simulation.record.begun[-1].number) == (3, 1)
    ended = json.loads(PageFeed(run).next())["play"]["ended"]
    assert (ended["number"], ended["finished"], ended["eaten"], ended["food"]) == (1, False, 0, 3)
    assert order(run, Lift()) == ["this environment is over: the next one begins in a moment"]


def test_after_the_pause_the_next_environment_begins(live, monkeypatch):
    run = over_soon(live, monkeypatch, pause_s=0.05)
    play(run, lambda: run.simulation.record.begun[-1].number == 2)

    assert len(run.episodes) == 1
    assert json.loads(PageFeed(run).next())["play"]["ended"] is None


def test_the_pause_can_be_cut_short(live, monkeypatch):
    run = over_soon(live, monkeypatch, pause_s=1000.0)
    run.simulation.record.limit_ticks = 1000
    order(run, NextEnvironment())

    assert [begun.number for begun in run.simulation.record.begun] == [1, 2]
    assert len(run.episodes) == 1


@pytest.mark.parametrize("keep", [False, True])
def test_starting_over_begins_everything_anew(live, keep):
    run = live(speed=FULL_SPEED)
    play(run, lambda: run.recorder.histories[0].trials > 3 and any(run.simulation.clients[0].memory))
    order(run, WriteCell(7, 1), Freeze(True))
    before = run.simulation.clients[0].memory

    order(run, NewSeed(9, keep))

    history = run.recorder.histories[0]
    assert run.simulation.clients[0].memory == history.memory == (before if keep else (0,) * 8)
    known = history.known()
    assert (known["frozen"], known["trial"]) == (0, None)
    assert (known["uses"], known["learned"]) == ([0] * 8, [-1] * 8)
    message = json.loads(PageFeed(run).next())
    assert message["lessons"] == []
    assert message["environment"]["start_tick"] == run.simulation.tick


def test_next_does_not_end_the_run(live):
    run = live(speed=FULL_SPEED)
    complaints = order(run, *[NextEnvironment()] * 6)
    assert complaints == ["this is the last environment: start over to see more"] * 2
    assert not run.done
    assert run.simulation.record.begun[-1].number == 5
