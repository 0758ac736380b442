"""Tests of a heater without a bug: `pytest examples/heater`. Its time is that of the wall clock."""

import pytest

SOON_MS = 10_000
"""A busy machine may delay the heater; normally it takes a tenth of that."""


def test_heater_heats_on_request(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)

    can_bench.run_until("HEATER_STATE.power", lambda power: power == 100, SOON_MS)
    can_bench.run_until("HEATER_STATE.temperature", lambda temperature: temperature > 20, SOON_MS)


@pytest.mark.can_faults("drop:30%/to", "duplicate:30%/from")
def test_heater_heats_despite_lost_requests(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)

    can_bench.run_until("HEATER_STATE.temperature", lambda temperature: temperature > 20, SOON_MS)


@pytest.mark.can_faults("truncate:1@15-/to")
def test_heater_is_off_when_every_request_is_truncated(can_bench):
    can_bench.send_cyclic("REQUEST", wanted=60)

    can_bench.run_until("HEATER_STATE.power", lambda power: power == 100, SOON_MS)
    can_bench.run_until("HEATER_STATE.power", lambda power: power == 0, SOON_MS)
