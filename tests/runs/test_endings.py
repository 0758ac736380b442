"""However a run ends, its folder holds that run, whole; and nothing is overwritten or lost without a word."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from host_sim.base.errors import RobotError
from host_sim.live.paced_run import PAUSE_S
from host_sim.sim.robot_process import RobotProcess
from tests.runs.support import (
    BUSY_HOST,
    DEADLINE_S,
    data_in,
    octet,
    octet_process,
    robot_of,
    start_octet,
    wait_for_lines,
    wait_until,
)

FILES = ("run.log", "run.world.json", "summary.json", "arena.png", "replay.html")
SHORT = ("--environments", "1", "--limit-s", "5", "--bus", "none")
LONG = ("--environments", "30", "--bus", "fd", "--seed", "8")


def title(out: Path) -> str:
    """The title of the page."""
    return data_in((out / "replay.html").read_text(), "run")["title"]


def assert_whole(out: Path, seed: int) -> None:
    """All files are there, and of one run."""
    assert sorted(path.name for path in out.iterdir()) == sorted(FILES)
    summary = json.loads((out / "summary.json").read_text())
    assert summary["seed"] == seed
    assert title(out) == f"seed {seed}"
    assert json.loads((out / "run.world.json").read_text())["seed"] == seed
    replayed = octet("replay", out / "run.log")
    assert replayed.returncode == 0, replayed.stdout + replayed.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_interrupted_run_leaves_one_whole_run(tmp_path, number):
    assert octet("run", *SHORT, "--quiet", "--out", tmp_path).returncode == 0
    process = start_octet("run", *LONG, "--quiet", "--out", tmp_path)
    wait_for_lines(process, tmp_path / "run.log", 4000)

    process.send_signal(number)
    _, errors = process.communicate(timeout=DEADLINE_S)

    assert process.returncode == 128 + number
    how = "interrupted" if number == signal.SIGINT else f"ended by {number.name}"
    assert errors == f"octet: {how}; the log so far was written\n"
    assert_whole(tmp_path, 8)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_interrupted_watched_run_leaves_one_whole_run(tmp_path, number):
    assert octet("run", *SHORT, "--quiet", "--out", tmp_path).returncode == 0
    process = start_octet("run", "--watch", "--port", "0", *BUSY_HOST, *LONG, "--out", tmp_path)
    wait_for_lines(process, tmp_path / "run.log", 4000)

    process.send_signal(number)
    _, errors = process.communicate(timeout=DEADLINE_S)

    assert (process.returncode, errors) == (0, "")
    assert_whole(tmp_path, 8)


def test_run_whose_robot_is_killed_names_it_and_leaves_one_whole_run(tmp_path):
    assert octet("run", *SHORT, "--quiet", "--out", tmp_path).returncode == 0
    process = start_octet("run", *LONG, "--quiet", "--out", tmp_path)
    robot = robot_of(process)
    wait_for_lines(process, tmp_path / "run.log", 4000)

    os.kill(robot, signal.SIGKILL)
    _, errors = process.communicate(timeout=DEADLINE_S)

    assert process.returncode == 1
    assert errors.startswith("octet: the robot was killed by signal 9 (SIGKILL) and printed: ")
    assert errors.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(FILES)
    assert json.loads((tmp_path / "summary.json").read_text())["seed"] == 8


def test_waiting_for_frames_of_an_ended_run_fails_with_what_it_printed(tmp_path):
    process = start_octet("run", "--seed", "many", "--out", tmp_path)

    with pytest.raises(AssertionError, match="--seed"):
        wait_for_lines(process, tmp_path / "run.log", 1)


HUNG_S = 8.0
"""From the signal to the end of a run whose robot hangs, s, but for the time that it waits for a processor.

