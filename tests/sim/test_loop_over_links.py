"""The tick loop in C over sockets against the readable one: whatever a line brings, the same rules apply."""

import errno
import os
import signal
import time
from collections.abc import Iterable
from pathlib import Path

import pytest

from host_sim.base.errors import RobotError
from host_sim.client.commands import erase_memory, stop, write_cells
from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import Frame
from host_sim.protocol.generated import NOTHING_SENSED
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim import block_catch_up
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from tests.sim.native_equality import (
    DRIVE,
    LATE_S,
    PROTOCOL,
    RAW,
    Meddle,
    assert_alike,
    outcome,
    packed,
    protected,
)


def foreign(frame: Frame) -> Meddle:
    return lambda answers: [packed(frame), *answers]


def twice(answers: list[bytes]) -> Iterable[bytes]:
    return [*answers, *answers]


def lost(_: list[bytes]) -> Iterable[bytes]:
    return []


def late(answers: list[bytes]) -> Iterable[bytes]:
    time.sleep(LATE_S)
    return answers


def damaged(answers: list[bytes]) -> Iterable[bytes]:
    return [*answers[:-1], answers[-1][:12] + b"\xff" + answers[-1][13:], answers[-1]]


def flagged(flag: int) -> Meddle:
    return lambda answers: [RAW.pack(DRIVE | flag, 8, b""), *answers]


def garbled(answers: list[bytes]) -> Iterable[bytes]:
    return [b"", b"x", RAW.pack(DRIVE, 9, b""), bytes(17), *answers]


QUIET: dict[str, Meddle] = {
    "a frame of nobody's": foreign(Frame(0x123, b"12345678")),
    "an answer twice": twice,
    "an answer that is lost": lost,
    "an answer that is late": late,
    "a damaged answer": damaged,
    "an extended frame": flagged(0x80000000),
    "a remote request": flagged(0x40000000),
    "an error frame": flagged(0x20000000),
    "datagrams that are no frames": garbled,
    "an old drive": foreign(protected(DRIVE, bytes((0, 3, 250, 0, 0, 0, 0, 0)))),
    "an empty memory that is old": foreign(protected(PROTOCOL.id_of("MEMORY"), bytes(6))),
}


def drives_in(log: bytes) -> list[bytes]:
    """The lines of DRIVEs: of reports, some may be lost."""
    return [line for line in log.splitlines() if b" %03X#" % DRIVE in line]


def test_run_over_sockets_is_the_same_in_python_and_in_c(tmp_path):
    assert_alike(tmp_path, {})


@pytest.mark.parametrize("meddle", QUIET.values(), ids=QUIET)
def test_disturbed_link_leaves_the_drives_unchanged(tmp_path, meddle):
    undisturbed = outcome(tmp_path, {}, native=False)

    result = assert_alike(tmp_path, {40: meddle, 41: meddle, 300: meddle})

    assert drives_in(result.log) == drives_in(undisturbed.log)
    assert not result.error


def test_lost_answers_are_repeated_in_c_as_in_python(tmp_path):
    assert assert_alike(tmp_path, {40: lost, 300: lost}).repeated >= 2


def test_garbled_datagrams_are_counted(tmp_path):
    assert assert_alike(tmp_path, {40: garbled, 300: garbled}).garbled == 8


HEARTBEAT = {"counter": 7, "state": 1, "frozen": 0, "lockstep": 1, "silent": 0, "profile": 0, "uptime": 3}
FORGED: dict[str, Frame] = {
    "a heartbeat of another owner's robot": PROTOCOL.encode(
        "HEARTBEAT", {**HEARTBEAT, "owner": 8, "layout": PROTOCOL.layout}
    ),
    "a heartbeat of another layout": PROTOCOL.encode("HEARTBEAT", {**HEARTBEAT, "owner": 1, "layout": 1}),
    "another drive for the same senses": protected(DRIVE, bytes((0, 39 % 15, 38, 4, 77, 0, 0, 0))),
    "senses of another simulator": PROTOCOL.encode_senses(NOTHING_SENSED, 3),
    "the end of a stopped robot": protected(DRIVE, bytes((0, 40 % 15, 39, 0, 0, 0, 0, 0))),
}


