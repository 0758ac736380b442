"""The progress line of a run, on terminals of any width."""

import io
import os

import pytest

from host_sim.live import progress
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig


class Terminal(io.StringIO):
    """What is written to a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(("columns", "longest"), [(20, 19), (200, 100)])
def test_the_line_never_wraps(monkeypatch, columns, longest):
    monkeypatch.setattr(progress, "_EVERY_S", 0.0)
    monkeypatch.setattr("shutil.get_terminal_size", lambda: os.terminal_size((columns, 24)))
    shown = Terminal()
    with make(RunConfig(environments=1, limit_s=10)) as simulation:
        simulation.enter(1)
        line = progress.Progress(shown)
        while simulation.tick < 100:
            simulation.step()
            line(simulation)

    lines = shown.getvalue().split("\r\x1b[K")[1:]

    assert lines[0].startswith("environment 1 of 1")
    assert max(map(len, lines)) <= longest