It waits for the robot for 1.5 s, and then writes its files. The robot's usual time would make it 14 s.
"""


def queued_s(process: subprocess.Popen) -> float:
    """For how long a process, or one that has ended, has waited for a processor."""
    return int(Path(f"/proc/{process.pid}/schedstat").read_text().split()[1]) / 1e9


@pytest.mark.parametrize("options", [(), ("--robots", "3"), ("--watch", "--port", "0")])
def test_run_whose_robot_hangs_ends_soon(tmp_path, options):
    process = start_octet("run", "--environments", "1000", "--bus", "fd", *options, "--out", tmp_path)
    robot = robot_of(process)
    wait_for_lines(process, tmp_path / "run.log", 4000)
    os.kill(robot, signal.SIGSTOP)

    began = time.monotonic() - queued_s(process)
    process.send_signal(signal.SIGTERM)
    wait_until(lambda: os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG), "the end")
    took_s = time.monotonic() - queued_s(process) - began
    _, errors = process.communicate()

    assert took_s < HUNG_S
    assert process.returncode in (1, 128 + signal.SIGTERM)
    assert errors.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(FILES)


INTERRUPTED_AT = """
import os, runpy, signal, sys
moment = sys.argv.pop(1)
class Finder:
    def find_spec(name, *_):
        if name == moment: os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Finder)
