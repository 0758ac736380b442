"""A run keeps its pace, waits for who watches, obeys between two ticks, and goes from environment to environment.

A run that people have meddled with is the same again: for the same orders at the same ticks, and from its log.
"""

import asyncio
import json
import time
from dataclasses import replace
from itertools import count
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from host_sim.client.commands import stop
from host_sim.live import paced_run
from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import COMMANDS_MAX, PacedRun
from host_sim.live.page_commands import (
    FULL_SPEED,
    EraseMemory,
    Freeze,
    MoveRobot,
    NewSeed,
    NextEnvironment,
    OneDecision,
    PageCommand,
    Play,
    WriteCell,
)
from host_sim.protocol.codec import Frame
from host_sim.protocol.generated import Reason
from host_sim.recording.phrases import news_of
from host_sim.recording.resimulation import resimulate
from host_sim.recording.world_file import world_path, write_world
from host_sim.report.replay_page import run_data
from host_sim.world.edits import Edit
from tests.live.support import Live, order, play


def test_paced_run_keeps_wall_clock_time(live):
    run = live(speed=4.0)
    began = time.monotonic()
    play(run, lambda: run.simulation.tick >= 100)
    assert time.monotonic() - began > 0.9 * 100 * 0.02 / 4


def test_ticks_that_are_due_run_in_blocks(live, monkeypatch):
    run, clock_ms, calls = live(speed=1000.0), count(), []
    step = run.simulation.step
    monkeypatch.setattr(paced_run.time, "monotonic", lambda: next(clock_ms) / 1000)
    monkeypatch.setattr(run.simulation, "step", lambda ticks: (calls.append(ticks), step(ticks)))
    play(run, lambda: run.simulation.tick >= 1000)
    assert max(calls) >= 0.001 * 1000 / 0.02
    assert len(calls) < 1000 / 10


def test_full_speed_never_sleeps(live, monkeypatch):
    run, sleep, waits = live(speed=FULL_SPEED), asyncio.sleep, set()

    async def note_wait(seconds: float) -> None:
        waits.add(seconds)
        await sleep(0)

    monkeypatch.setattr(asyncio, "sleep", note_wait)
    play(run, lambda: run.simulation.tick >= 2000)
    assert waits == {0.0}


def test_single_decision_plays_one_turn_or_all_steps_of_a_way(live):
    run = live(speed=FULL_SPEED)
    order(run, Play(False))
    for reason in (Reason.WANDER, Reason.TRIAL):
        run.offer(OneDecision(), print)
        play(run, lambda reason=reason: run.simulation.drives[0].reason == reason and not run.playing)
    assert run.simulation.tick > 50
    before = run.simulation.drives[0]
    run.offer(OneDecision(), print)
    play(run, lambda: run.simulation.drives[0].action != before.action and not run.playing)
    assert run.simulation.drives[0].action == (before.action + 1) % 128


def test_cells_are_written_and_erased_at_once_while_the_run_is_paused(live):
    run = live()
    order(run, WriteCell(3, 1), WriteCell(6, 2))
    assert run.simulation.clients[0].memory == (0, 0, 0, 1, 0, 0, 2, 0)
    lessons = [(lesson["cell"], lesson["side"], lesson["by_hand"]) for lesson in run.recorder.histories[0].lessons]
    assert lessons == [(3, 1, 1), (6, 2, 1)]
    order(run, EraseMemory())
    assert run.simulation.clients[0].memory == (0,) * 8


def test_frozen_robot_learns_nothing(live):
    run = live(speed=FULL_SPEED)
    order(run, Freeze(True))
    run.offer(Play(True), print)
    play(run, lambda: run.recorder.histories[0].trials > 5)
    assert run.recorder.histories[0].memory == (0,) * 8
    assert run.recorder.histories[0].frozen


