"""A log gives back the run: every tick of it."""

import asyncio
import math
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from host_sim.base.errors import OctetError
from host_sim.cli.main import main
from host_sim.client.commands import freeze, write_cells
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED, EraseMemory, Freeze, NewSeed, NextEnvironment, WriteCell
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import NOTHING_SENSED, REST, Senses
from host_sim.recording import run_recorder as run_recorder_module
from host_sim.recording.log_reader import read_log
from host_sim.recording.recording import read_recording
from host_sim.recording.resimulation import resimulate
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path, write_world
from host_sim.sim.make import start_robots
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.world.crates import Crates
from host_sim.world.edits import Edit
from host_sim.world.geometry import Bar, SimParams
from tests.recording.support import open_simulation, record_run, without, write_log


def assert_equal(one: Trajectory, other: Trajectory) -> None:
    assert one.ticks == other.ticks
    assert (one.scenes, one.meals) == (other.scenes, other.meals)
    for robot, (ours, theirs) in enumerate(zip(one.tracks, other.tracks, strict=True)):
        assert np.array_equal(ours.poses(), theirs.poses())
        assert ours.memories == theirs.memories
        assert (ours.trials, ours.lessons, ours.cells) == (theirs.trials, theirs.lessons, theirs.cells)
        assert one.events(robot) == other.events(robot)
        for tick in range(0, one.ticks, 97):
            assert one.at(tick, robot) == other.at(tick, robot)


@pytest.mark.parametrize("seed", [1, 7, 4242])
def test_trajectory_has_the_senses_and_drives_of_the_log(tmp_path, seed):
    log = record_run(tmp_path, seed, environments=2, limit_s=60.0).log
    protocol = Protocol()
    messages = [protocol.decode(line.frame) for line in read_log(log)]
    senses = [message.signals for message in messages if message.name == "SENSES"]
    drives = [message.signals for message in messages if message.name == "DRIVE" and message.signals["reason"]]

    trajectory = resimulate(log).trajectory

    assert trajectory.ticks == len(senses) == len(drives)
    assert trajectory.tracks[0].column("beacon_mm").tolist() == [frame["beacon"] for frame in senses]
    for name in ("tick", "feel", "bump", "look", "odometer_left", "odometer_right"):
        assert trajectory.tracks[0].column(name).tolist() == [frame[name] for frame in senses]
    for name in ("reason", "repeat_count", "action", "eat"):
        assert trajectory.tracks[0].column(name).tolist() == [frame[name] for frame in drives]
    for name in ("left", "right"):
        assert trajectory.tracks[0].column(f"{name}_mm_s").tolist() == [frame[name] for frame in drives]


def test_resimulated_trajectory_equals_that_of_the_run(kept):
    assert_equal(resimulate(kept.log).trajectory, kept.trajectory)


def test_log_without_a_world_file_has_the_environments_of_its_seed(tmp_path):
    run = record_run(tmp_path, seed=2, environments=2)
    world_path(run.log).unlink()

    result = resimulate(run.log)

    assert result.seed == 2
    assert_equal(result.trajectory, run.trajectory)


def meddle(simulation: Simulation, run_recorder: RunRecorder) -> None:
    """What a person may do in the first 12 seconds."""
    at_tick = {
        100: lambda: simulation.edit(Edit("add_bar", a=(500.0, 2500.0), b=(900.0, 2700.0))),
        150: lambda: simulation.edit(Edit("lift")),
        180: lambda: simulation.edit(Edit("put", at=(2000.0, 1500.0), heading=500)),
        200: lambda: simulation.edit(Edit("move_food", 0, at=(2600.0, 1800.0))),
        250: lambda: write_cells(simulation.clients[0], {1: 2}),
        300: lambda: freeze(simulation.clients[0], True),
    }
    at_tick.get(simulation.tick, lambda: None)()
    run_recorder.histories[0].frozen = simulation.tick >= 300


