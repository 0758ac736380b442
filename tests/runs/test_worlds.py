"""Runs in other worlds: recorded, repeated from their logs, and refused with what was meant."""

import pytest

from host_sim.recording.resimulation import resimulate
from tests.runs.support import octet

BRIEF = ("--environments", "1", "--limit-s", "5", "--bus", "none")


@pytest.mark.parametrize("world", ["corridors", "small"])
def test_a_run_in_another_world_can_be_repeated_from_its_log(run, world):
    done = run("--world", world, "--environments", "2", "--limit-s", "5", "--bus", "none")

    result = resimulate(done.out / "run.log")
    assert done.summary["world"] == world
    assert result.title == f"seed 1, {world}"
    assert result.trajectory.ticks == sum(environment["ticks"] for environment in done.summary["environments"])


def test_a_run_in_a_world_of_ones_own_can_be_repeated_when_its_file_is_gone(run, tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("size = [1000, 1000]\nstart = [200, 500, 0]\nfood = [[800, 500]]")
    done = run("--world", own, *BRIEF)
    own.unlink()

    assert resimulate(done.out / "run.log").trajectory.params.width_mm == 1000
    assert done.summary["environments"][0]["finished"]


def test_the_random_world_is_what_a_run_takes_place_in_unless_another_is_named(run):
    assert run(*BRIEF).log == run("--world", "random", *BRIEF).log


def test_a_mistake_in_a_world_leaves_everything_as_it_was(run, tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("# two mistakes\nfoot = []")
    done = run("--world", own, *BRIEF)

    assert (done.code, done.output) == (2, "")
    assert done.errors == f"octet: {own}:2: there is no 'foot': did you mean 'food'?\n"
    assert not done.out.exists()


def test_more_robots_than_a_world_has_room_for_are_refused(tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("size = [600, 600]\nfood = [[300, 300]]")

    done = octet("run", "--world", own, "--robots", "9", "--out", tmp_path / "out", *BRIEF)

    assert done.returncode == 2
    assert "9 robots are too many for seed 1" in done.stderr
