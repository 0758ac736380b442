"""The tick loop in C against the readable one: logs byte for byte, and all that is recorded and counted."""

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from host_sim.base.errors import RobotError
from host_sim.client.commands import erase_memory, freeze, start, stop, write_cells
from host_sim.client.frame_log import FrameLog
from host_sim.client.session import Session
from host_sim.protocol.generated import PROFILES, Reason
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import EpisodeResult
from host_sim.world.edits import Edit
from tests.sim.native_equality import learned

READABLE, IN_C = "in Python", "in C"

Change = Callable[[Simulation, RunRecorder], object]


@dataclass
class Outcome:
    """All that a run leaves behind."""

    log: bytes
    episodes: Sequence[EpisodeResult]
    recorder: RunRecorder
    clients: Sequence[tuple]
    senses: Sequence
    drives: Sequence
    edits: int
    refused: Sequence


def outcome(
    folder: Path,
    config: RunConfig,
    kind: str,
    block_ticks: int = BLOCK_TICKS,
    changes: dict[int, Change] | None = None,
) -> Outcome:
    """Does a run, with changes before some of its ticks."""
    log = FrameLog(folder / "run.log")
    with make(config, log) as simulation:
        simulation.native = kind != READABLE
        recorder = RunRecorder.of(simulation, boredom_limit=10)
        episodes = [
            episode_of(simulation, recorder, number, block_ticks, changes or {})
            for number in range(1, 1 + config.environments)
        ]
        assert (simulation.loop is not None) == (kind != READABLE)
        for client in simulation.clients:
            stop(client)
        clients = [(client.memory, client.faults, client.frames, client.inbox.last) for client in simulation.clients]
        log.close()
        return Outcome(
            *((folder / "run.log").read_bytes(), episodes, recorder, clients, simulation.senses, simulation.drives),
            *(len(simulation.record.edits), simulation.record.refused),
        )


def episode_of(
    simulation: Simulation, recorder: RunRecorder, number: int, block_ticks: int, changes: dict[int, Change]
) -> EpisodeResult:
    simulation.enter(number)
    while not simulation.over:
        if simulation.tick in changes:
            changes[simulation.tick](simulation, recorder)
        coming = min((tick for tick in changes if tick > simulation.tick), default=sys.maxsize)
        simulation.step(min(block_ticks, coming - simulation.tick))
    return simulation.leave()


def assert_equal(one: Outcome, other: Outcome) -> None:
    assert one.log == other.log
    assert one.episodes == other.episodes
    assert one.clients == other.clients
    assert (one.senses, one.drives) == (other.senses, other.drives)
    assert one.recorder.trajectory == other.recorder.trajectory
    assert learned(one.recorder) == learned(other.recorder)


def assert_alike(folder: Path, config: RunConfig, changes: dict[int, Change] | None = None) -> Outcome:
    """In Python and in C, in blocks and tick by tick."""
    readable = outcome(folder, config, READABLE, changes=changes)
    for block_ticks in (BLOCK_TICKS, 7, 1):
        assert_equal(readable, outcome(folder, config, IN_C, block_ticks, changes))
    return readable


@pytest.mark.parametrize(("seed", "robots"), [(1, 1), (2, 3)])
def test_run_is_the_same_in_python_and_in_c(tmp_path, seed, robots):
    readable = assert_alike(tmp_path, RunConfig(seed=seed, robots=robots, environments=2, limit_s=25.0))

    assert any(history.lessons for history in readable.recorder.histories)


def test_finished_environment_is_the_same(tmp_path):
    readable = assert_alike(tmp_path, RunConfig(seed=5, environments=1))

    assert readable.episodes[0].finished


@pytest.mark.parametrize("profile", [profile for profile in PROFILES if profile != "distance"])
def test_behaviours_of_all_profiles_are_the_same(tmp_path, profile):
    config = RunConfig(seed=4, environments=1, limit_s=20.0, profile=profile)

    assert_equal(outcome(tmp_path, config, READABLE), outcome(tmp_path, config, IN_C))


def press_freeze(simulation: Simulation, recorder: RunRecorder) -> None:
    freeze(simulation.clients[0], on=True)
    recorder.histories[0].frozen = True


