"""What is done for one robot is done for the second of two, and for the last of several environments."""

from pathlib import Path

import pytest

from host_sim.protocol.codec import Protocol
from host_sim.recording.log_reader import read_log
from host_sim.recording.recording import read_recording

TWO = ("--bus", "none", "--robots", "2", "--limit-s", "20")
ONE_MEMORY, OTHER_MEMORY = bytes((0, 1, 0, 0, 2, 0, 2, 0)), bytes((0, 2, 0, 1, 0, 0, 1, 0))


def seed_of(log: Path, node: int) -> int | None:
    return read_recording(read_log(log), Protocol(node)).seed


def test_second_robot_has_the_next_seed(run):
    log = run(*TWO, "--environments", "1", "--seed", "4").out / "run.log"

    assert [seed_of(log, node) for node in (1, 2)] == [4, 5]


def test_second_robot_has_its_own_memory_and_keeps_it(run, tmp_path):
    (tmp_path / "robot-1.mem").write_bytes(ONE_MEMORY)
    (tmp_path / "robot-2.mem").write_bytes(OTHER_MEMORY)

    words = ("--environments", "1", "--limit-s", "0.02", "--memory", tmp_path / "robot.mem")
    done = run("--bus", "none", "--robots", "2", *words)

    assert [bytes(robot["memory"]) for robot in done.summary["robots"]] == [ONE_MEMORY, OTHER_MEMORY]
    assert (tmp_path / "robot-2.mem").read_bytes() == OTHER_MEMORY


@pytest.mark.faulty
def test_incidents_name_the_second_doubtful_robot_too(run):
    done = run(*TWO, "--environments", "1", "--fault", "forge:freeze@300/to")

    incidents = " ".join(done.summary["incidents"])
    assert [f"(node {node})" in incidents for node in (1, 2)] == [True, True]


def test_second_robot_is_in_the_summary_and_stopped_like_the_first(run):
    done = run(*TWO, "--environments", "1")

    assert [robot["node"] for robot in done.summary["robots"]] == [1, 2]
    assert done.log.count(b" 021#") == done.log.count(b" 022#")


def test_summary_has_each_environment_to_the_last(run):
    environments = run(*TWO, "--environments", "3").summary["environments"]

    assert len(environments) == 3
    assert any(0 < each["food_eaten"] < 3 for each in environments)
    assert [each["finished"] for each in environments] == [each["food_eaten"] == 3 for each in environments]


def test_run_prints_all_done_once_the_last_environment_is_done(run):
    assert "ALL DONE" in run("--bus", "none", "--environments", "2").output
