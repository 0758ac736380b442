"""A robot that dies, hangs, or is held up in the middle of a run; and faults made on purpose."""

import contextlib
import os
import random
import re
import signal
import time
from pathlib import Path

import pytest

from tests.runs.support import BUSY_HOST, octet, robot_of, start_octet, wait_for_lines, wait_until
from tests.runs.test_slcan import drives_in
from tests.tools.project import alive

LONG = ("--environments", "20", "--bus", "fd", "--quiet")


@pytest.fixture
def long_run(tmp_path):
    """A run that goes on for long enough to be disturbed, and its robot's process."""
    process = start_octet("run", "--out", tmp_path, *LONG)
    robot = robot_of(process)
    wait_for_lines(process, tmp_path / "run.log", 4000)
    yield process, robot
    process.kill()
    process.communicate()


ENDS = [
    ("simulator", signal.SIGKILL),
    ("simulator", signal.SIGTERM),
    ("simulator", signal.SIGINT),
    ("robot", signal.SIGKILL),
]


@pytest.mark.parametrize(("victim", "number"), ENDS)
def test_last_lesson_is_in_the_memory_file_whatever_ends_the_run(tmp_path, victim, number):
    memory = tmp_path / "robot.mem"
    process = start_octet("run", "--out", tmp_path, "--memory", memory, *LONG)
    robot = robot_of(process)
    wait_until(lambda: memory.exists() and any(memory.read_bytes()), "a lesson")

    os.kill(robot if victim == "robot" else process.pid, number)
    process.communicate()

    learned = memory.read_bytes()
    assert len(learned) == 8
    assert any(learned)


def test_robot_that_hangs_is_named_with_its_tick_and_last_frame(long_run):
    process, robot = long_run

    os.kill(robot, signal.SIGSTOP)

    _, errors = process.communicate()
    assert process.returncode == 1
    assert "did not answer tick" in errors
    assert "last frame from it: DRIVE" in errors
    assert "is running and printed: octet-robot: node 1 listens" in errors


def test_robot_does_not_outlive_its_simulator(long_run):
    process, robot = long_run

    process.kill()
    process.wait()

    wait_until(lambda: not alive(robot), "the end of the robot")


def waits_of(pid: int) -> int:
    """How often a process has waited for something: a robot does once a tick."""
    return int(re.search(r"\nvoluntary_ctxt_switches:\s*(\d+)", Path(f"/proc/{pid}/status").read_text())[1])


def hold_up(pid: int, seconds: float) -> None:
    """Stops a process for a while; a robot on its own clock stops its wheels after 100 ms."""
    os.kill(pid, signal.SIGSTOP)
    time.sleep(seconds)
    os.kill(pid, signal.SIGCONT)


def test_delays_on_either_side_do_not_change_the_log(tmp_path, run):
    words = ("--environments", "2", "--limit-s", "40", "--bus", "fd", "--quiet")
    undisturbed = run(*words)
    chance = random.Random(1)
    process = start_octet("run", "--out", tmp_path / "delayed", *words)
    robot = robot_of(process)

    while process.poll() is None:
        with contextlib.suppress(ProcessLookupError):  # at its end the run takes its robot with it
            hold_up(chance.choice((process.pid, robot)), chance.uniform(0.0, 0.2))
        time.sleep(chance.uniform(0.0, 0.05))

    _, errors = process.communicate()
    assert (process.returncode, errors) == (0, "")
    assert (tmp_path / "delayed/run.log").read_bytes() == undisturbed.log


def test_real_time_run_goes_on_after_its_robot_was_held_up(tmp_path):
    words = ("--environments", "1", "--bus", "fd", "--limit-s", "4", "--real-time", "--json", *BUSY_HOST)
    process = start_octet("run", "--out", tmp_path, *words)
    robot = robot_of(process)
    wait_until(lambda: waits_of(robot) > 50, "fifty ticks of the robot")

    hold_up(robot, 0.8)

    output, errors = process.communicate()
    assert (process.returncode, errors) == (0, "")
    assert '"ticks": 200' in output
    assert octet("replay", tmp_path / "run.log").returncode in (0, 1)


def test_second_run_does_not_write_to_the_folder_of_the_first(long_run, tmp_path):
    process, _ = long_run

    second = octet("run", "--out", tmp_path, "--bus", "none", "--environments", "1")

    assert second.returncode == 2
    assert f"is in use by another run (process {process.pid})" in second.stderr
    assert second.stderr.count("\n") == 1
    assert process.poll() is None


def test_folder_of_a_killed_run_is_free_again(long_run, tmp_path):
    process, _ = long_run
    process.kill()
    process.wait()

    assert octet("run", "--out", tmp_path, "--bus", "none", "--environments", "1", "--limit-s", "1").returncode == 0


