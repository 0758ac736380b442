"""`tools/octet debug`: gdb, which nobody here wrote, says where the robot stands and what it has sensed."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from host_sim.protocol.codec import Frame, Protocol
from host_sim.recording.log_reader import frames_of, read_log
from tests.runs.support import octet_process

ROOT = Path(__file__).resolve().parents[3]
REAL_TIME = sorted((ROOT / "tests/recording/data").glob("*.log"))
LAUNCH = re.compile(r"^```json launch\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def debug(log: Path, *words: str) -> str:
    """What gdb and the robot print."""
    done = octet_process("debug", log, *words)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def log_of(out: Path, limit_s: int) -> Path:
    """The log of a run of three environments."""
    octet_process("run", "--bus", "none", "--quiet", "--limit-s", str(limit_s), "--out", out).check_returncode()
    return out / "run.log"


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log for what happens at its beginning: a longer one takes longer to read."""
    return log_of(tmp_path_factory.mktemp("a run"), 25)


@pytest.fixture(scope="module")
def long_log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log with more than 10,000 ticks."""
    return log_of(tmp_path_factory.mktemp("a long run"), 250)


def senses(log: Path) -> list[dict[str, int]]:
    """The SENSES of each tick of a run in lockstep on a bus that loses nothing."""
    protocol = Protocol(1)
    decoded = (protocol.decode(line.frame) for line in frames_of(read_log(log), 1))
    return [it.signals for it in decoded if it and it.name == "SENSES"]


@pytest.mark.parametrize("tick", [0, 371, 1000])
def test_gdb_stops_where_the_senses_of_the_tick_enter_the_step(log, tick):
    shown = debug(log, "--tick", str(tick), "--ex", "output/u sensed->tick", "--ex", "output/u sensed->odometer_left")

    assert re.search(rf"^tick {tick}, {tick * 0.02:.2f} s, 0 of {tick} drives differ", shown, re.MULTILINE)
    sensed = senses(log)[tick]
    assert shown.endswith(f"{sensed['tick']}{sensed['odometer_left']}")


def test_debug_finds_the_tick_of_a_time_or_a_decision(log):
    assert "tick 371, 7.42 s" in debug(log, "--at", "7.439", "--ex", "cells")
    shown = debug(log, "--decision", "12", "--ex", "finish", "--ex", "output/d robot->action")
    assert shown.endswith("12")


def test_continue_goes_to_the_next_tick_and_goto_back(log):
    shown = debug(log, "--tick", "50", "--ex", "continue", "--ex", "goto 7", "--ex", "continue")

    assert re.findall(r"^tick (\d+),", shown, re.MULTILINE) == ["50", "51", "7", "8"]


def test_breakpoints_do_not_stop_gdb_on_the_way_to_the_tick(log):
    shown = debug(log, "--tick", "50", "--ex", "break brain_next", "--ex", "goto 60", "--ex", "info breakpoints")

    assert re.findall(r"^tick (\d+),", shown, re.MULTILINE) == ["50", "60"]
    assert "brain_next" in shown


def test_cells_at_the_last_tick_equal_the_memory_of_the_summary(long_log):
    memory = json.loads((long_log.parent / "summary.json").read_text())["robots"][0]["memory"]
    last = len(senses(long_log)) - 1

    shown = debug(long_log, "--tick", str(last), "--ex", "cells")

    assert shown.endswith("{" + ", ".join(map(str, memory)) + "}\n")


def to_the_end(log: Path, *words: str) -> tuple[int, int]:
    """Number of drives compared, and of those that differ."""
    shown = debug(log, *words, "--ex", "delete", "--ex", "continue")
    found = re.search(r"end of the log: (\d+) drives compared, (\d+) differ", shown)
    return int(found[1]), int(found[2])


def test_unchanged_firmware_drives_as_in_the_log(long_log):
    assert to_the_end(long_log) == (len(senses(long_log)), 0)


@pytest.mark.parametrize("path", REAL_TIME, ids=lambda path: path.stem)
def test_debugger_reproduces_a_log_in_real_time(path):
    compared, differ = to_the_end(path)

    assert compared > 20
    assert differ == 0


@pytest.mark.parametrize("options", [("--robots", "3", "--set", "share=1"), ("--profile", "distance")], ids=str)
def test_debugger_feeds_ranges_and_memories_of_other_robots(options, tmp_path):
    run = ["run", "--bus", "none", "--quiet", "--environments", "2", "--limit-s", "60", "--out", tmp_path]
    octet_process(*run, *options).check_returncode()

    node = "2" if "--robots" in options else "1"
    compared, differ = to_the_end(tmp_path / "run.log", "--node", node)

    assert compared > 1000
    assert differ == 0


def altered(log: Path, other: Path, tick: int) -> None:
    """Writes a log whose DRIVE of a tick has another speed."""
    protocol, lines = Protocol(1), log.read_text().splitlines(keepends=True)
    at = next(i for i, line in enumerate(lines) if f"{tick * 0.02:.6f}) octet 041#" in line)
    start, data = lines[at].strip().rsplit("#")
    signals = protocol.decode(Frame(0x041, bytes.fromhex(data))).signals
    frame = protocol.encode("DRIVE", signals | {"left": signals["left"] + 1})
    lines[at] = f"{start}#{frame.data.hex().upper()}\n"
    other.write_text("".join(lines))


def test_debug_command_of_replay_reports_the_first_drive_that_differs(log, tmp_path):
    other = tmp_path / "altered.log"
    altered(log, other, 89)

    replayed = octet_process("replay", other)
    (command,) = re.findall(r"^  debugger  tools/octet (.*)$", replayed.stdout, re.MULTILINE)

    assert replayed.returncode == 1
    assert command == f"debug {other} --node 1 --at 1.78"
    shown = debug(other, *command.split()[2:], "--ex", "delete", "--ex", "continue")
    assert "tick 89, 1.78 s, 0 of 89 drives differ" in shown
    assert "tick 89: the first DRIVE that differs from the log's" in shown


def test_debugger_reaches_tick_10000(long_log, capsys):
    began = os.times()
    shown = debug(long_log, "--tick", "10000", "--ex", "cells")
    took = [end - start for start, end in zip(began, os.times(), strict=True)]

    with capsys.disabled():
        sys.stdout.write(f"\nto tick 10,000 in gdb: {took[4]:.2f} s, {took[2] + took[3]:.2f} s of processor time\n")
    assert "tick 10000, 200.00 s, 0 of 10000 drives differ" in shown


def test_editor_with_the_page_s_settings_stops_before_the_tick(log, tmp_path):
    (text,) = LAUNCH.findall((ROOT / "docs/debugging.md").read_text())
    octet_process("debug", log, "--out", tmp_path / "out/debug").check_returncode()
    (launch,) = json.loads(text.replace("${workspaceFolder}/build", str(ROOT / "build")))["configurations"]
    commands = [
        f'-environment-cd "{launch["cwd"].replace("${workspaceFolder}", str(tmp_path))}"',
        *(it["text"] for it in launch["setupCommands"]),
        f"-exec-arguments {' '.join(launch['args'])}",
        "-exec-run",
    ]

    command = ["gdb", "--interpreter=mi", "-nx", launch["program"]]  # as the extension starts it
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as gdb:
        gdb.stdin.write("\n".join([*commands, ""]))
        gdb.stdin.flush()
        stopped = next(line for line in gdb.stdout if line.startswith("*stopped"))
        gdb.stdin.write('-data-evaluate-expression "tick"\n-gdb-exit\n')
        gdb.stdin.flush()
        values = [line for line in gdb.stdout if "value=" in line]

    assert 'func="stop_here"' in stopped
    assert values == ['^done,value="371"\n']


def test_run_waits_at_a_breakpoint_and_writes_the_same_log(tmp_path):
    options = ["--environments", "1", "--limit-s", "10", "--quiet"]
    seven_s = "continue\nshell sleep 7\nprint/d sensed->tick\ndelete\ncontinue\n"
    octet_process("run", *options, "--bus", "fd", "--out", tmp_path / "without").check_returncode()

    done = octet_process("run", *options, "--gdb", "--out", tmp_path / "with", input=seven_s)

    assert done.returncode == 0, done.stdout + done.stderr
    assert "$1 = 1" in done.stdout
    logs = [json.loads((tmp_path / it / "summary.json").read_text())["log_sha256"] for it in ("with", "without")]
    assert logs[0] == logs[1]


def test_leaving_the_debugger_ends_the_run(tmp_path):
    done = octet_process("run", "--gdb", "--environments", "1", "--out", tmp_path, input="continue\nquit\n")

    assert done.returncode == 1
    assert done.stderr.endswith("octet: the debugger was left before the run had ended\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("debug {log} --tick 99999999", "has no tick 99999999: the last one is "),
        ("debug {log} --decision 99999999", "decisions of node 1, not 99999999"),
        ("debug {log} --node 2", "has no heartbeat of node 2"),
        ("debug {log} --out {log}/x", "cannot write to "),
        ("debug {program} --tick 3", "is a program, not C"),
        ("run --gdb --real-time", "leave --real-time out"),
        ("run --gdb --robots 2", "leave --robots out"),
        ("run --gdb --profile x.bas", "leave --gdb out"),
        ("run --gdb --watch", "leave --watch out"),
        ("run --gdb --bus socketcan:vcan0 --robot external", "leave --bus and --robot out"),
    ],
)
def test_debug_refuses_unsuitable_logs_and_options_in_one_line(log, tmp_path, words, said):
    program = tmp_path / "program/run.log"
    if "{program}" in words:
        bas = ROOT / "host_sim/program/examples/article.bas"
        run = ["run", "--profile", bas, "--bus", "none", "--environments", "1", "--limit-s", "2", "--quiet"]
        octet_process(*run, "--out", program.parent).check_returncode()

    done = octet_process(*(word.format(log=log, program=program) for word in words.split()))

    assert done.returncode == 2
    assert said in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize("words", ["debug {log}", "run --gdb --environments 1"])
def test_missing_gdb_is_reported_with_its_install_command(log, tmp_path, words):
    empty = {**os.environ, "PATH": str(tmp_path)}
    words = [word.format(log=log) for word in words.split()] + (["--out", str(tmp_path)] if "run" in words else [])
    done = octet_process(*words, env=empty)

    assert done.returncode == 1
    assert done.stderr == "octet: gdb is not installed: run tools/setup debug\n"
