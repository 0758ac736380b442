"""Runs to look at, one to change, and runs that have begun."""

from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import pytest

from host_sim.live.paced_run import PacedRun
from host_sim.live.text_picture import View
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.trajectory import at
from host_sim.sim.make import start_robots
from host_sim.sim.run_config import RunConfig
from host_sim.world.geometry import SimParams
from tests.live.support import Live
from tests.recording.conftest import kept, short, ten_seconds
from tests.recording.support import open_simulation

__all__ = ["kept", "short", "ten_seconds"]


@pytest.fixture
def live(tmp_path: Path) -> Iterator[Live]:
    """Makes runs that have begun, each with a log of its own."""
    with ExitStack() as stack:

        def begin(name: str = "run", robots: int = 1, *, fixed: bool = False, **options) -> PacedRun:
            config = RunConfig(seed=1, robots=robots)
            config = replace(config, profile="fixed", settings={"filter": 1}) if fixed else config
            simulation = open_simulation(stack, tmp_path / f"{name}.log", config)

            def restart(seed: int) -> None:
                start_robots(simulation.clients, replace(config, seed=seed))

            run = PacedRun(simulation, RunRecorder.of(simulation, 10), restart, **options)
            run.begin()
            return run

        yield begin


@pytest.fixture(scope="session")
def view(ten_seconds) -> View:
    """What a terminal shows just before the first lesson."""
    trajectory, tick = ten_seconds.trajectory, 170
    trail = [(x, y) for x, y, _ in trajectory.tracks[0].poses()[: tick + 1].tolist()]
    scene, states = at(trajectory.scenes, tick), [trajectory.at(tick)]
    return View(SimParams(), scene, states, [trail], 10, "1 x real time", "q quits")
