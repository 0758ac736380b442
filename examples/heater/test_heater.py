"""Tests of a heater: `pytest examples/heater`. It is a good one; its time is that of the wall clock."""

import pytest

SOON_MS = 10_000
"""A busy machine may hold the heater up; as a rule it takes a tenth of that."""


def test_it_heats_when_asked_to(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)

    can_bench.run_until("HEATER_STATE.power", lambda power: power == 100, SOON_MS)
    can_bench.run_until("HEATER_STATE.temperature", lambda temperature: temperature > 20, SOON_MS)


@pytest.mark.can_faults("drop:30%/to", "duplicate:30%/from")
def test_it_heats_in_spite_of_loss(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)

    can_bench.run_until("HEATER_STATE.temperature", lambda temperature: temperature > 20, SOON_MS)


@pytest.mark.can_faults("truncate:1@15-/to")
def test_it_is_off_when_nothing_whole_comes(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)

    can_bench.run_until("HEATER_STATE.power", lambda power: power == 100, SOON_MS)
    can_bench.run_until("HEATER_STATE.power", lambda power: power == 0, SOON_MS)
