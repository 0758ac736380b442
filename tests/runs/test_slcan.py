"""A robot behind a serial line: slcan text through two ptys, clean and noisy, plugged and unplugged."""

import json
import re
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing

import pytest

from host_sim.transport.cable import Cable, Socket
from tests.runs.slcan_adapter import Adapter
from tests.runs.support import BUSY_HOST, DEADLINE_S, octet, robot_at, start_octet, wait_until

LEARNED = bytes([0, 1, 1, 1, 2, 1, 2, 1])
SOME_TICKS = 6000
"""Bytes on the line by which a run is under way: some hundred ticks."""


@pytest.fixture
def cable() -> Iterator[Cable]:
    plugged = Cable()
    yield plugged
    plugged.close()


def robots_end(cable: Cable) -> str:
    return f"slcan:{cable.ends[0]}"


def external(cable: Cable) -> tuple[str, ...]:
    return ("--bus", f"slcan:{cable.ends[1]}", "--robot", "external", "--owner", "1")


def drives_in(log: bytes) -> list[bytes]:
    """The drives in a log that answer senses."""
    return [line for line in re.findall(rb" (041#\w+)", log) if line[8:9] != b"0"]


def test_run_over_slcan_leaves_the_same_bytes_as_in_process(run, robot_on, cable):
    words = ("--environments", "1", "--limit-s", "20")
    robot_on(robots_end(cable))

    over_slcan = run(*words, *external(cable))
    within = run(*words, "--bus", "none")

    assert (over_slcan.code, over_slcan.errors) == (0, "")
    assert over_slcan.log == within.log
    assert octet("replay", over_slcan.out / "run.log").returncode == 0


def test_external_robot_can_be_run_again_and_keeps_its_memory(run, robot_on, cable):
    words = ("--environments", "1", "--limit-s", "40", *external(cable))
    robot_on(robots_end(cable))

    first, second = run(*words), run(*words)

    assert any(first.memory)
    assert (second.code, second.errors) == (0, "")
    kept = zip(first.memory, second.memory, strict=True)
    assert all(now == before for before, now in kept if before)
    assert octet("replay", second.out / "run.log").returncode == 0


@pytest.mark.faulty
def test_noise_on_the_serial_line_repeats_frames_and_changes_no_drive(run, robot_on, cable):
    words = ("--environments", "1", "--limit-s", "5")
    robot_on(robots_end(cable))
    cable.noise = 0.01

    noisy = run(*words, *external(cable))

    clean = run(*words, "--bus", "none")
    assert (noisy.code, noisy.errors) == (0, "")
    assert drives_in(noisy.log) == drives_in(clean.log)
    assert noisy.memory == clean.memory
    frames = noisy.summary["robots"][0]["frames"]
    assert frames["repeated"] > 0
    assert frames["refused"] > 0


@pytest.mark.faulty
def test_run_waits_for_an_adapter_that_is_unplugged_and_plugged_in_again(robot_on, tmp_path):
    socket = Socket(tmp_path / "tty")
    first = Cable()
    robot = robot_on(robots_end(first))
    socket.plug(first.ends[1])
    words = ("--environments", "1", "--limit-s", "30", "--bus", f"slcan:{socket.path}", "--robot", "external")
    (tmp_path / "robot.mem").write_bytes(LEARNED)
    process = start_octet("run", "--out", tmp_path / "out", "--memory", tmp_path / "robot.mem", *words)
    wait_until(lambda: first.passed > SOME_TICKS, "ticks")

    robot.kill()
    socket.unplug()
    first.close()
    second = Cable()
    robot_on(robots_end(second))
    socket.plug(second.ends[1])

    output, errors = process.communicate(timeout=DEADLINE_S)
    second.close()
    assert process.returncode == 1
    assert re.fullmatch(
        r"octet: the run is doubtful: its memory is in .*\n"
        r"octet: result unreliable: at tick \d+ \(node 1\) the robot restarted.*\n",
        errors,
    )
    assert "gone 1 time" in output
    assert (tmp_path / "robot.mem").read_bytes() == LEARNED


