"""One tick in Python: a short way through few files, so that a reader can follow it; told as a number that wraps."""

import sys
from pathlib import Path
from types import FrameType

import pytest

import host_sim
from host_sim.protocol.generated import TICK_SPAN
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation

PACKAGE = str(Path(host_sim.__file__).parent)
CALLS_MAX, FILES_MAX = 25, 10
ORDINARY_TICK = 21
"""In the middle of a turn: no action begins, and no report is due."""


@pytest.fixture
def simulation():
    with make(RunConfig(environments=1)) as made:
        made.native = False
        RunRecorder.of(made, boredom_limit=10)
        made.enter(1)
        while made.tick < ORDINARY_TICK:
            made.step()
        yield made


def calls_of_a_step(simulation: Simulation) -> list[str]:
    """The file of each function of ours that is called in a step."""
    files: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(PACKAGE):
            files.append(frame.f_code.co_filename)

    sys.setprofile(note)
    simulation.step()
    sys.setprofile(None)
    return files


def test_a_tick_takes_few_calls_and_files(simulation):
    before = simulation.drives[0].action

    files = calls_of_a_step(simulation)

    assert simulation.drives[0].action == before, "this is no ordinary tick"
    assert 10 < len(files) <= CALLS_MAX
    assert len(set(files)) <= FILES_MAX


def test_the_robot_is_told_the_tick_as_it_fits_the_wire(simulation):
    told = []
    for _ in range(TICK_SPAN):
        simulation.step()
        told.append(simulation.senses[0].tick)

    first = ORDINARY_TICK
    assert told == [*range(first, TICK_SPAN), *range(first)]
