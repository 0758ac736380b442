"""A run that is obeyed between two ticks: paced, recorded, the same again for the same orders at the same ticks."""

import asyncio
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from host_sim.client.frame_log import Recorder
from host_sim.client.pacing import Lockstep
from host_sim.client.session import Session
from host_sim.live.feed import PageFeed
from host_sim.live.orders import (
    FULL_SPEED,
    EraseMemory,
    Freeze,
    NewSeed,
    NextEnvironment,
    OneDecision,
    Order,
    Play,
    WriteCell,
)
from host_sim.live.paced_run import ORDERS_MAX, PacedRun
from host_sim.protocol.codec import Protocol
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.simulation import Simulation
from host_sim.transport.in_process_link import InProcessLink
from host_sim.world.edits import AddBar, Lift, MoveFood, Put
from host_sim.world.geometry import Bar, Pose
from host_sim.world.params import SimParams

Live = Callable[..., PacedRun]


@pytest.fixture
def live(tmp_path: Path) -> Iterator[Live]:
    """Makes runs that have begun, each with a log of its own."""
    recorders = []

    def make(name: str = "run", **options) -> PacedRun:
        recorders.append(Recorder(tmp_path / f"{name}.log"))
        session = Session(InProcessLink(), Protocol(), recorders[-1])
        session.handshake(1.0)
        session.start(1, 0, {}, None)
        simulation = Simulation(SimParams(), session, Lockstep(session), 1, 5, 600.0)
        run_recorder = RunRecorder(simulation)
        simulation.watch = run_recorder
        run = PacedRun(simulation, run_recorder.history, lambda seed: session.start(seed, 0, {}, None), **options)
        run.begin()
        return run

    yield make
    for recorder in recorders:
        recorder.close()


def play(live: PacedRun, until: Callable[[], object], limit_s: float = 10.0) -> None:
    """Lets it run until something is so."""

    async def run() -> None:
        player = asyncio.create_task(live.play())
        give_up = time.monotonic() + limit_s
        while not (until() or player.done()):
            assert time.monotonic() < give_up
            await asyncio.sleep(0)
        player.cancel()

    asyncio.run(run())


def order(live: PacedRun, *orders: Order) -> list[str]:
    """Has orders obeyed; returns the complaints."""
    complaints: list[str] = []
    for one in orders:
        live.offer(one, complaints.append)
    live.offer(Play(False), complaints.append)
    play(live, lambda: not live.playing and not live._orders)
    return complaints


def test_it_keeps_the_time_of_the_wall(live):
    run = live(speed=4.0)
    began = time.monotonic()
    play(run, lambda: run.simulation.tick >= 100)
    assert time.monotonic() - began == pytest.approx(100 * 0.02 / 4, abs=0.2)


def test_full_speed_waits_for_nothing(live):
    run = live(speed=FULL_SPEED)
    began = time.monotonic()
    play(run, lambda: run.simulation.tick >= 2000)
    assert time.monotonic() - began < 2000 * 0.02 / 4


def test_one_decision_is_one_more_action(live):
    run = live(speed=FULL_SPEED)
    order(run, Play(False))
    action = run.simulation.drive.action
    run.offer(OneDecision(), print)
    play(run, lambda: run.simulation.drive.action != action and not run.playing)
    assert run.simulation.drive.action == (action + 1) % 128


def test_cells_are_written_and_erased_at_once_while_it_stands(live):
    run = live()
    order(run, WriteCell(3, 1), WriteCell(6, 2))
    assert run.simulation.session.memory == (0, 0, 0, 1, 0, 0, 2, 0)
    lessons = [(lesson["cell"], lesson["side"], lesson["by_hand"]) for lesson in run.history.lessons]
    assert lessons == [(3, 1, 1), (6, 2, 1)]
    order(run, EraseMemory())
    assert run.simulation.session.memory == (0,) * 8


def test_a_frozen_robot_learns_nothing(live):
    run = live(speed=FULL_SPEED)
    order(run, Freeze(True))
    run.offer(Play(True), print)
    play(run, lambda: run.history.trials > 5)
    assert run.history.memory == (0,) * 8
    assert run.history.frozen


def test_the_next_environment_and_a_new_seed_are_recorded(live):
    run = live(speed=FULL_SPEED)
    order(run, NextEnvironment(), NewSeed(9))
    assert [begun[:2] for begun in run.simulation.record.begun] == [(1, 1), (1, 2), (9, 1)]
    assert len(run.episodes) == 2


def test_after_the_last_environment_it_waits_for_a_new_seed(live):
    run = live(speed=FULL_SPEED)
    order(run, *[NextEnvironment()] * 5)
    assert run.done
    assert order(run, Lift()) == ["the run is over: choose a new seed"]
    order(run, NewSeed(2))
    assert not run.done


def test_it_ends_by_itself_where_nobody_stays(live):
    run = live(speed=FULL_SPEED, stays=False)
    for _ in range(5):
        run.offer(NextEnvironment(), print)
    asyncio.run(run.play())
    assert len(run.episodes) == 5


def test_what_cannot_be_done_is_complained_of_and_not_recorded(live):
    run = live()
    robot = run.simulation.arena.pose
    assert order(run, AddBar(Bar(robot[:2], (0.0, 0.0)))) == ["the robot stands there"]
    assert run.simulation.record.edits == []


def test_more_orders_than_fit_are_refused_and_counted(live):
    run = live()
    for _ in range(ORDERS_MAX + 3):
        run.offer(Play(True), print)
    assert run.refused == 3


def test_equal_orders_at_equal_ticks_give_equal_runs(live):
    def meddle(name: str) -> str:
        run = live(name)
        simulation = run.simulation
        for orders in (
            [AddBar(Bar((1000.0, 200.0), (1000.0, 900.0))), WriteCell(2, 1)],
            [Lift()],
            [Put(Pose(2000.0, 2700.0, 0.5)), MoveFood(0, (300.0, 300.0))],
            [NextEnvironment(), Freeze(True)],
            [NewSeed(4)],
        ):
            for _ in range(137):
                simulation.step()
            order(run, *orders)
        simulation.session.stop()
        return simulation.session.recorder.close()

    assert meddle("once") == meddle("again")


def test_a_page_is_told_what_is_new_and_only_that(live):
    run = live(speed=FULL_SPEED)
    feed = PageFeed(run)
    assert feed.next() is not None
    assert feed.next() is None
    run.simulation.step()
    assert "environment" not in feed.next()


def test_a_page_that_asks_seldom_gets_no_more_than_one_that_asks_often(live):
    run = live(speed=FULL_SPEED)
    feed = PageFeed(run)
    while run.simulation.tick < 20_000:
        if run.simulation.over:
            run.simulation.enter(2)
        run.simulation.step()
    assert len(feed.next()) < 10_000
