"""A long run takes no more memory than a shorter one, and what is left out is said."""

import gc
import sys
import weakref
from contextlib import ExitStack

import pytest

from host_sim.protocol.codec import Protocol
from host_sim.recording import run_recorder as run_recorder_module
from host_sim.recording.history import LearningHistory
from host_sim.recording.log_reader import LogReader
from host_sim.recording.recording import read_recording
from host_sim.recording.run_recorder import RunRecorder
from host_sim.report.picture import write_picture
from host_sim.report.replay_page import omissions, run_data
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig

TICKS_MAX, LIMIT_S, EPISODE_TICKS = 1000, 4.0, 200
PIECES_OF_A_RESULT = 40
"""Bytes of memory, as Python counts them: the numbers of an environment, and what each robot began and learned."""


@pytest.fixture(autouse=True)
def short_memory(monkeypatch):
    monkeypatch.setattr(run_recorder_module, "TICKS_MAX", TICKS_MAX)


def recorded(environments: int) -> RunRecorder:
    config = RunConfig(seed=5, environments=environments, limit_s=LIMIT_S)
    with ExitStack() as stack:
        simulation = stack.enter_context(make(config))
        recorder = RunRecorder.of(simulation, boredom_limit=10)
        for _ in simulation.run():
            pass
    return recorder


def retained(recorder: RunRecorder) -> dict[str, int]:
    trajectory, (track,) = recorder.trajectory, recorder.trajectory.tracks
    return {
        "poses": len(track.poses_flat),
        "rows": len(track.rows_flat),
        "scenes": len(trajectory.scenes),
        "meals": len(trajectory.meals),
        "memories": len(track.memories),
        "trials": len(track.trials),
        "eaten": len(track.meals),
        "lessons": len(track.lessons),
        "cells": len(track.cells),
    }


def test_run_of_60_environments_retains_no_more_than_one_of_20():
    short, long = retained(recorded(20)), retained(recorded(60))

    room = TICKS_MAX * 9 // 8 + 2 * EPISODE_TICKS
    assert long["poses"] <= 3 * room
    assert long["rows"] <= 17 * room
    assert long["scenes"] <= room // EPISODE_TICKS
    assert all(long[name] <= short[name] + 8 for name in ("meals", "memories", "trials", "eaten", "lessons"))
    assert long["cells"] <= 8 + room // 10


def test_environments_with_faults_retain_only_their_results():
    config = RunConfig(seed=5, environments=30, limit_s=LIMIT_S, faults=("drop:5%", "duplicate:5%", "flood:1%:20"))
    pieces, results = [], []
    with make(config) as simulation:
        RunRecorder.of(simulation, boredom_limit=10)
        for number, episode in enumerate(simulation.run(), 1):
            results.append(episode)
            if number in (10, 30):
                gc.collect()
                pieces.append(sys.getallocatedblocks())

    assert simulation.clients[0].connection.link.schedule.count > 1000
    assert pieces[1] - pieces[0] < 20 * PIECES_OF_A_RESULT


def test_arena_of_a_finished_environment_is_freed():
    arenas = weakref.WeakSet()
    gc.disable()
    try:
        with make(RunConfig(environments=5, limit_s=0.1)) as simulation:
            for _ in simulation.run():
                arenas.add(simulation.arena)
                assert len(arenas) == 1
    finally:
        gc.enable()


def test_long_trajectory_is_cut_rarely(monkeypatch):
    cuts = []
    forget = RunRecorder._forget
    monkeypatch.setattr(RunRecorder, "_forget", lambda self, first: (cuts.append(first), forget(self, first)))
    monkeypatch.setattr(run_recorder_module, "TICKS_MAX", 8 * TICKS_MAX)

    recorded(60)

    assert 1 <= len(cuts) <= 3


def test_turns_that_are_no_longer_retained_are_still_counted():
    trajectory, whole = recorded(30).trajectory, None
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run_recorder_module, "TICKS_MAX", 10**9)
        whole = recorded(30).trajectory

    assert trajectory.first_tick > whole.first_tick == 0
    assert sum(cell.uses for cell in trajectory.tracks[0].cells[:8]) > 0
    ticks = range(trajectory.first_tick, trajectory.ticks, 7)
    assert [trajectory.at(tick) for tick in ticks] == [whole.at(tick) for tick in ticks]


def test_page_and_picture_of_a_long_run_say_what_they_leave_out(tmp_path, monkeypatch):
    trajectory = recorded(30).trajectory
    kept = len(trajectory.begun())
    said = []
    monkeypatch.setattr("host_sim.report.picture.omissions", lambda *counts: said.append(counts) or [])

    write_picture(tmp_path / "run.png", trajectory)

    assert 0 < kept < 30
    assert run_data(trajectory, "seed 5")["title"] == f"seed 5, the last {kept} of 30 environments"
    assert said == [(30, 1)]


def test_short_run_leaves_nothing_out():
    assert omissions(recorded(3).trajectory) == []


def test_ticks_of_a_log_are_read_only_as_needed(kept):
    class CountedLog(LogReader):
        lines = 0

        def __iter__(self):
            for line in super().__iter__():
                self.lines += 1
                yield line

    log = CountedLog(kept.log)
    ticks = read_recording(log, Protocol()).ticks
    log.lines = 0
    tick = next(iter(ticks))

    assert log.lines < 30
    assert tick == next(iter(ticks))
    assert sum(1 for _ in ticks) == kept.trajectory.ticks


def test_history_keeps_the_last_forgotten_lesson_of_each_cell():
    history = LearningHistory()
    cells = [(1, 0), (1, 2), (2, 2), (0, 2), (0, 1)]
    for tick, (first, third) in enumerate(cells):
        history.relearn(tick, (0, first, 0, third, 0, 0, 0, 0))

    history.forget_lessons(4)

    assert [(lesson["tick"], lesson["cell"]) for lesson in history.lessons] == [(1, 3), (3, 1), (4, 3)]
    assert history.forgotten == 2
