"""A sample of the campaign: each fault is seen, nothing is unsafe, and what is not seen fails it."""

import shlex
import threading
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import pytest

from host_sim.backends.images import BOARDS
from host_sim.campaign import matrix
from host_sim.campaign.board_setup import Board
from host_sim.campaign.cell import LOCKSTEP, PACES, REAL_TIME, Cell
from host_sim.campaign.course import CourseLog
from host_sim.campaign.html_report import page, verdict
from host_sim.campaign.links import LINKS, open_setup
from host_sim.campaign.matrix import FaultClass, default_limit_s, groups
from host_sim.campaign.outcome import Outcome
from host_sim.campaign.run_files import FILE_EVENTS
from host_sim.campaign.running import run_all, run_cell
from host_sim.campaign.shrink import shrink
from host_sim.campaign.wall_clock import CLOCK_EVENTS
from host_sim.errors import RobotError, UsageError
from host_sim.faults.event import Event
from host_sim.protocol.codec import Frame
from tests.runs.support import octet

CLEAN = Cell("article", "none", LOCKSTEP, limit_s=3.0)


def outcome_of(text: str) -> Outcome:
    cell = Cell.parse(text)
    *_, outcome = run_all([replace(cell, faults=(), changes=(), events=(), fault=""), cell])
    return outcome


SHOWS_LATE = "the left sensor is stuck off"
"""A robot is rarely led by that one."""


def test_each_fault_is_seen_and_told(tmp_path, monkeypatch):
    report = tmp_path / "campaign.html"
    soon = tuple(each for each in matrix.CLASSES if each.name != SHOWS_LATE)
    monkeypatch.setattr(groups, "__defaults__", (soon,))

    done = octet("campaign", report, "--profiles", "article", "--limit-s", "15")

    assert (done.returncode, done.stderr) == (0, "")
    runs = 1 + len([each for each in soon if not each.links])
    assert f"{runs} runs: 0 not as they should be" in done.stdout
    text = report.read_text()
    assert text.count("<details>") == runs
    assert "http" not in text
    assert "--fault drop:30%" in text


def test_a_fault_that_shows_late_is_seen_in_a_run_that_is_long_enough():
    late = [each for each in matrix.CLASSES if each.name == SHOWS_LATE]
    (cells,) = groups(["article"], ["none"], [LOCKSTEP], lambda _: 30.0, late)

    _, found = run_all(cells)

    assert (found.problems, found.seen) == ([], "what it does")


def test_a_fault_without_effect_fails_the_campaign(tmp_path, monkeypatch):
    nothing = FaultClass("nothing that happens", faults=("drop@999999",))
    monkeypatch.setattr(groups, "__defaults__", ((nothing,),))

    done = octet("campaign", tmp_path / "campaign.html", "--profiles", "article", "--limit-s", "2")

    assert done.returncode == 1
    assert done.stderr.startswith("UNSEEN: nothing that happens: tools/run ")


def test_a_robot_that_does_not_come_up_breaks_its_run_and_not_the_campaign(monkeypatch):
    def fail(link):
        raise RobotError(f"the robot on {link} was not ready")

    monkeypatch.setattr("host_sim.campaign.running.open_setup", fail)

    (found,) = run_all([CLEAN])

    assert (found.problems, found.end) == (["broke"], "the robot on none was not ready")


def test_a_fault_of_the_body_is_not_seen_by_frames_that_are_repeated(monkeypatch):
    def repeat(client):
        client.frames.repeated += 1

    monkeypatch.setattr("host_sim.campaign.running.stop", repeat)
    nothing = replace(CLEAN, fault="a motor that is as before", changes=("weak-motor:left:100%@1s",))

    *_, found = run_all([CLEAN, nothing])

    assert found.problems == ["unseen"]


def test_a_run_that_breaks_or_is_unsafe_or_misled_is_a_problem():
    (outcome,) = run_all([replace(CLEAN, limit_s=1.0)])
    assert outcome.problems == []

    outcome.oldest, outcome.wrong, outcome.broke = 6, (1,), True

    assert outcome.problems == ["unsafe", "wrong without a word", "broke"]
    assert verdict(outcome) == "UNSAFE, WRONG WITHOUT A WORD, BROKE"
    assert 'class="bad"' in page([outcome])


