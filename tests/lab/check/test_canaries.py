"""A robot with one defect fails the sentence that it breaks, and no other."""

import pytest

from host_sim.lab.check.checking import CHECKS, check_robot
from tests.lab.check.canaries import (  # noqa: F401 - they note their robots
    bytes_and_protection,
    conversation,
    messages,
    owner_and_held,
    silence_and_lockstep,
)
from tests.lab.check.canaries.meddled import CANARIES
from tests.lab.check.virtual import example, one_for_all, virtual


def test_a_good_robot_that_is_there_already_passes():
    verdicts = check_robot(one_for_all(example.Robot()), missing=("T1", "S6"))

    assert [verdict for verdict in verdicts if verdict.state == "fails"] == []
    assert {verdict.number for verdict in verdicts if "--robot-command" in verdict.why} == {"T1", "S6"}


def test_every_check_has_a_canary():
    assert sorted(set(CHECKS) - set(CANARIES)) == []


@pytest.mark.parametrize("number", sorted(CANARIES))
def test_a_robot_with_one_defect_fails_that_sentence_and_no_other(number):
    verdicts = check_robot(virtual(CANARIES[number]))

    assert [verdict.number for verdict in verdicts if verdict.state == "fails"] == [number]
