"""A sample of the comparison of ten million ticks, and its canary."""

from dataclasses import replace

import pytest

from host_sim.sim.native_loop import NativeLoop
from host_sim.world.native_world import PlainSpace
from host_sim.world.world_library import world_library
from tests.sim import native_equality
from tests.sim.native_equality import compare_loops


@pytest.fixture(autouse=True)
def _short(monkeypatch):
    monkeypatch.setattr(native_equality, "_LIMIT_S", 20.0)


def test_loops_in_c_and_in_python_do_the_same():
    verdicts = list(compare_loops(15_000))

    assert [verdict.difference for verdict in verdicts] == [None] * len(verdicts)
    assert sum(verdict.ticks for verdict in verdicts) >= 15_000


def test_difference_in_the_last_digits_of_the_wheel_track_is_found(monkeypatch):
    entered = NativeLoop.enter

    def enter(self, arena) -> None:
        arena.inside.world.params.wheel_track_mm += 1e-10
        entered(self, arena)

    monkeypatch.setattr(NativeLoop, "enter", enter)

    difference = next(compare_loops(1)).difference
    assert "trajectory" in difference


def test_cone_that_reaches_a_little_farther_is_found(monkeypatch):
    entered = NativeLoop.enter

    def enter(self, arena) -> None:
        farther = replace(arena.params, sensor_reach_mm=61.0)
        arena.inside.space = PlainSpace(*world_library(), arena.inside.world, farther)
        arena.inside.lay_out()
        entered(self, arena)

    monkeypatch.setattr(NativeLoop, "enter", enter)

    difference = next(compare_loops(1)).difference
    assert "log" in difference