def test_paced_run_waits_for_a_viewer(live):
    run = live(speed=FULL_SPEED, waits=True)
    order(run)
    run.offer(Play(True), print)
    play(run, lambda: not run._commands)
    turns = iter(range(20))
    play(run, lambda: next(turns, None) is None)
    assert run.simulation.tick == 0

    run.seen()
    play(run, lambda: run.simulation.tick > 10)


def test_last_of_many_orders_to_start_over_is_the_only_one_obeyed(live):
    run = live()
    order(run, *[NewSeed(seed) for seed in range(200)])
    assert [begun[:2] for begun in run.simulation.record.begun] == [(1, 1), (199, 1)]


def test_slow_orders_run_in_batches_that_do_not_hold_up_pages(live, monkeypatch):
    run = live()
    obeyed = []
    monkeypatch.setattr(PacedRun, "_execute", lambda _, command: obeyed.append(command))
    monkeypatch.setattr(paced_run, "time", SimpleNamespace(monotonic=lambda: 0.003 * len(obeyed)))
    for _ in range(100):
        run.offer(Freeze(True), print)

    run._execute_all()

    assert len(obeyed) == 3
    assert len(run._commands) == 97


def test_impossible_order_is_reported_and_not_recorded(live):
    run = live()
    robot = run.simulation.arena.body.pose
    assert order(run, Edit("add_bar", a=robot[:2], b=(0.0, 0.0))) == ["the robot stands there"]
    assert run.simulation.record.edits == []


def test_more_orders_than_fit_are_refused_and_counted(live):
    run = live()
    for _ in range(COMMANDS_MAX + 3):
        run.offer(Play(True), print)
    assert run.refused == 3


def test_order_acts_on_the_robot_of_its_node(live):
    run = live(robots=2)
    assert order(run, WriteCell(3, 1, node=2), MoveRobot(Edit("lift"), 2), Freeze(True, node=1)) == []
    assert [client.memory[3] for client in run.simulation.clients] == [0, 1]
    assert [body.lifted for body in run.simulation.arena.bodies] == [False, True]
    assert [history.frozen for history in run.recorder.histories] == [True, False]
    assert order(run, EraseMemory(node=3)) == ["there is no robot 3; there are 1, 2"]


class BabblingLink:
    """A line on which somebody never stops talking."""

    def receive(self, _timeout_s: float) -> Frame:
        return Frame(0, b"")


def test_link_that_never_falls_silent_does_not_hold_up_a_pause(live):
    run = live()
    client = run.simulation.clients[0]
    client.connection = replace(client.connection, link=BabblingLink())

    run._idle()

    assert run.rate == 0.0


def to_the_end(run: PacedRun) -> None:
    """Goes to the last environment, and to its last tick."""
    order(run, *[NextEnvironment()] * 4)
    run.simulation.record.limit_ticks = run.simulation.episode.ticks + 1
    run.offer(Play(True), print)
    play(run, lambda: run.done)


def test_next_environment_and_new_seed_are_recorded(live):
    run = live(speed=FULL_SPEED)
    order(run, NextEnvironment(), NewSeed(9))
    assert [begun[:2] for begun in run.simulation.record.begun] == [(1, 1), (1, 2), (9, 1)]
    assert len(run.episodes) == 2


def test_paced_run_waits_for_a_new_seed_after_its_last_environment(live):
    run = live(speed=FULL_SPEED)
    to_the_end(run)
    assert order(run, Edit("lift")) == ["the run is over: start over to see more"]
    order(run, NewSeed(2))
    assert not run.done
    assert run.simulation.record.begun[-1][:2] == (2, 1)


def test_paced_run_ends_without_viewers(live):
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


def test_end_of_an_environment_stays_in_view_during_the_pause(live, monkeypatch):
    run = over_soon(live, monkeypatch, pause_s=1000.0)
    turns = iter(range(20))
    play(run, lambda: next(turns, None) is None)

    assert (run.simulation.tick, run.simulation.record.begun[-1].number) == (3, 1)
    ended = json.loads(PageFeed(run).next())["play"]["ended"]
    assert (ended["number"], ended["finished"], ended["eaten"], ended["food"]) == (1, False, 0, 3)
    assert order(run, Edit("lift")) == ["this environment is over: the next one begins in a moment"]


