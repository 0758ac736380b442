"""What the article claims, over forty seeds of five environments each."""

import statistics
from concurrent.futures import ProcessPoolExecutor

import pytest

from host_sim.protocol.generated import Side
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import EpisodeResult

SEEDS = range(1, 41)
ENOUGH = 0.95


def episodes_of(seed: int) -> list[EpisodeResult]:
    """Five environments."""
    with make(RunConfig(seed=seed)) as simulation:
        return list(simulation.run())


@pytest.fixture(scope="module")
def runs() -> list[list[EpisodeResult]]:
    with ProcessPoolExecutor(2) as processes:
        return list(processes.map(episodes_of, SEEDS))


@pytest.fixture(scope="module")
def environments(runs) -> list[EpisodeResult]:
    return [episode for episodes in runs for episode in episodes]


def share(truths: list[bool]) -> float:
    return sum(truths) / len(truths)


def test_nearly_every_environment_is_finished(environments):
    assert share([episode.finished for episode in environments]) >= ENOUGH


def test_two_environments_are_enough_to_learn_the_proper_responses(runs):
    after_two = [episodes[1].robots[0].memory for episodes in runs]

    assert share([(memory[1], memory[4]) == (Side.LEFT, Side.RIGHT) for memory in after_two]) >= ENOUGH


def test_what_is_on_the_right_causes_left_turns_and_the_other_way_round(environments):
    proper = {1: Side.LEFT, 3: Side.LEFT, 4: Side.RIGHT, 6: Side.RIGHT}

    assert all(
        episode.robots[0].memory[cell] in (0, side) for episode in environments for cell, side in proper.items()
    )


def test_for_symmetrical_patterns_robots_differ(runs):
    last = [episodes[-1].robots[0].memory for episodes in runs]

    assert all({memory[cell] for memory in last} >= {Side.LEFT, Side.RIGHT} for cell in (5, 7))


def test_hardly_a_robot_ever_touches_anything(environments):
    assert share([episode.robots[0].collisions == 0 for episode in environments]) >= ENOUGH


def test_an_environment_takes_a_few_minutes(environments):
    assert 100 < statistics.median(episode.robot_s for episode in environments) < 220
