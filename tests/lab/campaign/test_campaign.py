"""A sample of the campaign: each fault is seen, nothing is unsafe, and what is not seen fails it."""

import json
import shlex
from dataclasses import replace
from pathlib import Path

import pytest

from host_sim.base.errors import RobotError, UsageError
from host_sim.lab.campaign import matrix
from host_sim.lab.campaign.cell import LOCKSTEP, PACES, REAL_TIME, Cell, Outcome
from host_sim.lab.campaign.html_report import page, summary, verdict
from host_sim.lab.campaign.matrix import FaultClass, default_limit_s, groups
from host_sim.lab.campaign.run_files import CourseLog
from host_sim.lab.campaign.running import run_all
from host_sim.lab.campaign.setups import LINKS, open_setup
from host_sim.lab.campaign.walk import shrink
from host_sim.protocol.codec import Frame
from host_sim.transport.rule import Event
from tests.lab.campaign.support import CLEAN, outcome_of
from tests.runs.support import octet


def test_short_campaign_notices_all_faults_and_writes_its_report(tmp_path):
    report = tmp_path / "campaign.html"

    done = octet("campaign", "--html", report, "--profiles", "article", "--limit-s", "6")

    assert (done.returncode, done.stderr) == (0, "")
    runs = 1 + len([each for each in matrix.CLASSES if not each.links and not each.profiles])
    assert f"{runs} runs: 0 not as they should be" in done.stdout
    text = report.read_text()
    assert text.count("<details>") == runs
    assert "http:" not in text
    assert "https:" not in text
    assert "default-src 'none'" in text
    assert "--fault drop:30%" in text


def test_late_fault_gets_a_longer_run_in_lockstep():
    late = [each for each in matrix.CLASSES if each.name == "the left sensor is stuck off"]
    (lockstep, real_time) = groups(["searcher"], ["fd"], PACES, lambda _: 6.0, late)

    assert [cell.limit_s for cell in (*lockstep, *real_time)] == [6, 60, 6, 6]


def test_fault_without_effect_fails_the_campaign(tmp_path, monkeypatch):
    nothing = FaultClass("nothing that happens", faults=("drop@999999",))
    monkeypatch.setattr(groups, "__defaults__", ((nothing,),))

    done = octet("campaign", "--html", tmp_path / "campaign.html", "--profiles", "article", "--limit-s", "2")

    assert done.returncode == 1
    assert done.stderr.startswith("UNSEEN: nothing that happens: tools/run ")


def test_robot_that_fails_to_start_breaks_its_run_not_the_campaign(monkeypatch):
    def fail(link, _program):
        raise RobotError(f"the robot on {link} was not ready")

    monkeypatch.setattr("host_sim.lab.campaign.running.open_setup", fail)

    (found,) = run_all([CLEAN])

    assert (found.problems, found.end) == (["broke"], "the robot on none was not ready")


def test_repeated_frames_do_not_count_as_notice_of_a_body_fault(monkeypatch):
    def repeat(client):
        client.frames.repeated += 1

    monkeypatch.setattr("host_sim.lab.campaign.running.stop", repeat)
    nothing = replace(CLEAN, fault="a motor that is as before", changes=("weak-motor:left:100%@1s",))

    *_, found = run_all([CLEAN, nothing])

    assert found.problems == ["unseen"]


def test_broken_unsafe_or_misled_run_is_a_problem():
    (outcome,) = run_all([replace(CLEAN, limit_s=1.0)])
    assert outcome.problems == []

    outcome.oldest, outcome.wrong, outcome.broke = 6, (1,), True

    assert outcome.problems == ["unsafe", "wrong without a warning", "broke"]
    assert verdict(outcome) == "UNSAFE, WRONG WITHOUT A WARNING, BROKE"
    assert 'class="bad"' in page([outcome])


def test_robot_must_report_denied_wheels_and_learn_nothing_wrong():
    cell = replace(CLEAN, fault="odometers are swapped", changes=("swap-odometers@2s",))
    told = Outcome(cell, seen="3 denied")

    assert told.problems == Outcome(cell, seen="what it does", wrong=(1,)).problems == []
    assert replace(told, cell=replace(cell, denies=True)).problems == []
    assert Outcome(replace(cell, denies=True), seen="what it does", wrong=(1,)).problems == [
        *("unseen", "wrong without a warning")
    ]


@pytest.mark.parametrize("name", ["no fault", "a third of the frames is lost", "the ring of sensors is mirrored"])
def test_command_of_a_cell_repeats_its_run(tmp_path, name):
    (cells,) = groups(["adaptive"], ["none"], [LOCKSTEP], lambda _: 3.0)
    cell = next(cell for cell in cells if (cell.fault or "no fault") == name)
    (outcome,) = run_all([cell])

    done = octet("run", "--out", tmp_path, *shlex.split(cell.command())[1:], "--json")

    assert done.returncode == 0
    assert outcome.digest in done.stdout


def test_missing_image_counts_as_a_broken_run(monkeypatch):
    monkeypatch.setattr("host_sim.base.paths.image_path", lambda board, link: Path("nowhere", board, link))

    assert outcome_of("article blue_pill lockstep seed=12 limit=1 event=reset@20").broke


def test_cell_written_as_a_line_parses_to_the_same_cell():
    everywhere = groups(["article", "five"], LINKS, PACES, default_limit_s)

    for cell in (cell for cells in everywhere for cell in cells):
        assert Cell.parse(str(cell)) == cell


