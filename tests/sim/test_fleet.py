"""Fleets against runs of single robots, and of several in one world: the same results, robot by robot."""

import subprocess
import sys
from dataclasses import replace

import pytest

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.protocol.generated import PROFILES, Reason
from host_sim.sim import fleet, native_fleet
from host_sim.sim.fleet import FleetResult, run_fleet
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import Pose, SimParams
from host_sim.world.layouts import Layout

UNSEEN = native_fleet.Contacts(0, 0, 0, False)
OWN = RunConfig(seed=11, robots=3, worlds="own", environments=2, limit_s=60.0)


def results_with_frames(config: RunConfig, number_from: int = 1) -> list[FleetResult]:
    """What the robots of an ordinary run do, as a fleet's results."""
    results = []
    with make(config) as simulation:
        for number, episode in enumerate(simulation.run(), 1):
            for index, robot in enumerate(episode.robots):
                results.append(
                    FleetResult(
                        index + number_from,
                        config.seed + index,
                        number,
                        tuple(episode.eaten),
                        robot.food_eaten,
                        episode.ticks,
                        robot.begun,
                        robot.collisions,
                        0,
                        None,
                        UNSEEN,
                        robot.memory,
                        simulation.arena.bodies[index].pose,
                    )
                )
    return results


def in_order(results: list[FleetResult]) -> list[FleetResult]:
    """Without the contacts, which a run of its own does not count; tests of studies compare them."""
    seen = [replace(result, contacts=UNSEEN, known_ticks=None, met=()) for result in results]
    return sorted(seen, key=lambda result: (result.robot, result.environment))


@pytest.mark.parametrize("profile", [profile for profile in PROFILES if profile != "distance"])
def test_fleet_robots_in_their_own_worlds_equal_single_runs(profile):
    config = replace(OWN, profile=profile, settings={"boredom_limit": 6})
    alone = [
        result
        for i in range(config.robots)
        for result in results_with_frames(replace(config, seed=config.seed + i, robots=1, worlds="one"), i + 1)
    ]

    assert in_order(list(run_fleet(config))) == alone


@pytest.mark.parametrize("robots", [1, 5, 31])
def test_fleet_robots_in_one_world_equal_robots_on_a_bus(robots):
    config = RunConfig(seed=1, robots=robots, environments=2, limit_s=20.0)

    assert in_order(list(run_fleet(config))) == in_order(results_with_frames(config))


def test_fleet_has_the_body_faults_that_exist_from_the_start():
    config = replace(OWN, robots=1, changes=("mirror@0s", "weak-motor:left:80%@env1"))

    found = in_order(list(run_fleet(config)))
    assert found == in_order(results_with_frames(replace(config, worlds="one")))
    assert found != in_order(list(run_fleet(replace(config, changes=()))))


@pytest.mark.parametrize("change", ["mirror@env2", "mirror@5s", "mirror@0s/1", "plant@0s"])
def test_fleet_refuses_changes_other_than_body_faults_from_the_start(change):
    with pytest.raises(UsageError, match="nothing changes in a fleet"):
        run_fleet(replace(OWN, changes=(change,)))


def test_frozen_robots_keep_their_memories_and_have_their_seeds():
    frozen = [fleet.Frozen(seed, (0, 1, 0, 0, 2, 0, 0, 0)) for seed in (11, 11, 12)]
    config = replace(OWN, environments=1, limit_s=20.0)

    same, again, other = in_order(list(run_fleet(config, frozen=frozen)))
    assert same.memory == other.memory == (0, 1, 0, 0, 2, 0, 0, 0)
    assert replace(again, robot=1) == same
    assert (other.seed, other.pose) != (same.seed, same.pose)


@pytest.mark.parametrize("world", ["corridors", "small"])
def test_fleet_equals_single_runs_in_other_worlds(world):
    config = RunConfig(seed=1, robots=4, environments=2, limit_s=20.0, world=world)

    assert in_order(list(run_fleet(config))) == in_order(results_with_frames(config))


@pytest.mark.parametrize(("profile", "seed"), [("article", 1), ("adaptive", 2), ("searcher", 3)])
def test_fleet_robots_share_memories_as_on_a_bus(profile, seed):
    config = RunConfig(seed=seed, robots=5, environments=3, limit_s=60.0, profile=profile, settings={"share": 1})

    results = in_order(list(run_fleet(config)))

    assert results == in_order(results_with_frames(config))
    assert results != in_order(list(run_fleet(replace(config, settings={}))))