def test_a_body_that_denies_its_wheels_must_be_told_of_by_the_robot_and_nothing_wrong_be_learned():
    cell = replace(CLEAN, fault="odometers are swapped", changes=("swap-odometers@2s",))
    told = Outcome(cell, seen="3 denied")

    assert told.problems == Outcome(cell, seen="what it does", wrong=(1,)).problems == []
    assert replace(told, cell=replace(cell, denies=True)).problems == []
    assert Outcome(replace(cell, denies=True), seen="what it does", wrong=(1,)).problems == [
        *("unseen", "wrong without a word"),
    ]


@pytest.mark.parametrize("name", ["no fault", "a third of the frames is lost", "the ring of sensors is mirrored"])
def test_the_command_of_a_cell_repeats_it(tmp_path, name):
    (cells,) = groups(["adaptive"], ["none"], [LOCKSTEP], lambda _: 3.0)
    cell = next(cell for cell in cells if (cell.fault or "no fault") == name)
    (outcome,) = run_all([cell])

    done = octet("run", "--out", tmp_path, *shlex.split(cell.command())[1:], "--json")

    assert done.returncode == 0
    assert outcome.digest in done.stdout


def test_an_image_that_is_missing_is_a_problem_and_not_a_robot_that_ended_in_order(monkeypatch):
    monkeypatch.setattr("host_sim.emulator.board.image_path", lambda board, link: Path("nowhere", board, link))

    assert outcome_of("article blue_pill lockstep seed=12 limit=1 event=reset@20").broke


def test_each_cell_is_a_line_that_is_read_as_it_was_written():
    everywhere = groups(["article", "five"], LINKS, PACES, default_limit_s)

    for cell in (cell for cells in everywhere for cell in cells):
        assert Cell.parse(str(cell)) == cell


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


def test_the_power_goes_twice_in_a_row_while_flash_is_written_and_the_memory_is_restored():
    outcome = outcome_of("article feather_stm32f405 lockstep seed=12 limit=6 event=flash-cut:3@200")

    assert outcome.problems == []
    assert "its memory restored" in outcome.doubts[0]


def test_the_power_goes_twice_in_a_row_while_flash_is_erased_and_the_memory_is_kept(monkeypatch):
    setup = Board("blue_pill")
    monkeypatch.setattr("host_sim.campaign.running.open_setup", lambda _: nullcontext(setup))

    outcome = run_cell(Cell.parse("article blue_pill lockstep seed=12 limit=8 event=erase-cut@300"))

    assert outcome.problems == []
    assert "its memory kept" in outcome.doubts[0]
    assert setup.board.resets == ["power"] * 3
    at_first, cut_short, whole = 1, 2, 1
    assert setup.board.hardware.flash.erasures == at_first + cut_short + whole


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
    monkeypatch.setattr("host_sim.campaign.running.happen", lambda *_: None)
    for limit in ("_LEAST_S", "_FIRST_S", "_MOST_S"):  # what a busy host repeats would look like the effect
        monkeypatch.setattr(f"host_sim.client.round_trip.{limit}", 10.0)

    outcome = outcome_of(f"article {where} lockstep seed=12 limit=0.6 event={event}@20")

    assert (outcome.problems, outcome.seen) == (["unseen"], "")


@pytest.mark.parametrize("event", ["fast-clock:2", "slow-clock:2"])
def test_a_clock_that_drifts_leaves_no_trace_in_lockstep(event):
    clean, drifting = (
        outcome_of(f"article blue_pill lockstep seed=12 limit=2{words}") for words in ("", f" event={event}@20")
    )

    assert clean.digest == drifting.digest


def test_in_real_time_a_robot_that_hangs_lets_its_wheels_rest_in_time():
    outcome = outcome_of("article fd real-time seed=12 limit=2 event=hang:500@20")

    assert outcome.problems == []
    assert "lost" in outcome.seen


@pytest.mark.parametrize(
    ("link", "event"), [("fd", "hold-up:100"), ("fd", "hang:100"), ("feather_stm32f405", "hang:300")]
)
def test_who_stands_still_in_lockstep_leaves_no_trace(link, event):
    clean, stopped = (
        outcome_of(f"article {link} lockstep seed=12 limit=1{words}") for words in ("", f" event={event}@20")
    )

    assert clean.digest == stopped.digest


def test_an_event_that_does_not_come_to_happen_fails_the_campaign():
    assert "did not happen" in outcome_of("article fd lockstep seed=12 limit=1 event=hang:10@900").problems


def test_a_schedule_is_shrunk_to_what_matters():
    line = "article none lockstep seed=12 limit=13 fault=duplicate:9% fault=forge:stop@300/to change=mirror@2s"

    *_, smallest = shrink(Cell.parse(line), lambda smaller: outcome_of(str(smaller)))

    assert smallest.cell.items == ["fault=forge:stop@300/to"]
    assert smallest.cell.limit_s < 13


