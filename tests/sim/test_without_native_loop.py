"""Where the tick loop in C cannot be used: one line says why, and the readable loop does the run."""

import logging
from pathlib import Path

import pytest

from host_sim.sim import native_loop
from host_sim.sim import simulation as simulation_module
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig


def remove_library(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(native_loop, "LIBRARY", tmp_path / "liboctet_loop.so")


def break_library(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "liboctet_loop.so").write_text("no library")
    monkeypatch.setattr(native_loop, "LIBRARY", tmp_path / "liboctet_loop.so")


def break_headers(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    other = tmp_path / "loop.h"
    other.write_text(native_loop.HEADERS[-1].read_text() + "/* newer */\n")
    monkeypatch.setattr(native_loop, "HEADERS", (*native_loop.HEADERS[:-1], other))


BROKEN = {
    remove_library: "liboctet_loop.so is missing",
    break_library: "liboctet_loop.so cannot be loaded",
    break_headers: "liboctet_loop.so was built from other sources",
}


@pytest.fixture
def fresh():
    """The library is loaded anew."""
    native_loop._loaded.cache_clear()
    yield
    native_loop._loaded.cache_clear()


@pytest.mark.usefixtures("fresh")
@pytest.mark.parametrize(("damage", "reason"), BROKEN.items(), ids=lambda part: getattr(part, "__name__", ""))
def test_where_it_cannot_be_used_one_line_says_so_and_python_goes_on(tmp_path, monkeypatch, caplog, damage, reason):
    config = RunConfig(seed=3, environments=2, limit_s=2.0)
    with make(config) as simulation:
        simulation.native = False
        expected = list(simulation.run())
    damage(monkeypatch, tmp_path)

    with make(config) as simulation, caplog.at_level(logging.WARNING):
        episodes = list(simulation.run())

    assert episodes == expected
    assert [record.name for record in caplog.records] == [simulation_module.__name__]
    assert reason in caplog.text
    assert "\n" not in caplog.records[0].getMessage()
