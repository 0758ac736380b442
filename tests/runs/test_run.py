"""What a run leaves behind, and that it depends on seed and options only."""

import json
from collections import Counter
from itertools import islice

import can
import pytest

from host_sim.client.frame_log import digest_of
from host_sim.sim.run_config import RunConfig
from tests.runs.log_hashes import Recorded, differences, digest_of_log, runs
from tests.runs.support import BUSY_HOST, Run, assert_healthy, octet


def test_run_finishes_its_environments_and_says_so(run):
    done = run("--environments", "2", "--bus", "fd")

    assert (done.code, done.errors) == (0, "")
    assert [environment["finished"] for environment in done.summary["environments"]] == [True, True]
    assert all(environment["food_eaten"] == 3 for environment in done.summary["environments"])
    assert "all food eaten" in done.output
    assert done.output.splitlines()[-1] == "ALL DONE"


def test_run_leaves_log_summary_and_picture(run):
    done = run("--environments", "1", "--limit-s", "10", "--bus", "none", process=True)

    assert (done.out / "arena.png").read_bytes().startswith(b"\x89PNG")
    assert digest_of(done.log) == done.summary["log_sha256"]
    assert not list(done.out.glob("*.part"))


def test_summary_has_exactly_the_expected_fields(run):
    summary = run("--environments", "1", "--bus", "none").summary

    top = {"seed", "profile", "world", "bus", "environments", "robots", "changes", "incidents", "log_sha256"}
    top |= {"wall_s", "real_time_factor"}
    robot = {"node", "memory", "frames", "faults", "saturated", "round_trip_ms", "real_time", "line"}
    deeds = {"node", "food_eaten", "trials", "remembered_turns", "boredom_turns", "collisions", "memory"}
    deeds |= {"stuck_sensors"}
    assert top == summary.keys()
    assert {"finished", "food_eaten", "ticks", "robot_s", "robots"} == summary["environments"][0].keys()
    assert deeds == summary["environments"][0]["robots"][0].keys()
    assert robot == summary["robots"][0].keys()
    frames = {"sent", "received", "repeated", "duplicate", "lost", "refused"}
    assert frames == summary["robots"][0]["frames"].keys()
    assert len(summary["robots"][0]["memory"]) == 8


def test_json_prints_the_summary_and_nothing_else(run):
    done = run("--environments", "1", "--limit-s", "10", "--bus", "fd", "--json", process=True)

    assert json.loads(done.output) == done.summary
    assert done.errors == ""


def test_quiet_prints_nothing(run):
    done = run("--environments", "1", "--limit-s", "10", "--bus", "none", "--quiet", process=True)

    assert (done.code, done.output, done.errors) == (0, "", "")


def test_python_can_reads_the_log(run):
    done = run("--environments", "1", "--bus", "none")

    with can.LogReader(done.out / "run.log") as reader:
        messages = list(reader)

    ticks = done.summary["environments"][0]["ticks"]
    assert sum(message.arbitration_id == 0x101 for message in messages) == ticks
    assert sum(message.arbitration_id == 0x41 for message in messages) == ticks + 2  # and one at each stop


@pytest.mark.parametrize("seed", [0, 7, 2**32 - 1])
def test_run_over_a_socket_pair_leaves_the_same_bytes_as_in_process(run, seed):
    words = ("--environments", "1", "--seed", str(seed))

    behind, within = run(*words, "--bus", "fd"), run(*words, "--bus", "none")

    assert behind.log == within.log


def test_repeated_run_leaves_the_same_bytes(run):
    words = ("--environments", "2", "--limit-s", "40", "--seed", "5", "--bus", "none")

    once, again = run(*words, process=True), run(*words, process=True)

    assert once.log == again.log
    assert (once.out / "arena.png").read_bytes() == (again.out / "arena.png").read_bytes()


def test_replay_names_the_first_drive_that_differs(run, tmp_path):
    done = run("--environments", "1", "--bus", "none")
    lines = done.log.decode().splitlines(keepends=True)
    at = next(i for i, line in enumerate(lines) if i > 500 and " 041#" in line)
    # The same tick said by another robot: a drive of another tick, whole and with a true CRC.
    lines[at] = lines[at - 100 : at][[" 041#" in line for line in lines[at - 100 : at]].index(True)]
    changed = tmp_path / "changed.log"
    changed.write_text("".join(lines))

    replayed = octet("replay", changed)

    assert replayed.returncode == 1
    assert "differs" in replayed.stdout
    assert replayed.stdout.count("DRIVE counter=") >= 1


def test_settings_change_the_run_and_its_replay_knows_them(run):
    plain = run("--environments", "1", "--bus", "none")
    changed = run("--environments", "1", "--bus", "none", "--set", "turn_deg=25", "--set", "boredom_limit=4")

    assert changed.log != plain.log
    assert octet("replay", changed.out / "run.log").returncode == 0