def test_pushed_crates_have_a_scene_in_each_tick(tmp_path, monkeypatch):
    """In the last tick of an environment, too: nobody sees what that pushes."""

    def push(crates: Crates, _drives: object) -> Iterator[Edit]:
        (ax, ay), (bx, by) = crates._arena.obstacles.bars[0]
        yield Edit("push_bar", 0, a=(round(ax) + 1.0, round(ay)), b=(round(bx) + 1.0, round(by)))

    monkeypatch.setattr(Crates, "push", push)
    run = record_run(tmp_path, environments=2, limit_s=0.2, world="crates")

    assert [tick for tick, _ in run.trajectory.scenes] == list(range(20))
    assert_equal(resimulate(run.log).trajectory, run.trajectory)


def test_edits_by_hand_are_replayed(tmp_path):
    run = record_run(tmp_path, seed=3, environments=2, limit_s=12.0, meddle=meddle)

    trajectory = resimulate(run.log).trajectory

    assert_equal(trajectory, run.trajectory)
    assert [tick for tick, _ in trajectory.scenes] == [0, 100, 150, 180, 200, 600]
    assert trajectory.at(160)["lifted"] == 1
    assert trajectory.at(299)["frozen"] == 0
    assert trajectory.at(300)["frozen"] == 1
    assert {"node": 1, "tick": 250, "cell": 1, "side": 2, "by_hand": 1} in trajectory.tracks[0].lessons


def test_live_edits_are_replayed(tmp_path):
    add_bar = Edit("add_bar", **Bar((500.0, 2500.0), (900.0, 2700.0))._asdict())
    orders = {
        100: [add_bar, Edit("lift"), NextEnvironment()],
        300: [WriteCell(2, 1), Freeze(True)],
        500: [Edit("move_food", 0, at=(100.0, 100.0)), NewSeed(9)],
        700: [EraseMemory()],
        900: [add_bar, NextEnvironment(), NewSeed(4), NextEnvironment(), add_bar],
    }
    complaints = []
    with ExitStack() as stack:
        config = RunConfig(seed=3, environments=2, limit_s=30.0)
        simulation = open_simulation(stack, tmp_path / "run.log", config)
        recorder = RunRecorder.of(simulation, 10)

        def watch(simulation: Simulation) -> None:
            recorder(simulation)
            for order in orders.get(simulation.tick, ()):
                live.offer(order, complaints.append)

        simulation.watch, simulation.block_ticks = watch, 1
        live = PacedRun(
            simulation, recorder, lambda seed: start_robots(simulation.clients, replace(config, seed=seed))
        )
        live.stays, live.speed = False, FULL_SPEED
        live.begin()
        asyncio.run(live.play())
    write_world(simulation.record, tmp_path / "run.world.json")

    assert complaints == []
    assert_equal(resimulate(tmp_path / "run.log").trajectory, recorder.trajectory)
    assert [begun.seed for begun in simulation.record.begun] == [3, 3, 9, 9, 4, 4]


@pytest.mark.parametrize("ticks", [0, 3])
def test_cell_written_and_erased_between_two_ticks_is_no_change(ticks):
    empty, written = (0,) * 8, (0, 0, 1, 0, 0, 0, 0, 0)
    recorder = RunRecorder(SimParams(), 10, {1: empty})
    recorder.trajectory.tracks[0].poses_flat.extend([0.0] * 3 * ticks)

    for memory in (written, empty):
        recorder.between(0, None, [memory])

    assert recorder.trajectory.tracks[0].memories == [(0, list(empty))]


def test_senses_that_contradict_the_world_are_reported_with_their_time(short):
    lines = short.log.read_text().splitlines(keepends=True)
    protocol = Protocol()
    index = next(i for i, line in enumerate(lines) if i > 100 and f" {protocol.id_of('SENSES'):03X}#" in line)
    recorded = list(read_log(short.log))[index]
    signals = protocol.decode(recorded.frame).signals
    changed = protocol.encode("SENSES", {**signals, "feel": signals["feel"] ^ 4})
    stamp, channel, _ = lines[index].split()
    lines[index] = f"{stamp} {channel} {changed.id:03X}#{changed.data.hex().upper()}\n"
    short.log.write_text("".join(lines))

    when = f"at {recorded.time_us / 1e6:.2f} s"
    with pytest.raises(OctetError, match=rf"{when} feel is \d+, expected \d+; .*--no-world"):
        resimulate(short.log)


