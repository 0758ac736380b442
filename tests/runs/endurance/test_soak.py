"""Samples of what runs for hours: each is run whole by name, as its module says."""

import subprocess
import sys

import pytest

from tests.runs.endurance.noise import is_whole, run_through_noise
from tests.runs.endurance.storm import storm_at_robot, storm_at_simulator
from tests.runs.support import ROOT


def test_resources_do_not_grow_with_time_or_starts():
    command = [sys.executable, "-m", "tests.runs.endurance.soak", "0.04", "--step", "0.02", "--starts", "20"]

    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert done.stdout.count(" h  ") == 2


def test_last_lesson_is_in_the_memory_file_however_a_run_ends():
    command = [sys.executable, "-m", "tests.runs.endurance.kills", "4"]

    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert done.stdout.count(" 0 lost\n") == 8


@pytest.mark.faulty
def test_real_time_run_goes_on_over_a_noisy_line(tmp_path):
    run = run_through_noise(tmp_path / "out", 2.0, chance=0.03)

    assert is_whole(run, 2.0), run.output + run.errors
    assert run.code == 0 or "result unreliable" in run.errors


def test_robot_sends_only_allowed_frames_whatever_it_receives():
    said = storm_at_robot(20_000, seed=1)

    assert said["ANSWER"] > 0


def test_simulator_goes_on_or_ends_in_order_whatever_it_receives():
    outcomes = storm_at_simulator(20_000, seed=1)

    assert sum(outcomes.values()) == 40
    assert outcomes.keys() <= {"went on", "SessionLostError"}
