"""What the campaign makes happen to a robot, its line, its host or its pins: it is told, or it leaves no trace."""

import threading
from contextlib import nullcontext

import pytest

from host_sim.lab.campaign.board_setup import Board
from host_sim.lab.campaign.cell import LOCKSTEP, PACES, PIN_EVENTS, PINS_LINK, Cell
from host_sim.lab.campaign.host_events import CLOCK_EVENTS
from host_sim.lab.campaign.links import open_setup
from host_sim.lab.campaign.matrix import PINS, default_limit_s, groups
from host_sim.lab.campaign.run_files import FILE_EVENTS
from host_sim.lab.campaign.running import run_all, run_cell
from host_sim.sim.access import BOARDS
from tests.lab.campaign.support import leaves_a_trace, outcome_of


@pytest.mark.parametrize("link", ["none", "fd", "slcan", *BOARDS])
def test_every_event_of_a_link_is_made_to_happen_there(link):
    asked = {event.name for (cells,) in [groups(["article"], [link], PACES[:1], default_limit_s)] for cell in cells
             for event in cell.events}  # fmt: skip

    with open_setup(link) as setup:
        assert asked == {*setup.events, *FILE_EVENTS, *CLOCK_EVENTS}


ENDS = [
    ("fd lockstep", "event=kill@20", "was killed by signal 9 (SIGKILL)"),
    ("fd lockstep", "event=crash@20", "was killed by signal 11 (SIGSEGV)"),
    ("fd lockstep", "event=hang:300@20", "repeated"),
    ("slcan lockstep", "event=reset@20", "the robot restarted"),
    ("slcan lockstep", "event=unplug:100@20", "1 outages"),
    ("slcan lockstep", "event=noise:1@20", "repeated"),
    ("feather_stm32f405 lockstep", "event=power@20", "the robot restarted (power_on) with its memory kept"),
    ("nucleo_g431rb lockstep", "event=bus-off:400@20", "repeated"),
    ("blue_pill lockstep", "event=watchdog@20", "the robot restarted (watchdog) with its memory kept"),
    ("blue_pill lockstep", "event=stack@20", "the robot restarted (crash) with its memory kept"),
    ("feather_stm32f405 lockstep", "event=bus-off:400@20", "repeated"),
    ("feather_stm32f405 lockstep", "event=no-ack:400@20", "repeated"),
    ("feather_stm32f405 lockstep", "event=wrong-rate:400@20", "repeated"),
    ("feather_stm32f405 lockstep", "event=babble:300@20", "repeated"),
]


@pytest.mark.parametrize(("where", "event", "told"), ENDS, ids=[f"{where} {event}" for where, event, _ in ENDS])
def test_what_happens_to_a_robot_is_told_and_nothing_is_unsafe(where, event, told):
    outcome = outcome_of(f"article {where} seed=12 limit=1 {event}")

    assert outcome.problems == []
    assert any(told in text for text in (outcome.end, outcome.seen, *outcome.doubts)), outcome
    assert outcome.recovered or outcome.end


@pytest.mark.parametrize(
    "where",
    [
        "feather_stm32f405 lockstep seed=12 limit=6 event=flash-cut:3@200",
        "nucleo_g431rb lockstep seed=12 limit=6 event=flash-cut:2@200",
    ],
)
def test_the_power_goes_twice_in_a_row_while_flash_is_written_and_the_memory_is_restored(where):
    outcome = outcome_of(f"article {where}")

    assert outcome.problems == []
    assert "its memory restored" in outcome.doubts[0]


def test_the_power_goes_twice_in_a_row_while_flash_is_erased_and_the_memory_is_kept(monkeypatch):
    setup = Board("blue_pill")
    monkeypatch.setattr("host_sim.lab.campaign.running.open_setup", lambda *_: nullcontext(setup))

    outcome = run_cell(Cell.parse("article blue_pill lockstep seed=12 limit=8 event=erase-cut@300"))

    assert outcome.problems == []
    assert "its memory kept" in outcome.doubts[0]
    assert setup.board.resets == ["power"] * 3
    memory, cut_short, whole = 1, 2, 1
    assert setup.board.hardware.flash.erasures == memory + cut_short + whole


@pytest.mark.parametrize(
    ("where", "event"),
    [
        *(
            ("fd", "kill"),
            ("slcan", "reset"),
            ("slcan", "unplug:100"),
            ("none", "disk-full"),
            ("none", "folder-gone"),
        ),
        *(
            ("blue_pill", name)
            for name in ("reset", "power", "watchdog", "crash", "stack", "flash-cut:1", "bus-off:9")
        ),
    ],
)
def test_an_event_without_effect_fails_the_campaign(monkeypatch, where, event):
    monkeypatch.setattr("host_sim.lab.campaign.running.happen", lambda *_: None)
    for limit in ("_LEAST_S", "_FIRST_S", "_MOST_S"):  # what a busy host repeats would look like the effect
        monkeypatch.setattr(f"host_sim.client.connection.{limit}", 10.0)

    outcome = outcome_of(f"article {where} lockstep seed=12 limit=0.6 event={event}@20")

    assert (outcome.problems, outcome.seen) == (["unseen"], "")


@pytest.mark.parametrize("event", ["fast-clock:2", "slow-clock:2"])
def test_a_clock_that_drifts_leaves_no_trace_in_lockstep(event):
    assert not leaves_a_trace(event, "blue_pill", limit_s=2)


def test_in_real_time_a_robot_that_hangs_lets_its_wheels_rest_in_time():
    outcome = outcome_of("article fd real-time seed=12 limit=2 event=hang:500@20")

    assert outcome.problems == []
    assert "lost" in outcome.seen


@pytest.mark.parametrize(
    ("link", "event"), [("fd", "hold-up:100"), ("fd", "hang:100"), ("feather_stm32f405", "hang:300")]
)
def test_who_stands_still_in_lockstep_leaves_no_trace(link, event):
    assert not leaves_a_trace(event, link, limit_s=1)


def test_an_event_that_does_not_come_to_happen_fails_the_campaign():
    assert "did not happen" in outcome_of("article fd lockstep seed=12 limit=1 event=hang:10@900").problems


def test_what_was_to_happen_to_a_line_later_does_not_outlive_it():
    before = set(threading.enumerate())

    with open_setup("slcan") as setup:
        setup.events["unplug"](60_000)

    assert set(threading.enumerate()) <= before


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