def test_run_with_another_time_limit_needs_its_world_file(tmp_path):
    run = record_run(tmp_path, seed=2, environments=2, limit_s=3.0)
    world_path(run.log).unlink()

    with pytest.raises(OctetError, match=r"world of seed 2: at \d+\.\d\d s .* put that run's run\.world\.json"):
        resimulate(run.log)


def test_log_without_a_seed_reckons_the_path_from_the_odometers(short):
    world_path(short.log).unlink()
    without(short.log, "COMMAND", opcode=2)

    result = resimulate(short.log)

    assert result.seed is None
    assert result.trajectory.scenes[0][1]["bars"] == []
    seen, reckoned = short.trajectory.tracks[0].poses(), result.trajectory.tracks[0].poses()
    assert np.hypot(*np.diff(reckoned[:300, :2], axis=0).T) == pytest.approx(
        np.hypot(*np.diff(seen[:300, :2], axis=0).T), abs=0.15
    )
    turned = np.unwrap(reckoned[:300, 2] - seen[:300, 2])
    assert np.ptp(turned) < math.radians(2)


def test_path_without_a_world_lies_inside_the_arena(kept):
    trajectory = resimulate(kept.log, ignore_world=True).trajectory

    x, y, _ = trajectory.tracks[0].poses().T
    assert x.min() > 0
    assert y.min() > 0
    assert x.max() < trajectory.params.width_mm
    assert y.max() < trajectory.params.height_mm


def test_truncated_log_gives_what_it_has_and_says_so(short, tmp_path, capsys):
    lines = short.log.read_text().splitlines(keepends=True)
    short.log.write_text("".join(lines[:401]))

    assert main(["replay", str(short.log), "--html", str(tmp_path / "page.html")]) == 0
    assert capsys.readouterr().err == f"octet: {short.log} ends before the run does; showing what it has\n"
    assert not resimulate(short.log).stopped


def senses(tick: int) -> Senses:
    return NOTHING_SENSED._replace(tick=tick)


def heartbeat_of(log: Path) -> Frame:
    protocol = Protocol()
    return next(line.frame for line in read_log(log) if line.frame.id == protocol.id_of("HEARTBEAT"))


def test_body_on_its_own_clock_holds_a_drive_for_a_while_and_then_rests(short, tmp_path):
    protocol = Protocol()
    start = {"counter": 1, "opcode": 2, "owner": 1, "lockstep": 0, "profile": 0, "seed": 5}
    drive = REST._replace(left_mm_s=200, right_mm_s=190, reason=1, action=3)
    moving = {"left": 200, "right": 190, "repeat_count": 0, "eat": 0, "action": 3}
    signals = {"counter": 0, "tick": 0, "reason": 1, **moving}
    log = write_log(
        tmp_path / "own_clock.log",
        heartbeat_of(short.log),
        protocol.encode("COMMAND", start),
        protocol.encode_senses(senses(0), 0),
        protocol.encode("DRIVE", signals),
        *(protocol.encode_senses(senses(tick), tick) for tick in range(1, 8)),
    )

    recording = read_recording(read_log(log), protocol)

    rest = [REST._replace(tick=tick) for tick in (6, 7)]
    assert [tick.drive for tick in recording.ticks] == [drive] * 6 + rest


def test_trajectory_of_a_long_run_keeps_the_last_environments(kept, monkeypatch):
    monkeypatch.setattr(run_recorder_module, "TICKS_MAX", 1000)

    trajectory = resimulate(kept.log).trajectory

    first = kept.trajectory.scenes[1][0]
    assert trajectory.first_tick == first
    assert trajectory.ticks == kept.trajectory.ticks
    assert trajectory.at(first) == kept.trajectory.at(first)
    assert trajectory.at(trajectory.ticks - 1) == kept.trajectory.at(trajectory.ticks - 1)
    assert trajectory.events() == [event for event in kept.trajectory.events() if event.tick >= first]
    with pytest.raises(IndexError):
        trajectory.at(first - 1)


def test_several_robots_are_resimulated(tmp_path):
    run = record_run(tmp_path, seed=5, environments=2, limit_s=8.0, robots=3)

    trajectory = resimulate(run.log).trajectory

    assert [track.node for track in trajectory.tracks] == [1, 2, 3]
    assert_equal(trajectory, run.trajectory)