@pytest.mark.faulty
def test_run_ends_with_one_message_when_the_serial_line_stays_away(robot_on, tmp_path):
    socket, cable = Socket(tmp_path / "tty"), Cable()
    robot_on(robots_end(cable))
    socket.plug(cable.ends[1])
    words = ("--environments", "9", "--reconnect-s", "0.5", "--bus", f"slcan:{socket.path}", "--robot", "external")
    process = start_octet("run", "--out", tmp_path / "out", *words)
    wait_until(lambda: cable.passed > SOME_TICKS, "ticks")

    socket.unplug()  # before its tty has another owner: the next cable of any test may get the same one
    cable.close()

    _, errors = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert re.fullmatch(r"octet: the bus slcan:\S+ has been gone for 0.5 s: .*\n", errors)


@pytest.mark.faulty
@pytest.mark.parametrize("length", [("30",), ("6", "--real-time", *BUSY_HOST)], ids=["in lockstep", "in real time"])
def test_restarted_robot_keeps_its_memory_and_the_run_is_doubtful(robot_on, cable, tmp_path, length):
    words = ("--environments", "1", *external(cable), "--limit-s", *length)
    memory = tmp_path / "robot.mem"
    memory.write_bytes(LEARNED)
    robot = robot_on(robots_end(cable))
    process = start_octet("run", "--out", tmp_path / "out", "--memory", memory, *words)
    wait_until(lambda: cable.passed > SOME_TICKS, "ticks")

    robot.kill()
    robot.wait()
    robot_on(robots_end(cable))

    _, errors = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 1
    assert "result unreliable: at tick" in errors
    assert "its memory restored" in errors
    assert f"its memory is in {memory}.doubtful" in errors
    assert errors.count("\n") == 2
    assert memory.read_bytes() == LEARNED


@pytest.mark.faulty
def test_watched_external_robot_runs_in_real_time_on_its_own_clock(robot_on, cable, tmp_path):
    robot_on(robots_end(cable))
    words = ("--environments", "1", "--limit-s", "3", "--port", "0", "--json", *external(cable))

    done = octet("run", "--watch", *BUSY_HOST, "--out", tmp_path, *words)

    assert (done.returncode, "result unreliable" in done.stderr) == (0, False), done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["environments"][0]["ticks"] == 150
    assert summary["wall_s"] > 2.5


@pytest.fixture
def adapter_that() -> Iterator[Callable[[str], str]]:
    """Plugs in an adapter with a habit, on a bus with a robot; returns the name of its tty."""
    with ExitStack() as stack:

        def plug(habit: str) -> str:
            adapter = stack.enter_context(closing(Adapter(1, node_of=lambda _id: 1, habit=habit)))
            stack.enter_context(robot_at(f"slcan:{adapter.robots[1]}"))
            return adapter.host

        yield plug


@pytest.mark.parametrize("habit", ["crlf", "stamps", "echoes", "restarts"])
def test_quirks_of_real_adapters_change_no_drive(run, adapter_that, habit):
    words = ("--environments", "1", "--limit-s", "5", "--owner", "1")

    over_adapter = run(*words, "--bus", f"slcan:{adapter_that(habit)}", "--robot", "external")

    assert (over_adapter.code, over_adapter.errors) == (0, "")
    assert drives_in(over_adapter.log) == drives_in(run(*words, "--bus", "none").log)


def test_adapter_that_refuses_to_open_its_bus_is_reported(run, adapter_that, monkeypatch):
    monkeypatch.setattr("host_sim.sim.connect._EXTERNAL_S", 3.0)
    refused = run("--environments", "1", "--bus", f"slcan:{adapter_that('refuses')}", "--robot", "external")

    assert refused.code != 0
    assert re.search(
        r"no robot answered .*; the adapter refused a command or a frame \d+ times \(BELL\)", refused.errors
    )
