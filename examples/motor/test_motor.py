"""Tests of a motor controller: `pytest examples/motor`. The last one finds its bug."""

import pytest


def test_motor_follows_its_set_point(can_bench):
    can_bench.send_cyclic("SETPOINT", speed=1000)
    can_bench.run(ms=1000)

    assert can_bench["STATUS.speed"] > 950


@pytest.mark.can_faults("drop:30%/to")
def test_motor_follows_despite_lost_set_points(can_bench):
    can_bench.send_cyclic("SETPOINT", speed=1000)
    can_bench.run(ms=1000)

    assert can_bench["STATUS.speed"] > 950


@pytest.mark.can_faults("drop@20-/to")
def test_motor_stops_when_the_bus_falls_silent(can_bench):
    can_bench.send_cyclic("SETPOINT", speed=1000)
    can_bench.run(ms=1000)

    assert abs(can_bench["STATUS.speed"]) < 10


@pytest.mark.can_faults("corrupt@20-/to")
def test_motor_stops_when_every_set_point_is_damaged(can_bench):
    can_bench.send_cyclic("SETPOINT", speed=1000)
    can_bench.run(ms=1000)

    assert abs(can_bench["STATUS.speed"]) < 10
