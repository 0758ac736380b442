"""Faults of this host: of its disk, its folders, its files and its clock.

Events of a robot on SocketCAN, and each command that somebody else may forge there.
"""

import subprocess
import sys
import time
from contextlib import ExitStack

import pytest

from host_sim.base.errors import OctetError
from host_sim.lab.campaign.host_events import clock_events
from host_sim.lab.campaign.run_files import RunFiles
from host_sim.protocol.codec import Frame
from host_sim.recording.memory_file import MemorySaver
from host_sim.transport.cable import Cable
from tests.lab.campaign.support import outcome_of
from tests.runs.support import OPCODES, forge_on_vcan, octet

LEARNS = "article none lockstep seed=12 limit=12"
NOTHING, SOME = (0,) * 8, (0, 1, 0, 0, 0, 0, 0, 0)

ENDS = [
    ("disk-full@100", "cannot write robot.mem: File too large"),
    ("disk-full:10000@100", "cannot write run.log.part: File too large"),
    ("read-only@100", "cannot write robot.mem: Permission denied"),
    ("folder-gone@100", "cannot write robot.mem: No such file or directory"),
    ("log-gone@100", "cannot write run.log: No such file or directory"),
]


@pytest.mark.parametrize(("event", "told"), ENDS, ids=[event for event, _ in ENDS])
def test_write_error_ends_the_run_and_keeps_what_was_saved(event, told):
    outcome = outcome_of(f"{LEARNS} event={event}")

    assert outcome.problems == []
    assert (outcome.end, outcome.seen, outcome.broke) == (told, told, False)


def test_vanished_memory_file_is_written_again():
    outcome = outcome_of("article fd lockstep seed=12 limit=1 event=memory-gone@20")

    assert (outcome.problems, outcome.end) == ([], "")
    assert "robot.mem has vanished during the run, and is written again" in outcome.seen


def test_memory_missing_from_its_file_at_the_end_fails_the_campaign(monkeypatch):
    monkeypatch.setattr(MemorySaver, "finish", MemorySaver.save)

    outcome = outcome_of("article none lockstep seed=12 limit=1 event=memory-gone@20")

    assert outcome.problems == ["unseen", "lost without a warning"]


@pytest.fixture
def files(tmp_path):
    with ExitStack() as undo:
        written = RunFiles(tmp_path, undo)
        written.save(SOME)
        written.log.add(Frame(0x41, b""))
        yield written
        written.close()


def test_complete_files_count_as_no_loss(files):
    files.finish(SOME)

    assert files.lost() == ""


@pytest.mark.parametrize(("name", "what"), [("run.log", "the log"), ("robot.mem", "the memory")])
def test_file_with_other_content_counts_as_a_loss(files, tmp_path, name, what):
    files.finish(SOME)
    (tmp_path / name).write_bytes(bytes(NOTHING))

    assert files.lost() == what


def test_half_written_memory_file_counts_as_a_loss(files, tmp_path):
    (tmp_path / "robot.mem").write_bytes(bytes(SOME[:4]))

    assert files.lost() == "the memory"


def test_file_faults_are_undone_at_the_end(tmp_path):
    with ExitStack() as undo:
        files = RunFiles(tmp_path, undo)
        for event in ("read-only", "disk-full"):
            files.events[event](0)
        with pytest.raises(OctetError):
            files.save(SOME)
        files.close()

    (tmp_path / "file").write_text("it can be written again")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "run.log.part"]


@pytest.mark.parametrize("event", ["kill-simulator:7000@100", "kill-saving:200@200"])
def test_new_simulator_continues_with_the_memory_of_a_killed_one(event):
    outcome = outcome_of(f"{LEARNS} event={event}")

    assert (outcome.problems, outcome.end, outcome.recovered) == ([], "", True)
    assert outcome.seen == "the simulator was killed, and another one went on with its memory"


def test_new_simulator_takes_over_the_robot_of_a_killed_one():
    outcome = outcome_of("article slcan lockstep seed=12 limit=1 event=kill-simulator:7000@20")

    assert (outcome.problems, outcome.end, outcome.recovered) == ([], "", True)


@pytest.mark.parametrize(
    ("event", "kill"),
    [
        *((f"{event}@15", 7000) for event in ("unplug:100", "reset", "kill", "hang:100", "noise:1", "hold-up:100")),
        ("unplug:700@20", 50),  # the next simulator begins when the line is plugged in again
    ],
)
def test_line_event_before_a_kill_of_the_simulator_takes_effect(event, kill):
    outcome = outcome_of(f"article slcan lockstep seed=12 limit=1 event={event} event=kill-simulator:{kill}@20")

    assert (outcome.problems, outcome.broke) == ([], False)