runpy.run_module("host_sim", run_name="__main__")
"""


@pytest.mark.parametrize("moment", ["host_sim.cli.main", "host_sim.base.errors", "host_sim.cli.run_options"])
def test_ctrl_c_while_the_program_loads_prints_no_traceback(moment):
    command = [sys.executable, "-c", INTERRUPTED_AT, moment, "run", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)

    assert done.returncode in (-signal.SIGINT, 130), done
    assert "Traceback" not in done.stderr
    if moment == "host_sim.cli.main":
        assert (done.returncode, done.stderr) == (130, "octet: interrupted\n")


def test_run_says_which_run_it_replaces(tmp_path):
    assert octet("run", *SHORT, "--seed", "3", "--quiet", "--out", tmp_path).returncode == 0

    done = octet("run", *SHORT, "--out", tmp_path)

    assert f"replaced  the run in {tmp_path} (seed 3), which is in {tmp_path.name}.1 now\n" in done.stdout


def test_previous_run_is_kept_beside_the_new_one(tmp_path):
    out, kept = tmp_path / "out", tmp_path / "out.1"
    for seed in ("3", "4", "5"):
        assert octet("run", *SHORT, "--seed", seed, "--quiet", "--out", out).returncode == 0

    assert_whole(out, 5)
    assert_whole(kept, 4)


def test_previous_run_is_kept_whole_whatever_the_next_run_is(tmp_path):
    out, kept = tmp_path / "out", tmp_path / "out.1"
    for words in (("--fault", "forge/from"), ("--robots", "40"), ()):
        before = {path.name: path.read_bytes() for path in out.glob("*")}
        octet("run", *SHORT, *words, "--out", out)
        assert {path.name: path.read_bytes() for path in kept.glob("*")} == before

    assert_whole(out, 1)


@pytest.mark.parametrize(
    "words",
    [
        ("run", "--bus", "foo:1", "--robot", "external"),
        ("watch", "--bus", "none", "--terminal", "--fault", "drop:10%"),
    ],
)
def test_run_that_ends_before_its_first_tick_leaves_the_previous_one(tmp_path, words):
    out = tmp_path / "out"
    assert octet("run", *SHORT, "--seed", "3", "--fault", "drop:10%", "--quiet", "--out", out).returncode == 0
    before = {path.name: path.read_bytes() for path in out.iterdir()}

    done = octet_process(*words, "--out", out, stdin=subprocess.DEVNULL)

    assert done.returncode != 0
    assert "replaced" not in done.stdout
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


@pytest.mark.parametrize("previous", [True, False])
def test_watched_run_that_no_page_began_leaves_the_previous_one_and_names_no_page(tmp_path, previous):
    if previous:
        assert octet("run", *SHORT, "--seed", "3", "--quiet", "--out", tmp_path).returncode == 0
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    process = start_octet("watch", "--port", "0", "--bus", "none", "--out", tmp_path)
    wait_until(lambda: "watch" in process.stdout.readline(), "the address")
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=DEADLINE_S)

    after = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert (process.returncode, "replay.html" in said) == (0, False)
    assert after == (before or after)


@pytest.mark.parametrize("summary", [b"", b"{", b"[]", b"\xff\xfe", b"{}"])
def test_invalid_summary_of_the_previous_run_does_no_harm(tmp_path, summary):
    (tmp_path / "run.log").write_text("old")
    (tmp_path / "summary.json").write_bytes(summary)

    done = octet("run", *SHORT, "--out", tmp_path)

    assert (done.returncode, done.stderr) == (0, "")
    assert f"replaced  the run in {tmp_path}, which is in {tmp_path.name}.1 now\n" in done.stdout


def test_missing_memory_file_is_named(tmp_path):
    memory = tmp_path / "typo.mem"

    done = octet("run", *SHORT, "--out", tmp_path, "--memory", memory)

    assert f"memory    {memory} does not exist yet: the robot begins with an empty memory\n" in done.stdout
    assert memory.exists()
    assert "does not exist yet" not in octet("run", *SHORT, "--out", tmp_path, "--memory", memory).stdout


@pytest.mark.parametrize("where", ["nowhere/robot.mem", "file/robot.mem"])
def test_unwritable_memory_file_is_named_before_the_run(tmp_path, where):
    (tmp_path / "file").write_text("no folder")
    done = octet("run", *SHORT, "--out", tmp_path / "out", "--memory", tmp_path / where)

    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert where in done.stderr
    assert not (tmp_path / "out").exists()


def crashing_robot(folder: Path, then: str) -> RobotProcess:
    """A robot that is ready, and then does something."""
    program = folder / "robot"
    program.write_text(f"#!/bin/sh\necho octet-robot: node 1 listens\n{then}\n")
    program.chmod(0o755)
    return RobotProcess("fd:0", 1, program=[program])


@pytest.mark.parametrize(
    ("then", "said"),
    [
        (
            "sleep 0.2; echo heap-buffer-overflow >&2; exit 3",
            "ended with exit code 3 and printed: .*heap-buffer-over",
        ),
        (
            "sleep 0.2; yes stack | head -1000; echo the end; exit 1",
            "printed: octet-robot.*stack.* \\.\\.\\. .*the end",
        ),
        ("sleep 0.2; kill -SEGV $$", r"was killed by signal 11 \(SIGSEGV\)"),
        ("sleep 0.2; kill -40 $$", "was killed by signal 40 and"),
    ],
)
def test_last_output_of_a_crashed_robot_is_quoted(tmp_path, then, said):
    robot = crashing_robot(tmp_path, then)

    with pytest.raises(RobotError, match=said) as error:
        robot.account_for_silence()

    assert "\n" not in str(error.value)
    robot.close()


def test_real_time_run_pauses_between_environments_but_not_in_its_log(tmp_path):
    words = ("run", "--bus", "fd", "--environments", "2", "--limit-s", "1")
    paused, at_once = tmp_path / "paused", tmp_path / "at once"

    assert octet(*words, "--real-time", *BUSY_HOST, "--out", paused).returncode == 0
    assert octet(*words, "--out", at_once).returncode == 0

    summaries = [json.loads((out / "summary.json").read_text()) for out in (paused, at_once)]
    assert [[it["ticks"] for it in summary["environments"]] for summary in summaries] == [[50, 50]] * 2
    assert summaries[0]["wall_s"] > 2 + PAUSE_S - 0.05  # what is left of the last ticks is not waited for
    assert octet("replay", paused / "run.log").returncode == 0


def test_interrupted_command_without_a_log_mentions_none(monkeypatch):
    def interrupted(_: object) -> int:
        raise KeyboardInterrupt

    monkeypatch.setattr("host_sim.cli.dbc_command._dbc", interrupted)

    assert (ended := octet("dbc", "--node", "1")).returncode == 128 + signal.SIGINT
    assert ended.stderr == "octet: interrupted\n"