def test_limit_of_many_digits_is_written_to_the_millisecond():
    assert Cell.parse(str(Cell("article", "none", LOCKSTEP, limit_s=12.34567))).limit_s == 12.346


def test_shrink_leaves_the_guilty_fault_and_a_shorter_limit():
    line = "article none lockstep seed=12 limit=13 fault=duplicate:9% fault=forge:stop@300/to change=mirror@2s"

    *_, smallest = shrink(Cell.parse(line), lambda smaller: outcome_of(str(smaller)))

    assert smallest.cell.items == ["fault=forge:stop@300/to"]
    assert smallest.cell.limit_s < 13


def test_fault_with_a_probability_is_shrunk_to_the_frames_that_matter():
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
def test_malformed_run_is_refused_in_one_line(option, text):
    done = octet("campaign", option, text)

    assert (done.returncode, done.stderr.count("\n")) == (2, 1)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("", "campaign needs --html FILE.html"),
        ("--html a.html --links fd vcan --jobs 2", "vcan0 is one bus for one robot at a time: leave out --jobs"),
    ],
)
def test_unsuitable_options_of_a_campaign_are_refused(words, said):
    done = octet("campaign", *words.split())

    assert (done.returncode, done.stderr.startswith(f"octet: {said}")) == (2, True)


def test_report_begins_with_problems_and_repeats_nothing():
    cells = [replace(CLEAN, fault=name, events=(Event("kill", 0, 20),)) for name in ("good", "unseen", "long")]
    ended, bad = Outcome(cells[0], seen="it ended", end="it ended"), Outcome(cells[1])
    doubted = Outcome(cells[2], doubts=tuple(f"doubt {number}" for number in range(9)))

    text = page([ended, bad, doubted])

    assert text.index("UNSEEN") < text.index('<h2 id="article">') < text.index("good")
    assert text.count("it ended") == 1
    assert "doubt 2</p><p>and 6 more like these" in text
    assert "Not as they should be" not in page([ended])


def test_command_line_repeats_and_shrinks_a_cell():
    line = "article none lockstep seed=12 limit=2 fault=drop:5% fault=forge:stop@90/to"

    again, smaller = octet("campaign", "--repeat", line), octet("campaign", "--shrink", line)

    assert (again.returncode, again.stderr) == (0, "")
    assert "somebody else stopped node 1" in again.stdout
    assert smaller.stdout.splitlines()[-1].startswith("ended: article none lockstep seed=12 limit=")
    assert smaller.stdout.splitlines()[-1].endswith(" fault=forge:stop@90/to")
    assert REAL_TIME not in smaller.stdout


def test_unknown_link_is_reported():
    with pytest.raises(UsageError, match="no link"), open_setup("carrier pigeon"):
        raise AssertionError


def test_course_is_the_same_when_reports_come_later():
    logs = [CourseLog() for _ in range(3)]
    senses, drive, heartbeat, other = (Frame(number, bytes(8)) for number in (0x101, 0x041, 0x6A1, 0x042))
    said = [(heartbeat, senses, drive), (senses, other, drive, heartbeat), (Frame(0x101, bytes([1] * 8)), drive)]

    for log, frames in zip(logs, said, strict=True):
        for frame in frames:
            log.add(frame)
        log.close()

    first, later, different = (log.course for log in logs)
    assert first == later != different


def test_harmless_fault_must_leave_the_result_unchanged():
    outcome = Outcome(replace(CLEAN, fault="a clock that drifts", harmless=True))
    assert outcome.problems == []

    outcome.differs = True

    assert outcome.problems == ["unseen", "differs without a warning"]


NEVER = FaultClass("a fault that never comes", ("forge:erase@99999/to",), harmless=PACES)
REFUSED = FaultClass("forged distances", ("forge:RANGES@300-303/to",), harmless=PACES)
REACHED = FaultClass("a forged erase", ("forge:erase@300/to",))


@pytest.mark.parametrize(("fault", "reach"), [(NEVER, "never came"), (REFUSED, "refused"), (REACHED, "reached")])
def test_run_reports_whether_its_fault_reached_its_receiver(fault, reach):
    (cells,) = groups(["article"], ["none"], [LOCKSTEP], lambda _: 8.0, [fault])

    _, outcome = run_all(cells)

    assert outcome.reach == reach
    assert f"fault: {reach}" in page([outcome])
    assert ('class="well"' in page([outcome]), fault.name in summary([outcome])) == (False, reach != "reached")


def test_fault_that_never_comes_fails_the_campaign(tmp_path, monkeypatch):
    monkeypatch.setattr("host_sim.lab.campaign.matrix.groups.__defaults__", ((NEVER,),))
    words = ("--profiles", "article", "--limit-s", "3", "--json", tmp_path / "campaign.json")

    done = octet("campaign", "--html", tmp_path / "campaign.html", *words)

    assert done.returncode == 1
    assert "none reached its receiver: a fault that never comes" in done.stdout
    assert [case["result"] for case in json.loads((tmp_path / "campaign.json").read_text())] == ["passed", "skipped"]


def test_doubts_about_the_host_do_not_show_that_the_fault_came():
    outcome = Outcome(replace(CLEAN, fault=NEVER.name, faults=NEVER.faults), doubts=("this host was too slow",))

    assert outcome.reach == "never came"


def test_parallel_runs_have_the_same_outcomes_in_the_same_order():
    cells = [Cell("article", "none", LOCKSTEP, limit_s=limit_s, faults=("drop:30%",)) for limit_s in (3.0, 0.5, 1.0)]

    assert list(run_all([CLEAN, *cells], jobs=4)) == list(run_all([CLEAN, *cells]))