def test_process_that_owns_the_line_unplugs_it(monkeypatch):
    told = []
    monkeypatch.setattr(Cable, "plug", lambda _: told.append("plug"))
    monkeypatch.setattr(Cable, "unplug", lambda _: told.append("unplug"))

    outcome_of("article slcan lockstep seed=12 limit=1 event=unplug:1@15 event=kill-simulator:7000@20")

    assert told[:1] == ["unplug"]


def test_hanging_simulator_is_ended_and_fails_the_campaign(monkeypatch):
    monkeypatch.setattr("host_sim.lab.campaign.host_events.SILENT_S", 0.5)
    monkeypatch.setattr(MemorySaver, "save", lambda *_: time.sleep(60))

    outcome = outcome_of("article none lockstep seed=12 limit=1 event=kill-simulator:5@20")

    assert outcome.problems == ["broke"]
    assert "the simulator hung" in outcome.end


def test_held_up_process_continues_on_a_busy_host():
    busy = """
import subprocess, time
from host_sim.lab.campaign.host_events import hold_up
begin = subprocess.Popen.__init__
def begin_late(*words, **named):
    begin(*words, **named)
    time.sleep(0.3)
subprocess.Popen.__init__ = begin_late
hold_up(10)
"""
    assert subprocess.run([sys.executable, "-c", busy], timeout=20, check=False).returncode == 0


def test_unsaved_memory_of_a_killed_simulator_fails_the_campaign(monkeypatch):
    monkeypatch.setattr(MemorySaver, "save", lambda *_: None)

    assert "lost without a warning" in outcome_of(f"{LEARNS} event=kill-simulator:5@400").problems


def test_simulator_that_ends_before_its_kill_fails_the_campaign(monkeypatch):
    line = "article none lockstep seed=12 limit=1 event=kill-simulator:5@400"

    assert "did not happen" in outcome_of(line).problems

    monkeypatch.setattr(MemorySaver, "save", lambda *_: 1 // 0)
    outcome = outcome_of(line)
    assert "broke" in outcome.problems
    assert outcome.end == "ZeroDivisionError: integer division or modulo by zero"


def test_clock_event_shifts_all_but_the_next_reading_and_is_undone():
    began_s = time.time()
    with ExitStack() as undo:
        clock_events(undo)["clock-back"](3600)
        readings = [time.time() for _ in range(3)]

    assert [began_s - reading > 1800 for reading in readings] == [False, True, True]
    assert time.time() > began_s - 1800


def test_repeat_of_a_harmless_event_succeeds_unseen():
    done = octet("campaign", "--repeat", "article none lockstep seed=12 limit=2 event=clock-back:3600@100")

    assert (done.returncode, done.stderr) == (0, "")
    assert "seen: nothing" in done.stdout


def test_run_reports_a_vanished_memory_file_and_writes_it_again(tmp_path, monkeypatch):
    memory = tmp_path / "robot.mem"
    monkeypatch.setattr("host_sim.cli.outputs.Outputs._write_page", lambda *_: memory.unlink())

    words = ("--environments", "1", "--limit-s", "5", "--bus", "none", "--quiet", "--out", tmp_path / "out")
    done = octet("run", *words, "--memory", memory)

    assert done.returncode == 0
    assert done.stderr == f"octet: {memory} has vanished during the run, and is written again\n"
    assert len(memory.read_bytes()) == len(NOTHING)


EVENTS = [
    ("bus-down:300@20", "1 outages"),
    ("kill@20", "did not answer tick"),
    ("reset@20", "the robot restarted"),
    ("hang:300@20", "repeated"),
]


@pytest.mark.vcan
@pytest.mark.parametrize(("event", "told"), EVENTS, ids=[event for event, _ in EVENTS])
def test_event_at_a_robot_on_vcan_is_reported_and_safe(event, told):
    outcome = outcome_of(f"article vcan lockstep seed=12 limit=1 event={event}")

    assert outcome.problems == []
    assert any(told in text for text in (outcome.end, outcome.seen, *outcome.doubts)), outcome


@pytest.mark.vcan
@pytest.mark.parametrize("opcode", OPCODES)
def test_forged_command_on_vcan_is_reported(tmp_path, opcode):
    forge_on_vcan(tmp_path, "lockstep", opcode)  # tests/runs/test_doubtful_runs.py forges one in real time
