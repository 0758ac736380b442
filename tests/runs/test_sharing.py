"""Whole runs of robots that teach each other."""

import pytest

from host_sim.protocol.memory_kinds import sides_of
from host_sim.sim.simulation import Simulation
from tests.runs.support import octet

FOUR = ("--robots", "4", "--seed", "2", "--limit-s", "40", "--environments", "1")
PROPER = {1: 1, 3: 1, 4: 2, 6: 2}


def knows(robot: dict) -> set[int]:
    """The patterns for which a robot of a summary has learned the proper turn."""
    sides = sides_of(tuple(robot["memory"]))
    return {cell for cell, side in PROPER.items() if sides[cell] == side}


@pytest.fixture
def shared(run):
    """Four robots that teach each other."""
    return run(*FOUR, "--bus", "none", "--profile", "adaptive", "--set", "share=1")


def test_after_40_seconds_each_knows_what_only_some_know_who_do_not_share(run, shared):
    alone = run(*FOUR, "--bus", "none", "--profile", "adaptive")

    assert [knows(robot) for robot in shared.summary["robots"]] == [{1, 3, 4, 6}] * 4
    assert min(len(knows(robot)) for robot in alone.summary["robots"]) < len(PROPER)


def test_over_a_socket_pair_each_hears_the_same(run, shared):
    assert run(*FOUR, "--bus", "fd", "--profile", "adaptive", "--set", "share=1").log == shared.log


def test_in_python_each_hears_the_same(run, shared, monkeypatch):
    monkeypatch.setattr(Simulation, "native", False)
    monkeypatch.setattr(Simulation, "_enter_loop", lambda _: None)

    assert run(*FOUR, "--bus", "none", "--profile", "adaptive", "--set", "share=1").log == shared.log


@pytest.mark.vcan
def test_on_a_bus_each_hears_the_same(run, shared):
    assert run(*FOUR, "--bus", "socketcan:vcan0", "--profile", "adaptive", "--set", "share=1").log == shared.log


@pytest.mark.parametrize("node", ["1", "4"])
def test_a_replay_hears_the_others_too(shared, node):
    replayed = octet("replay", shared.out / "run.log", "--node", node)

    assert "no difference" in replayed.stdout


def test_profiles_that_learn_otherwise_teach_each_other(run):
    article = run(*FOUR, "--bus", "none", "--profile", "article", "--set", "share=1")

    assert [knows(robot) for robot in article.summary["robots"]] == [{1, 3, 4, 6}] * 4


def test_robots_with_all_five_sensors_do_not_take_part(run):
    words = (*FOUR, "--bus", "none", "--profile", "five")
    share, alone = run(*words, "--set", "share=1"), run(*words)

    assert [robot["memory"] for robot in share.summary["robots"]] == [it["memory"] for it in alone.summary["robots"]]