@pytest.mark.parametrize("frame", FORGED.values(), ids=FORGED)
def test_frames_that_contradict_the_session_are_found_in_c_as_in_python(tmp_path, frame):
    assert_alike(tmp_path, {40: foreign(frame), 200: foreign(frame)})


def test_robot_that_commands_an_impossible_speed_is_an_incident_once(tmp_path):
    def rush(answers: list[bytes]) -> list[bytes]:
        frame = Frame(DRIVE, answers[-1][8:])
        signals = PROTOCOL.decode(frame).signals
        return [*answers[:-1], packed(PROTOCOL.encode("DRIVE", {**signals, "left": 2047}))]

    result = assert_alike(tmp_path, {40: rush, 41: rush})

    told = [text.partition(") ")[2].partition(" and")[0] for text in result.incidents]
    assert told.count("the robot told its wheels 2047") == 1


COMMANDS = {
    100: lambda client: write_cells(client, {1: 2, 4: 1}),
    101: erase_memory,
    250: lambda client: write_cells(client, {6: 1}),
    400: lambda client: write_cells(client, {2: 1}),
}


def test_commands_between_blocks_have_the_same_effect(tmp_path):
    assert_alike(tmp_path, {140: lost, 260: lost}, COMMANDS)


def test_c_code_runs_nearly_all_ticks(tmp_path):
    blocks = outcome(tmp_path, {}, native=True).blocks

    assert sum(blocks) == 600
    assert len(blocks) < 60


def slow(answers: list[bytes]) -> Iterable[bytes]:
    time.sleep(0.003)
    return answers


def test_blocks_are_short_on_a_slow_link(tmp_path):
    blocks = outcome(tmp_path, dict.fromkeys(range(200), slow), native=True).blocks

    first_tick, short = 0, []
    for ticks in blocks:
        short += [ticks] if 64 < first_tick < 200 else []
        first_tick += ticks
    assert short
    assert max(short) <= 17


def test_robot_killed_within_a_block_is_named():
    """Its socket is closed in the middle of a block."""
    with make(RunConfig(environments=1, bus="fd")) as simulation:
        simulation.enter(1)
        while simulation.tick < 20:
            simulation.step(20 - simulation.tick)
        os.kill(simulation.clients[0].connection.link.explain.__self__.pid, signal.SIGKILL)

        with pytest.raises(RobotError, match=r"killed by signal 9 \(SIGKILL\)"):
            simulation.step(200)

        assert simulation.tick == 20


def descriptors() -> int:
    return sum(1 for _ in Path("/proc/self/fd").iterdir())


def test_descriptors_opened_by_c_code_are_closed_with_the_link():
    before = descriptors()

    with make(RunConfig(environments=1, bus="fd")) as simulation:
        simulation.enter(1)
        simulation.step(50)
        during = descriptors()

    assert during > before
    assert descriptors() == before


def test_python_runs_the_ticks_when_no_descriptor_is_free(tmp_path, monkeypatch):
    def refuse(_: int) -> int:
        raise OSError(errno.EMFILE, "Too many open files")

    monkeypatch.setattr(block_catch_up.os, "dup", refuse)

    assert set(outcome(tmp_path, {}, native=True).blocks) == {1}


def test_socket_that_c_code_cannot_use_is_left_to_python(tmp_path, monkeypatch):
    monkeypatch.setattr(block_catch_up.os, "dup", lambda _: os.open("/dev/null", os.O_RDONLY))
    before = descriptors()

    assert set(outcome(tmp_path, {}, native=True).blocks) == {1}
    assert descriptors() == before


@pytest.mark.parametrize("robots", [1, 3])
def test_robots_in_processes_do_the_same_as_in_process(tmp_path, robots):
    logs = []
    for bus, native in (("none", False), ("fd", True), ("fd", False)):
        log = FrameLog(tmp_path / "run.log")
        config = RunConfig(seed=2, robots=robots, environments=2, limit_s=15.0, bus=bus, profile="adaptive")
        with make(config, log) as simulation:
            simulation.native = native
            recorder = RunRecorder.of(simulation, boredom_limit=10)
            episodes = list(simulation.run())
            for client in simulation.clients:
                stop(client)
        log.close()
        logs.append(((tmp_path / "run.log").read_bytes(), episodes, recorder.trajectory))

    assert logs[0] == logs[1] == logs[2]