def test_robots_in_their_own_worlds_hear_only_their_company():
    config = replace(OWN, robots=6, profile="adaptive", settings={"share": 1})

    in_company = in_order(list(run_fleet(config, company=3)))

    assert in_company[:6] == in_order(list(run_fleet(replace(config, robots=3), company=3)))
    assert in_company != in_order(list(run_fleet(replace(config, settings={}), company=3)))


def test_fleet_loads_the_world_library_before_its_threads_begin():
    code = (
        "from host_sim.sim.fleet import run_fleet\n"
        "from host_sim.sim.run_config import RunConfig\n"
        "from host_sim.world.world_library import world_library\n"
        "run_fleet(RunConfig(robots=2, worlds='own'))\n"
        "print(world_library.cache_info().currsize)"
    )

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=ROOT)

    assert (done.stdout, done.stderr) == ("1\n", "")


def test_finished_environment_of_a_fleet_equals_that_of_a_single_run():
    config = RunConfig(seed=5, environments=1)

    (result,) = run_fleet(replace(config, worlds="own"))

    assert result.finished
    assert in_order([result]) == results_with_frames(config)


def test_more_robots_than_node_numbers_meet_in_one_world():
    config = RunConfig(seed=1, robots=50, environments=1, limit_s=20.0)

    results = list(run_fleet(config))

    assert len(results) == 50
    assert sum(result.collisions for result in results) < 50
    assert any(result.begun.get(Reason.TRIAL) for result in results)


def test_too_many_robots_are_refused_with_how_many_fit():
    with pytest.raises(
        UsageError, match=r"there is room for \d+ robots in environment 1; take fewer, or --worlds own"
    ):
        run_fleet(RunConfig(robots=1000))


def test_hall_has_room_for_more_robots():
    config = RunConfig(seed=1, robots=140, worlds="hall", environments=2, limit_s=10.0)

    results = list(run_fleet(config))

    assert len(results) == 280
    assert max(result.pose.x_mm for result in results) > 8000.0
    assert max(result.pose.y_mm for result in results) > 6000.0
    assert all(len(result.eaten) == 27 for result in results)


@pytest.mark.parametrize("worlds", ["one", "hall"])
def test_robots_do_the_same_with_and_without_a_grid(monkeypatch, worlds):
    config = RunConfig(seed=2, robots=60, worlds=worlds, environments=1, limit_s=40.0)
    with_a_grid = list(run_fleet(config))

    monkeypatch.setattr(native_fleet, "_GRID_FROM", 1000)

    assert list(run_fleet(config)) == with_a_grid
    assert sum(result.begun.get(Reason.REMEMBERED, 0) for result in with_a_grid) > 100


def test_food_beyond_the_largest_beacon_distance_is_not_seen(monkeypatch):
    hall = Layout((), ((11_000.0, 1000.0),), Pose(2000.0, 1000.0, 0.0))
    monkeypatch.setattr(
        fleet,
        "shared_world",
        lambda *_: (hall, SimParams(width_mm=16_000.0, bar_count=0, food_bands_mm=((0.0, 0.0),))),
    )

    (result,) = run_fleet(RunConfig(seed=1, worlds="hall", environments=1, limit_s=1.0))

    assert Reason.WANDER in result.begun
    assert Reason.TOWARD_FOOD not in result.begun


def test_fleet_refuses_a_behaviour_that_measures_distances():
    with pytest.raises(UsageError, match="profile distance needs distances"):
        run_fleet(replace(OWN, profile="distance"))


def test_last_seed_is_followed_by_the_first():
    seeds = [result.seed for result in run_fleet(replace(OWN, seed=2**32 - 1, environments=1, limit_s=1.0))]

    assert seeds == [2**32 - 1, 0, 1]


@pytest.mark.parametrize("worlds", ["own", "one"])
def test_progress_counts_the_ticks_of_all_robots(worlds):
    counts: list[int] = []

    results = list(run_fleet(replace(OWN, worlds=worlds), counts.append))

    assert counts[-1] == sum(result.ticks for result in results)
    assert counts == sorted(counts)
