"""What the article claims, over forty seeds of five environments each."""

import statistics
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from host_sim.robots.connection import connect
from host_sim.wire.lockstep import Lockstep
from host_sim.wire.protocol import Protocol
from host_sim.wire.record import Recorder
from host_sim.wire.session import Session
from host_sim.world.environment import World
from host_sim.world.simulation import Chapter, Simulation

SEEDS = range(1, 41)
ENOUGH = 0.95
LEFT, RIGHT = 1, 2


def chapters_of(seed: int) -> list[Chapter]:
    """Five environments, without their trails, which are long."""
    with TemporaryDirectory() as folder, ExitStack() as stack:
        recorder = Recorder(Path(folder) / "run.log")
        stack.callback(recorder.close)
        session = Session(connect(stack, "none", "spawn", 1).link, Protocol(), recorder)
        session.greet(5.0)
        session.start(seed, 0, {}, None)
        chapters = list(Simulation(World(), session, Lockstep(session), seed, 5, 600.0).run())
    for chapter in chapters:
        chapter.trail.clear()
    return chapters


@pytest.fixture(scope="module")
def runs() -> list[list[Chapter]]:
    with ProcessPoolExecutor(2) as processes:
        return list(processes.map(chapters_of, SEEDS))


@pytest.fixture(scope="module")
def environments(runs) -> list[Chapter]:
    return [chapter for chapters in runs for chapter in chapters]


def share(truths: list[bool]) -> float:
    return sum(truths) / len(truths)


def test_nearly_every_environment_is_finished(environments):
    assert share([chapter.finished for chapter in environments]) >= ENOUGH


def test_two_environments_are_enough_to_learn_the_proper_responses(runs):
    after_two = [chapters[1].memory for chapters in runs]

    assert share([(memory[1], memory[4]) == (LEFT, RIGHT) for memory in after_two]) >= ENOUGH


def test_what_is_on_the_right_causes_left_turns_and_the_other_way_round(environments):
    proper = {1: LEFT, 3: LEFT, 4: RIGHT, 6: RIGHT}

    assert all(chapter.memory[cell] in (0, side) for chapter in environments for cell, side in proper.items())


def test_for_symmetrical_patterns_robots_differ(runs):
    last = [chapters[-1].memory for chapters in runs]

    assert all({memory[cell] for memory in last} >= {LEFT, RIGHT} for cell in (5, 7))


def test_hardly_a_robot_ever_touches_anything(environments):
    assert share([chapter.collisions == 0 for chapter in environments]) >= ENOUGH


def test_an_environment_takes_a_few_minutes(environments):
    assert 100 < statistics.median(chapter.robot_s for chapter in environments) < 220
