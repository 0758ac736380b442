"""What the article claims, over forty seeds of five environments each."""

import statistics
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from host_sim.backends.connection import connect
from host_sim.client.frame_log import Recorder
from host_sim.client.pacing import Lockstep
from host_sim.client.session import Session
from host_sim.protocol.codec import Protocol
from host_sim.sim.simulation import EpisodeResult, Simulation
from host_sim.world.params import SimParams

SEEDS = range(1, 41)
ENOUGH = 0.95
LEFT, RIGHT = 1, 2


def chapters_of(seed: int) -> list[EpisodeResult]:
    """Five environments, without their trails, which are long."""
    with TemporaryDirectory() as folder, ExitStack() as stack:
        recorder = Recorder(Path(folder) / "run.log")
        stack.callback(recorder.close)
        session = Session(connect(stack, "none", "spawn", 1).link, Protocol(), recorder)
        session.handshake(5.0)
        session.start(seed, 0, {}, None)
        episodes = list(Simulation(SimParams(), session, Lockstep(session), seed, 5, 600.0).run())
    for episode in episodes:
        episode.trail.clear()
    return episodes


@pytest.fixture(scope="module")
def runs() -> list[list[EpisodeResult]]:
    with ProcessPoolExecutor(2) as processes:
        return list(processes.map(chapters_of, SEEDS))


@pytest.fixture(scope="module")
def environments(runs) -> list[EpisodeResult]:
    return [episode for episodes in runs for episode in episodes]


def share(truths: list[bool]) -> float:
    return sum(truths) / len(truths)


def test_nearly_every_environment_is_finished(environments):
    assert share([episode.finished for episode in environments]) >= ENOUGH


def test_two_environments_are_enough_to_learn_the_proper_responses(runs):
    after_two = [episodes[1].memory for episodes in runs]

    assert share([(memory[1], memory[4]) == (LEFT, RIGHT) for memory in after_two]) >= ENOUGH


def test_what_is_on_the_right_causes_left_turns_and_the_other_way_round(environments):
    proper = {1: LEFT, 3: LEFT, 4: RIGHT, 6: RIGHT}

    assert all(episode.memory[cell] in (0, side) for episode in environments for cell, side in proper.items())


def test_for_symmetrical_patterns_robots_differ(runs):
    last = [episodes[-1].memory for episodes in runs]

    assert all({memory[cell] for memory in last} >= {LEFT, RIGHT} for cell in (5, 7))


def test_hardly_a_robot_ever_touches_anything(environments):
    assert share([episode.collisions == 0 for episode in environments]) >= ENOUGH


def test_an_environment_takes_a_few_minutes(environments):
    assert 100 < statistics.median(episode.robot_s for episode in environments) < 220