def test_node_option_changes_the_identifiers(run):
    done = run("--environments", "1", "--bus", "fd", "--node", "31")

    identifiers = {line.split()[2][:3] for line in done.log.decode().splitlines()}
    assert {"03F", "05F", "11F"} <= identifiers
    assert octet("replay", "--node", "31", done.out / "run.log").returncode == 0


def test_short_time_limit_ends_an_environment_unfinished(run):
    done = run("--environments", "2", "--bus", "none", "--limit-s", "2")

    assert [environment["ticks"] for environment in done.summary["environments"]] == [100, 100]
    assert [environment["finished"] for environment in done.summary["environments"]] == [False, False]
    assert done.output.splitlines()[-1] == "done      0 of 2 environments finished"


@pytest.mark.faulty
def test_real_time_run_takes_as_long_as_its_ticks(run):
    done = run("--environments", "1", "--bus", "fd", "--limit-s", "3", "--real-time", *BUSY_HOST)

    assert done.summary["environments"][0]["ticks"] == 150
    assert done.summary["wall_s"] > 2.9
    if not done.summary["robots"][0]["frames"]["lost"]:  # a host that was held up loses some, which is said elsewhere
        assert (done.code, octet("replay", done.out / "run.log").returncode) == (0, 0)


def test_run_writes_a_memory_file_and_the_next_run_continues_with_it(run, tmp_path):
    memory = tmp_path / "robot.mem"

    first = run("--environments", "1", "--bus", "fd", "--memory", memory)
    learned = memory.read_bytes()
    second = run("--environments", "1", "--bus", "fd", "--memory", memory, "--seed", "9")

    assert list(learned) == first.memory
    kept = [cell for cell, was in zip(second.memory, learned, strict=True) if was]
    assert kept == [cell for cell in learned if cell]
    assert trials_of(second) < trials_of(first)
    assert octet("replay", second.out / "run.log").returncode == 0


def trials_of(run: Run) -> int:
    return run.summary["environments"][0]["robots"][0]["trials"]


def test_several_robots_leave_one_log_and_an_entry_each(run):
    done = run("--robots", "3", "--environments", "2", "--limit-s", "10", "--bus", "fd")

    assert (done.code, done.errors) == (0, "")
    assert_healthy(done.summary)
    assert [robot["node"] for robot in done.summary["robots"]] == [1, 2, 3]
    assert [len(environment["robots"]) for environment in done.summary["environments"]] == [3, 3]
    identifiers = {line.split()[2][:3] for line in done.log.decode().splitlines()}
    assert {"101", "102", "103", "041", "042", "043"} <= identifiers
    replayed = octet("replay", done.out / "run.log")
    assert (replayed.returncode, replayed.stdout.count("no difference")) == (0, 3)


def test_several_robots_leave_the_same_bytes_over_fd_as_in_process(run):
    words = ("--robots", "2", "--environments", "1", "--limit-s", "20", "--seed", "4")

    assert run(*words, "--bus", "fd").log == run(*words, "--bus", "none").log


def test_first_of_several_robots_begins_as_it_would_alone(run):
    alone = run("--environments", "1", "--limit-s", "1", "--bus", "none")
    together = run("--robots", "2", "--environments", "1", "--limit-s", "1", "--bus", "none")

    def first_senses(log: bytes) -> str:
        return next(line.split()[2] for line in log.decode().splitlines() if " 101#" in line)

    assert first_senses(alone.log) == first_senses(together.log)


def test_several_robots_have_a_memory_file_each(run, tmp_path):
    words = ("--robots", "2", "--environments", "1", "--bus", "none", "--memory", tmp_path / "robot.mem")

    done = run(*words)

    saved = [list((tmp_path / f"robot-{node}.mem").read_bytes()) for node in (1, 2)]
    assert saved == [robot["memory"] for robot in done.summary["robots"]]


def test_runs_to_hash_have_unique_names():
    names = Counter(recorded.name for recorded in runs())

    assert len(names) > 190
    assert set(names.values()) == {1}


def test_log_digest_is_reproducible_and_depends_on_the_options():
    one, other = islice(runs(), 2)

    assert digest_of_log(one) == digest_of_log(one) != digest_of_log(other)


def test_edits_change_the_log_and_the_step_size_does_not():
    config = RunConfig(environments=1, limit_s=12.0)

    plain, edited, by_tick = (digest_of_log(Recorded("", config, *rest)) for rest in ((), (True,), (True, 1)))

    assert plain != edited == by_tick


def test_differences_names_changed_missing_and_new_runs():
    assert differences({"a": "1", "b": "2", "gone": "3"}, {"a": "1", "b": "4", "new": "5"}) == ["b", "gone", "new"]
