"""A run that is not right says so, keeps what it refused, and replaces no good memory."""

import signal
import time

import pytest

from tests.runs.support import DEADLINE_S, OPCODES, PACES, SAID, forge_on_vcan, start_octet, wait_until

GOOD = bytes((0, 1, 0, 0, 2, 0, 2, 0))
LONG = ("--environments", "1", "--limit-s", "20", "--bus", "none")
FORGED = ("--fault", "forge:write@500/to")


@pytest.mark.faulty
def test_doubtful_run_leaves_the_good_memory_unchanged(run, tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(GOOD)

    done = run(*LONG, *FORGED, "--memory", memory)

    assert done.code == 1
    assert memory.read_bytes() == GOOD
    assert (tmp_path / "robot.mem.doubtful").read_bytes() == bytes(done.memory) != GOOD
    assert f"its memory is in {memory}.doubtful" in done.errors


@pytest.mark.faulty
def test_lesson_saved_before_the_doubt_is_taken_out_of_the_good_memory(run, tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(bytes(8))
    learned = run(*LONG, "--memory", memory, "--seed", "6").memory
    memory.write_bytes(bytes(8))

    done = run(*LONG, "--memory", memory, "--seed", "6", "--fault", "forge:freeze@990/to")

    assert done.code == 1
    assert memory.read_bytes() == bytes(8) != bytes(learned)


@pytest.mark.faulty
def test_memories_that_come_seconds_late_are_asked_for_again(run):
    words = "--seed 12 --environments 3 --limit-s 30 --bus none --fault delay:3%:2000-4000ms/from"

    done = run(*words.split())

    assert (done.code, done.errors) == (0, "")
    assert done.summary["environments"][-1]["robots"][0]["memory"] == done.memory


@pytest.mark.faulty
def test_run_ended_by_somebody_else_is_doubtful(run, tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(GOOD)

    done = run(*LONG, "--fault", "forge:stop@500/to", "--memory", memory)

    assert "somebody else stopped node 1" in done.errors
    assert memory.read_bytes() == GOOD
    assert "somebody else stopped node 1" in str(done.summary["incidents"])


PASS_FOR_WHOLE = {
    "senses": ("corrupt:2%:5", "6"),
    "a drive": ("corrupt:5%:6", "17"),
    "another drive": ("corrupt:5%:6", "65"),
}


@pytest.mark.faulty
@pytest.mark.parametrize("what", PASS_FOR_WHOLE)
def test_damaged_frames_that_pass_the_crc_are_noticed(what, run, tmp_path):
    memory = tmp_path / "robot.mem"
    fault, seed = PASS_FOR_WHOLE[what]
    words = f"--bus none --environments 1 --limit-s 60 --seed 6 --fault {fault} --fault-seed {seed}"

    done = run(*words.split(), "--memory", memory)

    assert done.code == 1
    assert "does not hold what it was told here" in done.errors
    assert not memory.exists()


@pytest.mark.faulty
def test_doubtful_run_creates_no_memory_file(run, tmp_path):
    memory = tmp_path / "robot.mem"

    done = run(*LONG, *FORGED, "--memory", memory)

    assert not memory.exists()
    assert (tmp_path / "robot.mem.doubtful").read_bytes() == bytes(done.memory)


def test_good_run_sets_no_memory_aside(run, tmp_path):
    memory = tmp_path / "robot.mem"

    done = run(*LONG, "--memory", memory)

    assert memory.read_bytes() == bytes(done.memory)
    assert list(tmp_path.glob("robot.mem*")) == [memory]
    assert done.errors == ""


IN_BETWEEN = {
    "in this process": ("--bus", "none", "--limit-s", "8", "--fault", "forge:{}@300/to"),
    "socket pair, lockstep": ("--bus", "fd", "--limit-s", "8", "--fault", "forge:{}@300/to"),
    "socket pair, real time": ("--bus", "fd", "--limit-s", "3", "--real-time", "--fault", "forge:{}@100/to"),
}


@pytest.mark.faulty
@pytest.mark.parametrize("opcode", OPCODES)
@pytest.mark.parametrize("way", IN_BETWEEN)
def test_command_forged_on_the_link_makes_the_run_doubtful(run, opcode, way):
    done = run("--environments", "1", *(word.format(opcode) for word in IN_BETWEEN[way]))

    assert done.code == 1
    assert SAID.get(opcode, "somebody else commands the robot") in done.errors


@pytest.mark.vcan
@pytest.mark.faulty
@pytest.mark.parametrize("pace", PACES)
def test_command_forged_on_vcan_makes_the_run_doubtful(tmp_path, pace):
    forge_on_vcan(tmp_path, pace, "set")


SHORT = ("--environments", "1", "--limit-s", "4", "--bus", "none")


@pytest.mark.faulty
def test_forged_command_is_recorded_with_its_time(run):
    done = run(*SHORT, "--fault", "forge:freeze@100/from")

    line, *more = (done.out / "refused.log").read_text().splitlines()
    stamp, channel, frame, reason = line.split(maxsplit=3)
    assert (channel, frame[:4], reason, more) == ("octet", "021#", "; of another simulator", [])
    assert 1.0 < float(stamp.strip("()")) < 4.0


@pytest.mark.faulty
def test_refused_frames_beyond_the_maximum_are_only_counted(run, monkeypatch):
    monkeypatch.setattr("host_sim.client.robot_client.REFUSED_MAX", 5)

    done = run(*SHORT, "--fault", "corrupt:10%/from")

    *kept, left_out = (done.out / "refused.log").read_text().splitlines()
    assert len(kept) == 5
    assert all(line.endswith("; damaged or foreign") for line in kept)
    assert left_out == f"# and {done.summary['robots'][0]['frames']['refused'] - 5} more, not recorded"


@pytest.mark.faulty
def test_run_that_refused_nothing_removes_an_earlier_refused_log(run):
    bad = run(*SHORT, "--fault", "corrupt:10%/from")
    assert (bad.out / "refused.log").exists()

    run(*SHORT, "--out", bad.out)

    assert not (bad.out / "refused.log").exists()


REAL_TIME = ("--environments", "1", "--limit-s", "4", "--bus", "fd", "--real-time")
DEAF = {
    "senses are lost": ("drop:90%@20-/to",),
    "answers are late": ("delay:0-250ms@20-",),
    "bits flip": ("corrupt:50%:3@20-/from",),
}


@pytest.mark.faulty
@pytest.mark.parametrize("name", DEAF)
def test_run_is_doubtful_when_too_many_ticks_have_no_answer(run, name):
    done = run(*REAL_TIME, *(word for rule in DEAF[name] for word in ("--fault", rule)))

    real_time = done.summary["robots"][0]["real_time"]
    assert real_time["unanswered_percent"] > 10.0
    assert done.code == 1
    assert "of the 200 ticks had no answer; the limit is 10 %" in " ".join(done.summary["incidents"])


@pytest.mark.faulty
def test_real_time_limits_are_options(run):
    done = run(*REAL_TIME, "--fault", "drop:30%@20-/to", "--unanswered-max", "100", "--late-max", "100")

    assert (done.code, done.errors) == (0, "")
    assert done.summary["robots"][0]["real_time"]["unanswered_percent"] > 10.0


@pytest.mark.faulty
def test_gap_beyond_its_limit_makes_the_run_doubtful(run):
    loose = ("--unanswered-max", "100", "--late-max", "100", "--gap-max-s", "0.4")

    done = run(*REAL_TIME, "--fault", "drop@80-105/to", *loose)

    assert done.code == 1
    assert "the robot did not answer for 0.4 s" in done.errors
    assert done.summary["robots"][0]["real_time"]["longest_gap_ms"] >= 400


@pytest.mark.parametrize(("limit", "code"), [("5", 1), ("100", 0)])
def test_host_that_stands_still_makes_the_run_doubtful_beyond_the_limit(limit, code, tmp_path):
    words = (*REAL_TIME, "--gap-max-s", "60", "--unanswered-max", "100", "--late-max", limit, "--out", tmp_path)
    running = start_octet("run", *words)
    wait_until((tmp_path / "run.log.part").exists, "the log of the run")
    time.sleep(1.5)  # in the middle of its 4 s
    running.send_signal(signal.SIGSTOP)
    time.sleep(1.0)
    running.send_signal(signal.SIGCONT)

    _, errors = running.communicate(timeout=DEADLINE_S)

    assert (running.returncode, "this host was too slow for real time" in errors) == (code, code == 1)


def test_lockstep_run_has_no_real_time_figures(run):
    done = run("--environments", "1", "--limit-s", "2", "--bus", "none")

    assert done.summary["robots"][0]["real_time"] is None
