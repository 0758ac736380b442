"""What can go wrong on the pins of a robot of its own: each fault reaches it, and shows or is told by itself."""

import pytest

from host_sim.lab.campaign.cell import LOCKSTEP, PIN_EVENTS, PINS_LINK
from host_sim.lab.campaign.matrix import PINS, groups
from host_sim.lab.campaign.running import run_all
from tests.lab.campaign.support import outcome_of

TRIED = (
    "the wire of the front sensor is broken",
    "a channel of the left encoder is lost",
    "the right encoder counts against its motor",
    "the left motor is stalled",
    "the wire of the right motor is off",
    "the motors' plugs are swapped",
    "the bridge reports a fault",
    "the converter is stuck",
    "the button's contacts bounce",
)


@pytest.fixture(scope="module")
def outcomes():
    (cells,) = groups(["article"], [PINS_LINK], [LOCKSTEP], lambda _: 10.0, PINS)
    return {it.cell.fault: it for it in run_all(cell for cell in cells if cell.fault in ("", *TRIED))}


@pytest.mark.parametrize("fault", TRIED)
def test_a_fault_of_the_pins_reaches_the_robot_which_bears_or_tells_it(outcomes, fault):
    outcome = outcomes[fault]
    assert (outcome.reach, outcome.problems, outcome.end) == ("reached", [], "")
    assert ("denied" in outcome.seen) == outcome.cell.denies


def test_a_robot_that_has_stopped_for_its_wheels_answers_to_the_end(outcomes):
    assert outcomes["the bridge reports a fault"].recovered


def test_the_power_goes_twice_in_a_row_while_flash_is_written_and_the_robot_goes_on():
    outcome = outcome_of("article pins lockstep seed=12 limit=6 event=flash-cut:3@200")

    assert (outcome.problems, outcome.end) == ([], "")
    assert "its memory restored" in outcome.doubts[0]


def test_each_event_has_a_row():
    assert {it.event.partition(":")[0] for it in PINS} == set(PIN_EVENTS)
