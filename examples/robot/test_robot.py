"""Tests of a robot on the bench, like any other device: `pytest examples/robot`. It runs in wall-clock time."""

import pytest

SOON_MS = 10_000


def test_started_robot_answers_senses_with_its_speeds(can_bench):
    can_bench.send("COMMAND", opcode="start", owner=1, lockstep=1)
    can_bench.run_until("ANSWER.result", lambda result: result == 0, SOON_MS)
    can_bench.send("SENSES", tick=0)
    can_bench.run_until("DRIVE.left", lambda left: left > 0, SOON_MS)


@pytest.mark.can_faults("corrupt@2-/to")
def test_robot_reports_damaged_senses_and_stays_at_rest(can_bench):
    can_bench.send("COMMAND", opcode="start", owner=1)
    can_bench.run_until("ANSWER.result", lambda result: result == 0, SOON_MS)
    can_bench.send("SENSES", tick=0)
    can_bench.run_until("EMERGENCY.first", lambda first: first == 3, SOON_MS)

    assert all(left == 0 for _, left in can_bench.history("DRIVE.left"))
