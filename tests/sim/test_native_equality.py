"""A sample of the comparison that `tools/bench --loops` makes over ten million ticks, and its canary."""

from dataclasses import replace

import pytest

from host_sim.bench import native_equality
from host_sim.bench.native_equality import compare_loops
from host_sim.world import plain_space
from host_sim.world.native_world import NativeWorld
from host_sim.world.params import SimParams


@pytest.fixture(autouse=True)
def _short(monkeypatch):
    monkeypatch.setattr(native_equality, "_LIMIT_S", 20.0)


def test_all_loops_do_the_same():
    verdicts = list(compare_loops(15_000))

    assert [verdict.difference for verdict in verdicts] == [None] * len(verdicts)
    assert sum(verdict.ticks for verdict in verdicts) >= 15_000


def test_a_wheel_track_that_differs_in_the_last_places_is_found(monkeypatch):
    built = NativeWorld.__init__

    def build(self, *arguments) -> None:
        built(self, *arguments)
        self.world.params.wheel_track_mm += 1e-10

    monkeypatch.setattr(NativeWorld, "__init__", build)

    difference = next(compare_loops(1)).difference
    assert "trajectory" in difference


def test_a_cone_that_reaches_a_little_farther_is_found(monkeypatch):
    laid_out = plain_space.cones_in_c

    def lay_out(ffi, library, params: SimParams) -> object:
        return laid_out(ffi, library, replace(params, sensor_reach_mm=61.0))

    monkeypatch.setattr(plain_space, "cones_in_c", lay_out)

    difference = next(compare_loops(1)).difference
    assert "log" in difference
