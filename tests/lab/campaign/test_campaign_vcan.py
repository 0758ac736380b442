"""Events of a robot on SocketCAN, and each command that somebody else may forge there."""

import pytest

from tests.lab.campaign.support import outcome_of
from tests.runs.forged import OPCODES, PACES, forge_on_vcan

pytestmark = pytest.mark.vcan

EVENTS = [
    ("bus-down:300@20", "1 outages"),
    ("kill@20", "did not answer tick"),
    ("reset@20", "the robot restarted"),
    ("hang:300@20", "repeated"),
]


@pytest.mark.parametrize(("event", "told"), EVENTS, ids=[event for event, _ in EVENTS])
def test_what_happens_to_a_robot_on_a_bus_is_told_and_nothing_is_unsafe(event, told):
    outcome = outcome_of(f"article vcan lockstep seed=12 limit=1 event={event}")

    assert outcome.problems == []
    assert any(told in text for text in (outcome.end, outcome.seen, *outcome.doubts)), outcome


@pytest.mark.parametrize("opcode", OPCODES)
@pytest.mark.parametrize("pace", PACES)
def test_each_forged_command_is_told(tmp_path, opcode, pace):
    forge_on_vcan(tmp_path, pace, opcode)