def test_next_environment_begins_after_the_pause(live, monkeypatch):
    run = over_soon(live, monkeypatch, pause_s=0.05)
    play(run, lambda: run.simulation.record.begun[-1].number == 2)

    assert len(run.episodes) == 1
    assert json.loads(PageFeed(run).next())["play"]["ended"] is None


def test_order_for_the_next_environment_cuts_the_pause_short(live, monkeypatch):
    run = over_soon(live, monkeypatch, pause_s=1000.0)
    run.simulation.record.limit_ticks = 1000
    order(run, NextEnvironment())

    assert [begun.number for begun in run.simulation.record.begun] == [1, 2]
    assert len(run.episodes) == 1


@pytest.mark.parametrize("keep", [False, True])
def test_starting_over_resets_all_but_a_kept_memory(live, keep):
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


def test_order_for_the_next_environment_does_not_end_the_run(live):
    run = live(speed=FULL_SPEED)
    complaints = order(run, *[NextEnvironment()] * 6)
    assert complaints == ["this is the last environment: start over to see more"] * 2
    assert not run.done
    assert run.simulation.record.begun[-1].number == 5


def meddled_with(run: PacedRun, *orders: list[PageCommand]) -> str:
    """Runs 137 ticks before each of these groups of orders, and ends the run; returns the SHA-256 of its log."""
    for group in orders:
        for _ in range(137):
            run.simulation.step()
        order(run, *group)
    stop(run.simulation.clients[0])
    return run.simulation.clients[0].log.close()


def from_log(run: PacedRun, log: Path) -> dict[str, Any]:
    """What a page shows of a run that has ended, from its log alone."""
    write_world(run.simulation.record, world_path(log))
    return run_data(resimulate(log).trajectory, "")


def test_equal_orders_at_equal_ticks_give_equal_runs(live):
    orders = (
        [Edit("add_bar", a=(1000.0, 200.0), b=(1000.0, 900.0)), WriteCell(2, 1)],
        [Edit("lift")],
        [Edit("put", at=(2000.0, 2700.0), heading=500), Edit("move_food", 0, at=(300.0, 300.0))],
        [NextEnvironment(), Freeze(True)],
        [NewSeed(4)],
    )

    assert meddled_with(live("once"), *orders) == meddled_with(live("again"), *orders)


def test_environment_that_ended_without_a_tick_is_replayed_from_the_log(live, tmp_path):
    run = live("skipped")
    meddled_with(run, [Edit("body", what="odometer:left:150%")], [NewSeed(4), NextEnvironment()], [])

    run.recorder.trajectory.news = news_of(run.simulation.record)
    assert from_log(run, tmp_path / "skipped.log") == run_data(run.recorder.trajectory, "")


def test_memory_reported_at_the_start_is_replayed_from_the_log(live, tmp_path):
    run = live("fixed", fixed=True)
    meddled_with(run, [WriteCell(3, 2)], [NewSeed(4)], [NewSeed(5, keep=True), WriteCell(2, 2)], [])

    assert from_log(run, tmp_path / "fixed.log") == run_data(run.recorder.trajectory, "")


def test_cells_written_between_two_ticks_are_replayed_from_the_log(live, tmp_path):
    run = live("changed")
    meddled_with(
        run,
        [WriteCell(3, 1), WriteCell(3, 2), WriteCell(5, 1)],
        [EraseMemory(), WriteCell(3, 1), Freeze(True)],
        [WriteCell(6, 2), NewSeed(4), WriteCell(2, 1), WriteCell(2, 2)],
        [WriteCell(1, 1), NewSeed(5, keep=True)],
        [WriteCell(4, 1)],
    )

    assert len(run.recorder.histories[0].lessons) > 8
    assert from_log(run, tmp_path / "changed.log") == run_data(run.recorder.trajectory, "")
