"""What the campaign makes happen to a robot, its line, its host or its pins: it is told, or it leaves no trace.

Random schedules of faults: drawn alike from a seed, compared with the clean run, and shrunk where they fail.
"""

import re
import threading
from collections import Counter
from contextlib import nullcontext

import pytest

from host_sim.lab.campaign import walk
from host_sim.lab.campaign.board_setup import Board
from host_sim.lab.campaign.cell import LOCKSTEP, PACES, PIN_EVENTS, PINS_LINK, Cell, Outcome
from host_sim.lab.campaign.host_events import CLOCK_EVENTS
from host_sim.lab.campaign.matrix import HOST, LINE, PINS, ROBOT, default_limit_s, groups
from host_sim.lab.campaign.run_files import FILE_EVENTS
from host_sim.lab.campaign.running import run_all, run_cell
from host_sim.lab.campaign.setups import open_setup
from host_sim.sim.access import BOARDS
from host_sim.transport.rule import FAULT_NAMES, Rule
from tests.lab.campaign.support import outcome_of
from tests.runs.support import octet


@pytest.mark.parametrize("link", ["none", "fd", "slcan", *BOARDS])
def test_campaign_covers_all_events_of_a_link(link):
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
def test_event_at_a_robot_is_reported_and_safe(where, event, told):
    outcome = outcome_of(f"article {where} seed=12 limit=1 {event}")

    assert outcome.problems == []
    assert any(told in text for text in (outcome.end, outcome.seen, *outcome.doubts)), outcome
    assert outcome.recovered or outcome.end


@pytest.mark.parametrize(
    "where",
    [
        "feather_stm32f405 lockstep seed=12 limit=6 event=flash-cut:3@200",
        "nucleo_g431rb lockstep seed=12 limit=6 event=flash-cut:2@200",
        "pins lockstep seed=12 limit=6 event=flash-cut:3@200",
    ],
)
def test_memory_is_restored_after_two_power_cuts_in_a_flash_write(where):
    outcome = outcome_of(f"article {where}")

    assert (outcome.problems, outcome.end) == ([], "")
    assert "its memory restored" in outcome.doubts[0]


def test_memory_is_kept_after_two_power_cuts_in_a_flash_erase(monkeypatch):
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
def test_event_without_effect_fails_the_campaign(monkeypatch, where, event):
    monkeypatch.setattr("host_sim.lab.campaign.running.trigger", lambda *_: None)
    for limit in ("_LEAST_S", "_FIRST_S", "_MOST_S"):  # what a busy host repeats would look like the effect
        monkeypatch.setattr(f"host_sim.client.connection.{limit}", 10.0)

    outcome = outcome_of(f"article {where} lockstep seed=12 limit=0.6 event={event}@20")

    assert (outcome.problems, outcome.seen) == (["unseen"], "")


@pytest.mark.parametrize("clock", ["", " event=clock-back:3600@20"])
def test_wheels_stop_in_time_when_a_robot_hangs_in_real_time(clock):
    outcome = outcome_of(f"article fd real-time seed=12 limit=2 event=hang:500@20{clock}")

    assert outcome.problems == []
    assert "lost" in outcome.seen


PAUSES = [("fd", "hold-up:100"), ("fd", "hang:100"), ("feather_stm32f405", "hang:300")]
CLOCKS = [("blue_pill", f"{way}-clock:2") for way in ("fast", "slow")]
WALL_CLOCKS = [("fd", f"clock-{way}:3600") for way in ("ahead", "back")]


@pytest.mark.parametrize(("link", "event"), [*PAUSES, *CLOCKS, *WALL_CLOCKS])
def test_pause_or_other_clock_in_lockstep_leaves_the_log_unchanged(link, event):
    line = f"article {link} lockstep seed=12 limit={2 if link == 'blue_pill' else 1}"

    assert outcome_of(line).digest == outcome_of(f"{line} event={event}@20").digest


def test_event_that_does_not_happen_fails_the_campaign():
    assert "did not happen" in outcome_of("article fd lockstep seed=12 limit=1 event=hang:10@900").problems


def test_pending_event_ends_with_its_line():
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


def test_pin_fault_reaches_the_robot_which_tolerates_or_reports_it():
    (cells,) = groups(["article"], [PINS_LINK], [LOCKSTEP], lambda _: 10.0, PINS)
    outcomes = {it.cell.fault: it for it in run_all([cell for cell in cells if cell.fault in ("", *TRIED)])}

    for fault in TRIED:
        outcome = outcomes[fault]
        assert (outcome.reach, outcome.problems, outcome.end) == ("reached", [], ""), fault
        assert ("denied" in outcome.seen) == outcome.cell.denies, fault
    assert outcomes["the bridge reports a fault"].recovered  # it answers to the end


def test_pin_faults_of_the_matrix_cover_all_pin_events():
    assert {it.event.partition(":")[0] for it in PINS} == set(PIN_EVENTS)


LINKS = ("none", "fd", "slcan", "blue_pill")
WHERE = (LINKS, ["article", "adaptive"], 6.0)


def drawn(count, seed):
    return [cell for _, *cells in walk.walk(count, seed, *WHERE) for cell in cells]


def test_equal_seeds_draw_equal_schedules_and_other_seeds_others():
    first, again, other = (list(map(str, drawn(30, seed))) for seed in (1, 1, 2))

    assert first == again
    assert len(first) == 30
    assert not {*first} & {*other}


def test_schedules_have_one_to_six_faults_of_all_kinds_and_can_be_repeated():
    cells = drawn(1000, 1)

    assert {len(cell.faults) + bool(cell.events) for cell in cells} <= set(range(1, 7))
    assert {Rule.parse(rule).name for cell in cells for rule in cell.faults} == {*FAULT_NAMES}
    events = Counter(event.name for cell in cells for event in cell.events)
    assert {"reset", "hang", "hold-up", "kill", "flash-cut", "disk-full", "unplug", "kill-simulator"} <= events.keys()
    classes = [it for it in (*ROBOT, *LINE, *HOST) for link in LINKS if it.applies_to("article", link, LOCKSTEP)]
    assert events.keys() == {it.partition(":")[0] for each in classes for it in each.event.split()} - {"kill-saving"}
    assert any("SENSES" in rule and not rule.endswith("/to") for cell in cells for rule in cell.faults)
    assert [str(Cell.parse(str(cell))) for cell in cells] == list(map(str, cells))


def test_random_schedules_change_nothing_without_a_warning():
    done = octet("campaign", "--walk", "40", "--links", *LINKS, "--limit-s", "6")

    assert (done.returncode, done.stderr) == (0, "")
    assert re.search(r"^\d+ runs: 0 not as they should be", done.stdout, re.M)


def test_schedule_that_changes_a_run_without_a_warning_is_shrunk(monkeypatch):
    guilty = "event=clock-back:3600@40"
    schedule = Cell.parse(f"article none lockstep seed=1 limit=2 fault=duplicate@30-40/to {guilty}")
    monkeypatch.setattr(walk, "_drawn", lambda *_: schedule)

    def run_cell(cell):
        return Outcome(cell, course="another" if cell.events else "clean")

    monkeypatch.setattr("host_sim.lab.campaign.running.run_cell", run_cell)

    done = octet("campaign", "--walk", "1", "--limit-s", "2", "--profiles", "article", "--jobs", "1")

    assert done.returncode == 1
    assert re.search(rf"^  shortest: .*'article none lockstep seed=1 limit=0.5 {guilty}'$", done.stderr, re.M)