CHANGES: dict[int, Change] = {
    100: lambda simulation, _: simulation.edit(Edit("add_bar", a=(0.0, 0.0), b=(0.0, 900.0))),
    150: lambda simulation, _: simulation.edit(Edit("lift")),
    170: lambda simulation, _: simulation.edit(Edit("put", at=simulation.arena.body.pose[:2], heading=1000 * 1.0)),
    200: lambda simulation, _: write_cells(simulation.clients[0], {1: 2, 4: 1}),
    201: lambda simulation, _: erase_memory(simulation.clients[0]),
    300: lambda simulation, _: simulation.edit(Edit("move_food", 1, at=(50.0, 2950.0))),
    400: lambda simulation, _: simulation.edit(Edit("remove_bar", 0)),
    1200: press_freeze,
    1400: lambda simulation, _: write_cells(simulation.clients[0], {6: 1}),
}


SURPRISES = (
    *("plant:600,700@2s", "plant@3s", "grow@5s", "mirror@4s", "swap-motors@6s/2", "stuck-on:front@7s/1"),
    *("stuck-off:left@8s", "noise:100/1000@env1+9s", "weak-motor:left:60%@env2/2", "repair@env2+5s/1"),
    *("odometer:left:150%@1s", "odometer:right:-30%@12s/2", "swap-odometers@9.5s/1", "false-beacon:100@env2+8s"),
)


def test_run_with_many_changes_is_the_same(tmp_path):
    readable = assert_alike(tmp_path, RunConfig(seed=6, robots=2, environments=2, limit_s=15.0, changes=SURPRISES))

    assert not readable.refused
    assert readable.edits == 20


def test_run_whose_robots_stop_for_their_wheels_is_the_same(tmp_path):
    broken = ("odometer:left:-100%@2s/2", "swap-odometers@4s/1", "odometer:right:0%@6s/3")

    readable = assert_alike(tmp_path, RunConfig(seed=6, robots=3, environments=2, limit_s=12.0, changes=broken))

    assert readable.drives[1].reason == Reason.STOP


def test_run_with_edits_and_commands_by_hand_is_the_same(tmp_path):
    assert_alike(tmp_path, RunConfig(seed=6, environments=1, limit_s=40.0), CHANGES)


def test_memory_learned_again_after_a_command_is_reported_again(tmp_path):
    """The same memory was reported long before: as a report of that kind it is no news, but for the command."""

    def learn(simulation: Simulation, _: RunRecorder) -> None:
        write_cells(simulation.clients[0], {1: 1})

    def erase(simulation: Simulation, _: RunRecorder) -> None:
        erase_memory(simulation.clients[0])

    config = RunConfig(seed=1, environments=1, limit_s=50.0)

    assert_alike(tmp_path, config, {10: learn, 20: erase, 1000: erase, 1500: erase})


def test_reports_waiting_from_before_are_logged_in_the_first_tick(tmp_path):
    """A robot that starts with a memory of its own reports it, and the report is not waited for."""

    def start_again(simulation: Simulation, _: RunRecorder) -> None:
        for profile in [*["fixed"] * 100, "never"]:
            start(simulation.clients[0], Session(9, PROFILES[profile]))

    config = RunConfig(seed=1, environments=1, limit_s=10.0, profile="fixed")

    assert_alike(tmp_path, config, {100: start_again})


def test_run_that_ends_while_a_report_is_under_way_is_the_same(tmp_path):
    """Once a second a robot reports, some of it a tick later: what it tells again after a stop between is known."""
    for ticks in range(95, 105):
        config = RunConfig(seed=1, environments=1, limit_s=ticks / 50)

        assert_equal(outcome(tmp_path, config, READABLE), outcome(tmp_path, config, IN_C))


@pytest.mark.parametrize("native", [True, False])
def test_run_without_a_log_is_the_same(tmp_path, native):
    config = RunConfig(seed=3, environments=2, limit_s=20.0)

    with make(config) as simulation:
        simulation.native = native
        episodes = list(simulation.run())
        digest = simulation.clients[0].log.close()

    assert episodes == outcome(tmp_path, config, READABLE).episodes
    assert digest == FrameLog().close()


def test_robot_that_stays_silent_is_named():
    with make(RunConfig(environments=1)) as simulation:
        simulation.enter(1)
        simulation.step(30)
        loop, ffi = simulation.loop._loop, simulation.loop._ffi
        loop.exchange = silent = ffi.callback("size_t(struct octet *, const struct frame *)", lambda *_: 0)

        with pytest.raises(RobotError, match="did not answer tick 30 "):
            simulation.step(30)

        assert simulation.tick == 30
        assert silent


@pytest.mark.parametrize("config", [RunConfig(bus="fd", real_time=True), RunConfig(bus="fd", faults=("drop:1%",))])
def test_loop_in_c_is_not_used_in_real_time_or_with_faults(config):
    with make(config) as simulation:
        simulation.enter(1)
        assert simulation.loop is None
