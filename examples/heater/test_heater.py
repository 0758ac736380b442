"""Tests of a heater: `pytest examples/heater`. It is a good one; its time is that of the wall clock."""

import pytest


def highest(can_bench, signal):
    """A busy machine may hold up what should come at the end."""
    return max(value for _, value in can_bench.history(f"HEATER_STATE.{signal}"))


def test_it_heats_when_asked_to(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)
    can_bench.run(ms=600)

    assert highest(can_bench, "power") == 100
    assert highest(can_bench, "temperature") > 20


@pytest.mark.can_faults("drop:30%/to", "duplicate:30%/from")
def test_it_heats_in_spite_of_loss(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)
    can_bench.run(ms=600)

    assert highest(can_bench, "temperature") > 20


@pytest.mark.can_faults("truncate:1@15-/to")
def test_it_is_off_when_nothing_whole_comes(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)
    can_bench.run(ms=900)

    assert can_bench["HEATER_STATE.power"] == 0