def test_a_fault_with_a_chance_is_shrunk_to_the_frames_that_matter():
    def attempt(cell: Cell) -> Outcome:
        struck = [rule for rule in ("drop@7/to", "drop@9-12/to") if cell.faults]
        lost = "drop:30%" in cell.faults or "drop@7/to" in cell.faults
        return Outcome(cell, end="lost" if lost else "", struck=tuple(struck), seen="x")

    *_, smallest = shrink(replace(CLEAN, faults=("drop:30%",), limit_s=0.5), attempt)

    assert smallest.cell.faults == ("drop@7/to",)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "article none lockstep",
        "nobody none lockstep seed=1 limit=3",
        "article none slowly seed=1 limit=3",
        "article none lockstep seed=1 limit=3 drop:30%",
        "article none lockstep seed=1 limit=3 fault=meteor!",
        "article none lockstep seed=1 limit=3 event=reset",
        "article none lockstep seed=1 limit=3 event=reset@20",
        "article nowhere lockstep seed=1 limit=3",
        "article vcan lockstep seed=1 limit=3 event=kill@x",
    ],
)
@pytest.mark.parametrize("option", ["--repeat", "--shrink"])
def test_what_is_no_cell_is_one_line(option, text):
    done = octet("campaign", option, text)

    assert done.returncode == 2
    assert done.stderr.count("\n") == 1


def test_a_campaign_without_a_report_says_what_it_needs():
    done = octet("campaign")

    assert (done.returncode, "FILE.html" in done.stderr) == (2, True)


def test_robots_do_not_meet_on_the_bus_that_they_share():
    done = octet("campaign", "campaign.html", "--links", "fd", "vcan", "--jobs", "2")

    assert (done.returncode, done.stderr) == (
        2,
        "octet: vcan0 is one bus for one robot at a time: leave out --jobs\n",
    )


def test_the_report_begins_with_what_is_not_as_it_should_be_and_does_not_say_anything_twice():
    cells = [replace(CLEAN, fault=name, events=(Event("kill", 0, 20),)) for name in ("good", "unseen", "long")]
    ended, bad = Outcome(cells[0], seen="it ended", end="it ended"), Outcome(cells[1])
    doubted = Outcome(cells[2], doubts=tuple(f"doubt {number}" for number in range(9)))

    text = page([ended, bad, doubted])

    assert text.index("UNSEEN") < text.index('<h2 id="article">') < text.index("good")
    assert text.count("it ended") == 1
    assert "doubt 2</p><p>and 6 more like these" in text
    assert "Not as they should be" not in page([ended])


def test_a_cell_is_repeated_and_shrunk_from_the_command_line():
    line = "article none lockstep seed=12 limit=2 fault=drop:5% fault=forge:stop@90/to"

    again, smaller = octet("campaign", "--repeat", line), octet("campaign", "--shrink", line)

    assert (again.returncode, again.stderr) == (0, "")
    assert "somebody else stopped node 1" in again.stdout
    assert smaller.stdout.splitlines()[-1].startswith("ended: article none lockstep seed=12 limit=")
    assert smaller.stdout.splitlines()[-1].endswith(" fault=forge:stop@90/to")
    assert REAL_TIME not in smaller.stdout


def test_where_there_is_no_such_link_it_is_said():
    with pytest.raises(UsageError, match="no link"), open_setup("carrier pigeon"):
        raise AssertionError


def test_reports_that_come_later_are_no_other_course():
    logs = [CourseLog() for _ in range(3)]
    senses, drive, heartbeat, other = (Frame(number, bytes(8)) for number in (0x101, 0x041, 0x6A1, 0x042))
    said = [(heartbeat, senses, drive), (senses, other, drive, heartbeat), (senses, Frame(0x041, bytes([1] * 8)))]

    for log, frames in zip(logs, said, strict=True):
        for frame in frames:
            log.add(frame)
        log.close()

    first, later, different = (log.course for log in logs)
    assert first == later != different


def test_what_need_not_be_noticed_must_not_leave_a_trace():
    outcome = Outcome(replace(CLEAN, fault="a clock that drifts", harmless=True))
    assert outcome.problems == []

    outcome.differs = True

    assert outcome.problems == ["unseen"]


def test_what_was_to_happen_to_a_line_later_does_not_outlive_it():
    before = set(threading.enumerate())

    with open_setup("slcan") as setup:
        setup.events["unplug"](60_000)

    assert set(threading.enumerate()) <= before