@pytest.mark.faulty
def test_run_reports_that_all_drives_of_the_robot_are_damaged(run):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2", "--fault", "corrupt:1@60-/from")

    assert done.code == 1
    assert re.search(r"; its [A-Z]+ came with a wrong CRC or length: [0-9A-F]{3}#", done.errors)


SHORT = ("--environments", "1", "--limit-s", "8")
BAD = ("--fault", "drop:30%", "--fault", "duplicate:10%", "--fault", "reorder:10%", "--fault", "delay:0-300ms")


@pytest.mark.faulty
def test_run_over_a_bad_bus_counts_repeats_and_has_the_same_drives(run):
    bad, clean = run(*SHORT, "--bus", "none", *BAD), run(*SHORT, "--bus", "none")

    assert (bad.code, bad.errors) == (0, "")
    assert drives_in(bad.log) == drives_in(clean.log)
    assert bad.summary["environments"] == clean.summary["environments"]
    assert bad.summary["robots"][0]["frames"]["repeated"] > 100
    assert "frames repeated" in bad.output
    assert "link" not in clean.output
    assert octet("replay", bad.out / "run.log").returncode == 0


@pytest.mark.faulty
def test_bad_socket_pair_changes_no_drive(run):
    words = ("--environments", "1", "--limit-s", "1")

    bad = run(*words, "--bus", "fd", "--fault", "drop:20%", "--fault", "delay:10%:0-30ms")

    assert (bad.code, bad.errors) == (0, "")
    assert drives_in(bad.log) == drives_in(run(*words, "--bus", "none").log)


@pytest.mark.faulty
def test_recorded_faults_are_reproduced(run):
    first = run(*SHORT, "--bus", "none", *BAD)

    again = run(*SHORT, "--bus", "none", "--fault", f"@{first.out / 'faults.txt'}")

    assert again.log == first.log
    assert (again.out / "faults.txt").read_bytes().count(b"\n") > 100


@pytest.mark.faulty
def test_fault_record_says_that_it_leaves_faults_out(run, monkeypatch):
    monkeypatch.setattr("host_sim.transport.faulty_link.RECORD_MAX", 3)

    first = run("--environments", "1", "--limit-s", "1", "--bus", "none", "--fault", "duplicate:20%")

    *rules, left_out = (first.out / "faults.txt").read_text().splitlines()
    assert len(rules) == 3
    assert left_out.startswith("# and ")
    assert run("--environments", "1", "--bus", "none", "--fault", f"@{first.out / 'faults.txt'}").code == 0


@pytest.mark.faulty
def test_forged_stop_ends_the_run_and_names_its_tick(run):
    done = run(*SHORT, "--bus", "none", "--fault", "forge:stop@100/to")

    assert done.code == 1
    assert "somebody else stopped node 1" in done.errors
    assert "tick 8" in done.errors or "tick 9" in done.errors
    assert done.errors.count("\n") == 1


@pytest.mark.faulty
@pytest.mark.parametrize(
    ("rule", "reason"),
    [
        ("forge:DRIVE@100-102/to", "two robots are node 1"),
        ("forge:HEARTBEAT@100-102/to", "two robots are node 1"),
        ("forge:SENSES@100-110/from", "another simulator commands node 1"),
        ("forge:COMMAND@100-110/from", "another simulator commands node 1"),
    ],
)
def test_second_robot_or_second_simulator_ends_the_run(run, rule, reason):
    done = run(*SHORT, "--bus", "none", "--fault", rule)

    assert done.code == 1
    assert reason in done.errors


@pytest.mark.faulty
@pytest.mark.parametrize(
    "message", ["MEMORY", "HEARTBEAT", "DRIVE", "BOOT", "FAULTS", "HEALTH", "ANSWER", "EMERGENCY"]
)
def test_forged_reports_never_make_a_wrong_result_look_right(run, message):
    forged = run(*SHORT, "--bus", "none", "--fault", f"forge:20%:{message}/from")

    clean = run(*SHORT, "--bus", "none")
    right = forged.memory == clean.memory if (forged.out / "summary.json").exists() else False
    assert right or forged.code == 1
    assert forged.errors.count("\n") == (forged.code == 1)


@pytest.mark.faulty
def test_forged_power_up_is_counted_and_changes_no_drive(run):
    forged, clean = run(*SHORT, "--bus", "none", "--fault", "forge:BOOT@100/from"), run(*SHORT, "--bus", "none")

    assert (forged.code, forged.errors) == (0, "")
    assert drives_in(forged.log) == drives_in(clean.log)
    assert forged.summary["robots"][0]["frames"]["refused"] == 1


@pytest.mark.parametrize(
    ("words", "named"), [(("--fault", "meteor"), "meteor"), (("--fault", "@nowhere"), "nowhere")]
)
def test_invalid_fault_is_refused_in_one_line(run, words, named):
    done = run(*SHORT, "--bus", "none", *words)

    assert done.code == 2
    assert named in done.errors
    assert done.errors.count("\n") == 1
